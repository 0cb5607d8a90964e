
"use strict";
// Answers questions by one evaluator. Runs in workers, or, where there are none, in the page.
function work(port) {
  let wasm;
  const bytes = (at, length) => new Uint8Array(wasm.memory.buffer, at, length);

  function ask(name, question) {
    if (question) bytes(wasm.input(question.length), question.length).set(question);
    const isAnswer = wasm[name]();
    const text = new TextDecoder().decode(bytes(wasm.text(), wasm.text_length()));
    if (!isAnswer) throw new Error(text);
    return JSON.parse(text);
  }
  const json = value => new TextEncoder().encode(JSON.stringify(value));

  const tasks = {
    async open({ module, dataset }) {
      wasm = (await WebAssembly.instantiate(module, {})).exports;
      return { answer: ask("open", dataset) };
    },
    describe: ({ step }) => ({ answer: ask("describe", json(step)) }),
    rows({ rows }) {
      ask("rows", json(rows));
      const answer = new Float64Array(wasm.memory.buffer, wasm.values(), wasm.value_count()).slice();
      return { answer, transfer: [answer.buffer] };
    },
    // Without strips the values are those of the image before.
    paint({ frame, strips }) {
      if (strips) {
        const count = strips.reduce((sum, strip) => sum + strip.length, 0);
        // first, since the memory may grow, which makes another buffer of it
        const start = wasm.reserve(count);
        const values = new Float64Array(wasm.memory.buffer, start, count);
        let at = 0;
        for (const strip of strips) {
          values.set(strip, at);
          at += strip.length;
        }
      }
      const legend = ask("paint", json(frame));
      const pixels = new Uint8ClampedArray(bytes(wasm.pixels(), wasm.pixel_bytes()));
      return { answer: { legend, pixels }, transfer: [pixels.buffer] };
    },
    probe: ({ question }) => ({ answer: ask("probe", json(question)) }),
  };

  port.onmessage = async ({ data }) => {
    try {
      const { answer, transfer } = await tasks[data.task](data);
      port.postMessage({ id: data.id, answer }, transfer ?? []);
    } catch (error) {
      const isBroken = error instanceof WebAssembly.RuntimeError;
      const reason = isBroken ? "The evaluator stopped; load the page again." : error.message;
      port.postMessage({ id: data.id, reason });
    }
  };
}
