// A view of a field in a notebook: shows finished pixels, and sends what mouse, keys and controls do.
//
// The kernel keeps the view, so no digit is lost here: the browser knows pixels alone. A move is (k, x, y), pixel p goes to k p + (x, y);
// moves that wait become one. At most two frames are asked for at a time.

const MOST = 2; // frames on their way
const REST = 150; // ms without a move until an automatic range follows
const KEYS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

const STYLE = `
.ppum { font: 13px system-ui, sans-serif; color: inherit; }
.ppum-stage { display: flex; gap: 8px; position: relative; }
.ppum-stage > img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; background: #fff; pointer-events: none; }
.ppum-stage > canvas { flex: 1 1 0; min-width: 0; width: 100%; touch-action: none; cursor: crosshair; background: #fff; outline: 1px solid #8888; }
.ppum-stage > canvas:focus-visible { outline: 2px solid #27c; }
.ppum-bar { display: flex; flex-direction: column; flex: 0 0 84px; min-width: 0; }
.ppum-bar > b { flex: none; min-height: 14px; padding-bottom: 12px; overflow-wrap: anywhere; font-weight: normal; font-size: 11px; line-height: 1.1; }
.ppum-scale { position: relative; flex: 1 1 0; min-height: 0; margin-bottom: 12px; }
.ppum-scale > canvas { position: absolute; top: 0; left: 0; width: 16px; height: 100%; }
.ppum-scale > span { position: absolute; left: 22px; transform: translateY(-50%); white-space: nowrap; }
.ppum-row { display: flex; flex-wrap: wrap; gap: 6px; align-items: center; margin: 4px 0; }
.ppum-row input[type=text] { width: 12em; } .ppum-row input[type=number] { width: 7em; }
.ppum-told { min-height: 1.4em; font-variant-numeric: tabular-nums; }
.ppum-error { color: #c22; white-space: pre-wrap; overflow-wrap: anywhere; }`;

const make = (tag, parent, options = {}) => parent.appendChild(Object.assign(document.createElement(tag), options));

// One frame after the other from the kernel, the newest state winning.
function courier(model, size, show) {
  const me = crypto.randomUUID?.() ?? String(Math.random());
  let flying = 0, wanted = null, probe = null, probing = false, shown = -1;
  const send = (content) => model.send({ from: me, size: size(), ...content });
  const pump = () => {
    const [columns, rows] = size();
    if (columns < 1 || rows < 1) return; // hidden: asked again when it is seen
    if (wanted && flying < MOST) {
      flying += 1;
      const now = wanted;
      wanted = null;
      send(now);
    }
    if (probe && !probing) {
      probing = true;
      send({ probe });
      probe = null;
    }
  };
  const hear = (content, buffers) => {
    if (content?.to !== me) {
      if (content?.version !== undefined && content.version !== shown && content.kind !== "probe") ask({});
      return;
    }
    if (content.kind === "probe") probing = false;
    else {
      flying -= 1;
      shown = content.version;
    }
    show(content, buffers);
    pump();
  };
  const ask = (what) => {
    const { move, set, ...other } = what;
    const before = wanted ?? {};
    wanted = { ...before, ...other };
    if (set) wanted.set = { ...before.set, ...set };
    if (move) {
      const [k, x, y] = before.move ?? [1, 0, 0];
      wanted.move = [move[0] * k, move[0] * x + move[1], move[0] * y + move[2]];
    }
    wanted.moving = Boolean(move) && wanted.moving !== false;
    pump();
  };
  model.on("msg:custom", hear);
  const close = () => model.off("msg:custom", hear);
  return { ask, close, pump, probe: (at) => { probe = at; pump(); } };
}

// Words with `_{…}` below the line.
function words(node, text) {
  node.replaceChildren();
  for (const [k, part] of text.split(/_\{([^}]*)\}/).entries()) {
    make(k % 2 ? "sub" : "span", node, { textContent: part });
  }
}

function power(n) {
  return String(n).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
}

function drawBar(heading, scale, facts, colors) {
  const count = colors.byteLength / 3;
  const image = new ImageData(1, count);
  for (let k = 0; k < count; k += 1) {
    const row = 4 * (count - 1 - k);
    for (let c = 0; c < 3; c += 1) image.data[row + c] = colors.getUint8(3 * k + c);
    image.data[row + 3] = 255;
  }
  const canvas = Object.assign(scale.querySelector("canvas"), { width: 1, height: count });
  canvas.getContext("2d").putImageData(image, 0, 0);
  for (const old of scale.querySelectorAll(":scope > span")) old.remove();
  for (const [at, label] of facts.ticks) {
    make("span", scale, { textContent: label }).style.top = `${100 * (1 - at)}%`;
  }
  const unit = [facts.exponent ? `×10${power(facts.exponent)}` : "", facts.unit].filter(Boolean).join(" ");
  const less = facts.reference ? ` ${facts.reference > 0 ? "−" : "+"} ${Math.abs(facts.reference)}` : "";
  words(heading, facts.symbol + less + (unit ? ` [${unit}]` : ""));
}

function controls(row, offers, ask) {
  const button = (text, title, onclick) => make("button", row, { textContent: text, title, onclick });
  const select = (name, values, title) => {
    const box = make("select", row, { title, ariaLabel: title });
    for (const value of values) make("option", box, { value, textContent: value });
    box.onchange = () => ask({ set: { [name]: box.value } });
    return box;
  };
  const known = make("datalist", row, { id: `ppum-${Math.random()}` });
  for (const value of offers.quantities) make("option", known, { value });
  const quantity = make("input", row, { type: "text", title: "quantity or formula", ariaLabel: "quantity or formula" });
  quantity.setAttribute("list", known.id);
  quantity.onchange = () => ask({ set: { quantity: quantity.value } });
  const cmap = select("cmap", offers.cmaps, "colour map");
  const norm = select("norm", ["linear", "log", "symlog"], "scale");
  const range = make("select", row, { title: "range", ariaLabel: "range" });
  for (const value of ["auto", "full", "fixed"]) make("option", range, { value, textContent: value });
  const ends = ["lowest", "highest"].map((title) => make("input", row, { type: "number", step: "any", title, ariaLabel: title }));
  const fixed = () => ends.map((end) => end.valueAsNumber);
  range.onchange = () => ask({ set: { clim: range.value === "fixed" ? fixed() : range.value } });
  for (const end of ends) end.onchange = () => ask({ set: { clim: fixed() } });
  button("⌂", "all of the plate (0)", () => ask({ home: true }));
  if (offers.tips.length) {
    const tips = make("select", row, { title: "go to a tip", ariaLabel: "go to a tip" });
    for (const [k, text] of ["go to …", ...offers.tips].entries()) make("option", tips, { value: k - 1, textContent: text });
    tips.onchange = () => { ask({ tip: Number(tips.value) }); tips.value = -1; };
  }
  // notebooks take the key for themselves
  row.onkeydown = (event) => {
    if (event.key === "Enter") event.target.onchange?.();
    event.stopPropagation();
  };
  const step = offers.steps && make("input", row, { type: "range", min: 0, max: offers.steps - 1, title: "step", ariaLabel: "step" });
  if (step) step.oninput = () => ask({ set: { step: step.valueAsNumber } });
  const number = step && make("span", row);
  return (state, bar) => {
    const idle = (box, value) => { if (box.getRootNode().activeElement !== box || box.type !== "text") box.value = value; };
    idle(quantity, state.quantity);
    if (![...cmap.options].some((o) => o.value === state.cmap)) make("option", cmap, { value: state.cmap, textContent: state.cmap });
    idle(cmap, state.cmap);
    idle(norm, state.norm);
    range.value = typeof state.clim === "string" ? state.clim : "fixed";
    for (const [k, end] of ends.entries()) {
      end.disabled = typeof state.clim === "string";
      if (bar && end.getRootNode().activeElement !== end) end.value = bar.range[k];
    }
    if (step) { step.value = state.step; number.textContent = `step ${state.step}`; }
  };
}

function follow(canvas, ask, probe) {
  const scale = () => canvas.width / canvas.clientWidth;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top].map((p) => p * scale());
  };
  const zoom = (k, [x, y]) => ask({ move: [k, x * (1 - k), y * (1 - k)] });
  let from = null;
  canvas.onpointerdown = (event) => { if (event.button === 0) { from = at(event); canvas.setPointerCapture(event.pointerId); } };
  canvas.onpointermove = (event) => {
    const to = at(event);
    if (!from) return probe(to);
    ask({ move: [1, to[0] - from[0], to[1] - from[1]] });
    from = to;
  };
  canvas.onpointerup = canvas.onpointercancel = () => { from = null; };
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
    zoom(Math.exp(Math.min(Math.max(-lines / 300, -1), 1)), at(event));
  }, { passive: false });
  canvas.onkeydown = (event) => {
    const middle = [canvas.width / 2, canvas.height / 2];
    if (KEYS[event.key]) ask({ move: [1, ...KEYS[event.key].map((d) => 0.1 * d * canvas.width)] });
    else if (event.key === "+" || event.key === "=") zoom(1.5, middle);
    else if (event.key === "-") zoom(1 / 1.5, middle);
    else if (event.key === "0" || event.key === "Home") ask({ home: true });
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
}

// The picture that a saved page shows, where no kernel draws; gone with the first frame.
function still(stage, png) {
  if (!png?.byteLength) return () => {};
  const url = URL.createObjectURL(new Blob([png], { type: "image/png" }));
  const image = make("img", stage, { src: url, alt: "field" });
  return () => { image.remove(); URL.revokeObjectURL(url); };
}

function render({ model, el }) {
  const root = make("div", el, { className: "ppum" });
  make("style", root, { textContent: STYLE });
  const row = make("div", root, { className: "ppum-row" });
  const stage = make("div", root, { className: "ppum-stage" });
  const canvas = make("canvas", stage, { tabIndex: 0, width: 1, height: 1, role: "img", ariaLabel: "field; arrows move, + and - zoom, 0 shows all" });
  const bar = make("div", stage, { className: "ppum-bar" });
  const heading = make("b", bar);
  const scale = make("div", bar, { className: "ppum-scale" });
  make("canvas", scale);
  const removeStill = still(stage, model.get("_still"));
  const told = make("div", root, { className: "ppum-told" });
  const error = make("div", root, { className: "ppum-error", role: "status" });
  const size = () => [canvas.clientWidth, canvas.clientHeight].map((n) => Math.round(n * (window.devicePixelRatio || 1)));
  let latest = 0, drawn = 0, place = "";

  const show = async (content, buffers) => {
    if (content.kind === "probe") { told.textContent = content.text; return; }
    place = content.place;
    error.textContent = content.error ?? "";
    update(content.state, content.bar);
    if (content.kind !== "frame") return;
    const number = (latest += 1);
    const image = await createImageBitmap(new Blob([buffers[0]], { type: "image/png" }), { colorSpaceConversion: "none" });
    if (number < drawn) return;
    drawn = number;
    if (canvas.width !== image.width || canvas.height !== image.height) Object.assign(canvas, { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.clearRect(0, 0, image.width, image.height);
    context.drawImage(image, 0, 0);
    removeStill();
    drawBar(heading, scale, content.bar, buffers[1]);
    told.textContent = place;
    canvas.dataset.version = content.version;
    canvas.dataset.frames = Number(canvas.dataset.frames ?? 0) + 1;
  };
  const post = courier(model, size, show);
  let rest = 0;
  const ask = (what) => {
    post.ask(what);
    clearTimeout(rest);
    if (what.move) rest = setTimeout(() => post.ask({}), REST);
  };
  const update = controls(row, model.get("_offers"), ask);
  follow(canvas, ask, post.probe);
  const fit = () => { canvas.style.height = `${model.get("height")}px`; };
  fit();
  model.on("change:height", fit);
  let before = "";
  const resized = new ResizeObserver(() => {
    const now = String(size());
    if (now !== before) { before = now; ask({ fit: true }); }
  });
  resized.observe(canvas);
  return () => {
    clearTimeout(rest);
    resized.disconnect();
    model.off("change:height", fit);
    post.close();
  };
}

export default { render };
