
(() => {
  const at = id => document.getElementById(id);
  const canvas = at("image");
  const context = canvas.getContext("2d");
  const start = JSON.parse(at("start").textContent);
  const scene = start.scene;
  let about = null; // what is in the dataset
  let view = null; // centre and width
  let size = 1; // larger side of the domain

  // --- workers ---------------------------------------------------------------------------------

  // Workers that evaluate rows: as many as there are cores, and so many that their copies of the
  // dataset do not fill the memory.
  const MOST_WORKERS = 8;
  const MEMORY = 256 << 20;
  let workers = [];

  class Worker_ {
    constructor(port) {
      this.port = port;
      this.waiting = new Map();
      this.count = 0;
      port.onmessage = ({ data: { id, answer, reason } }) => {
        const { resolve, reject } = this.waiting.get(id);
        this.waiting.delete(id);
        if (reason === undefined) resolve(answer);
        else reject(new Error(reason));
      };
    }

    ask(task, message, transfer = []) {
      const id = this.count++;
      this.port.postMessage({ id, task, ...message }, transfer);
      return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    }
  }

  function background() {
    const url = URL.createObjectURL(new Blob([`(${work})(self)`], { type: "text/javascript" }));
    return new Worker_(new Worker(url));
  }

  function foreground() {
    const [here, there] = [{}, {}];
    // each message waits for a turn, so that the page stays alive between two strips
    here.postMessage = data => setTimeout(() => there.onmessage({ data }));
    there.postMessage = data => setTimeout(() => here.onmessage({ data }));
    work(there);
    return new Worker_(here);
  }

  function decoded(id) {
    const element = at(id);
    const text = atob(element.textContent);
    element.remove();
    return Uint8Array.from(text, c => c.charCodeAt(0));
  }

  async function inflated(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
  }

  async function open() {
    const module = await WebAssembly.compile(await inflated(decoded("evaluator")));
    const dataset = decoded("dataset");
    const fits = Math.max(1, Math.floor(MEMORY / (8 * dataset.length + (8 << 20))));
    const count = Math.min(navigator.hardwareConcurrency || 2, MOST_WORKERS, fits);
    const opened = worker => worker.ask("open", { module, dataset }).then(() => worker);
    let first;
    try {
      first = await opened(background());
    } catch (error) {
      // some browsers give pages from disk no workers
      console.info(error);
      first = await opened(foreground());
      workers = [first];
      return;
    }
    workers = [first];
    for (let k = 1; k < count; k++) {
      opened(background()).then(worker => workers.push(worker), report);
    }
  }

  // --- the view --------------------------------------------------------------------------------

  const DEEPEST = 1e-12; // in parts of the domain
  const WIDEST = 8;
  const pixelSize = () => view.width / canvas.width;
  const density = () => canvas.width / canvas.clientWidth;

  function limited(width) {
    return Math.min(Math.max(width, DEEPEST * size), WIDEST * size);
  }

  function whole() {
    const [[x0, y0], [x1, y1]] = about.bounds;
    const aspect = canvas.width / canvas.height;
    const margin = 1.04;
    const width = margin * Math.max(x1 - x0, (y1 - y0) * aspect);
    return { center: [0.5 * (x0 + x1), 0.5 * (y0 + y1)], width, isWhole: true };
  }

  function shaped({ center, width, pixels: [columns, rows] }) {
    const aspect = canvas.width / canvas.height;
    return { center, width: Math.max(width, ((width * rows) / columns) * aspect) };
  }

  // Offset from the centre of continuous pixel coordinates.
  function offset([x, y]) {
    const s = pixelSize();
    return [(x - 0.5 * canvas.width) * s, (0.5 * canvas.height - y) * s];
  }

  // A point, anchor + offset, so that the view stays as exact as the point.
  function spot(pixel) {
    return hover && isNear(hover, pixel) ? hover : { anchor: view.center, offset: offset(pixel) };
  }

  function zoom(factor, pixel) {
    const { anchor, offset: way } = spot(pixel);
    const width = limited(view.width / factor);
    const part = width / view.width;
    const center = [0, 1].map(k => anchor[k] + (way[k] + part * (view.center[k] - anchor[k] - way[k])));
    move({ center, width });
  }

  function pan(dx, dy) {
    const s = pixelSize();
    const [x, y] = view.center;
    move({ center: [x - dx * s, y + dy * s], width: view.width });
  }

  // What moves is drawn with the range that it had; the range is found anew at rest.
  const REST = 150;
  let lastMove = -Infinity;
  let rest = 0;

  function move(next) {
    view = next;
    lastMove = performance.now();
    clearTimeout(rest);
    rest = setTimeout(redraw, REST);
    present();
    redraw();
    look();
  }

  // --- images ----------------------------------------------------------------------------------

  const BAND = 32;
  const PATIENCE = 40; // milliseconds for an image that follows a movement
  let pace = 2e-4; // milliseconds per pixel of an image of a view that moves, as measured
  let isDirty = false;
  let isBusy = false;
  let known = null; // key of the values that the painter holds
  let shown = null; // the last image: pixels on a canvas, and where they are seen

  const copy = value => JSON.parse(JSON.stringify(value));

  function frame(coarseness) {
    const pixels = [canvas.width, canvas.height].map(n => Math.ceil(n / coarseness));
    const width = view.width * ((pixels[0] * coarseness) / canvas.width);
    const isMoving = performance.now() - lastMove < REST;
    const seen = { center: [...view.center], width: coarseness === 1 ? view.width : width, pixels };
    const drawn = copy(scene);
    // lines of coarse images would be as coarse; those that have to be found wait for a view at rest
    if (coarseness > 1) drawn.overlays.shown = [];
    if (coarseness > 1 || isMoving) Object.assign(drawn.overlays, { isolines: null, arrows: null, crosses: null });
    return { scene: drawn, view: seen, file: start.file, keeps_range: isMoving };
  }

  function redraw() {
    isDirty = true;
    if (!isBusy && about) draw();
  }

  async function draw() {
    isBusy = true;
    while (isDirty) {
      isDirty = false;
      try {
        const coarseness = Math.ceil(Math.sqrt((canvas.width * canvas.height * pace) / PATIENCE));
        const key = key_of(frame(1));
        if (coarseness > 1 && key !== known) await image(frame(coarseness), () => false);
        const legend = isDirty ? null : await image(frame(1), () => isDirty);
        say(legend?.notices.join("\n") ?? "", true);
      } catch (error) {
        report(error);
      }
    }
    isBusy = false;
  }

  const key_of = ({ view, scene: { quantity, subject } }) => JSON.stringify([view, quantity, subject]);

  // Evaluates, paints and shows an image, unless it is not wanted any more.
  async function image(frame, isOff) {
    const key = key_of(frame);
    const begin = performance.now();
    let strips;
    if (key !== known) {
      // each strip takes the place of the values that the painter holds, also if not all are wanted
      known = null;
      strips = await values(frame, isOff);
      if (!strips) return;
    }
    known = null;
    const transfer = strips ? strips.map(strip => strip.buffer) : [];
    const { legend, pixels } = await workers[0].ask("paint", { frame, strips }, transfer);
    known = key;
    if (strips && frame.keeps_range) pace = (performance.now() - begin) / (pixels.length / 4);
    show(frame, new ImageData(pixels, ...frame.view.pixels));
    describe(legend);
    return legend;
  }

  // The values of all rows; each worker takes the next strip when it has finished one.
  async function values(frame, isOff) {
    const rows = frame.view.pixels[1];
    const team = [...workers];
    const height = BAND * Math.max(1, Math.ceil(rows / (BAND * 3 * team.length)));
    const strips = [];
    let next = 0;
    const member = async worker => {
      while (next < rows && !isOff()) {
        const first = next;
        next = Math.min(rows, first + height);
        strips[first / height] = await worker.ask("rows", { rows: { frame, rows: [first, next] } });
      }
    };
    await Promise.all(team.map(member));
    return next < rows ? null : strips;
  }

  function show({ view: seen }, data) {
    const layer = new OffscreenCanvas(data.width, data.height);
    layer.getContext("2d").putImageData(data, 0, 0);
    if (!shown) performance.mark("first image");
    shown = { view: seen, layer, data };
    present();
  }

  // Shows the last image where it lies in the view: as it is, moved, or scaled.
  function present() {
    if (!shown) return;
    const { view: seen, layer, data } = shown;
    const isSame = seen.width === view.width && seen.pixels[0] === canvas.width
      && seen.pixels[1] === canvas.height && [0, 1].every(k => seen.center[k] === view.center[k]);
    if (isSame) {
      context.putImageData(data, 0, 0);
    } else {
      const s = pixelSize();
      const scale = seen.width / seen.pixels[0] / s;
      const [dx, dy] = [0, 1].map(k => (seen.center[k] - view.center[k]) / s);
      const [w, h] = seen.pixels.map(n => n * scale);
      context.clearRect(0, 0, canvas.width, canvas.height);
      context.imageSmoothingEnabled = false;
      context.drawImage(layer, 0.5 * canvas.width + dx - 0.5 * w, 0.5 * canvas.height - dy - 0.5 * h, w, h);
    }
    ruler();
    mark();
  }

  // --- beside the image ------------------------------------------------------------------------

  // Text with subscripts `_{…}`; whatever else it holds is text.
  function rich(element, text) {
    const parts = text.split(/_\{(.*?)\}/);
    element.replaceChildren(...parts.map((part, k) => {
      if (k % 2 === 0) return part;
      const sub = document.createElement("sub");
      sub.textContent = part;
      return sub;
    }));
  }

  const plain = text => text.replace(/_\{(.*?)\}/g, "$1");

  function describe(legend) {
    const { colors, range, ticks, beyond, extremes } = legend;
    rich(at("bar-label"), legend.label);
    const stops = colors.length === 64
      ? colors
      : colors.flatMap((color, k) => [k, k + 1].map(end => `${color} ${(100 * end) / colors.length}%`));
    at("bar-colors").style.background = colors.length === 1 ? colors[0] : `linear-gradient(to right, ${stops})`;
    at("bar-low").textContent = beyond[0] ? `◀ ${extremes[0] ?? ""}` : "";
    at("bar-high").textContent = beyond[1] ? `${extremes[1] ?? ""} ▶` : "";
    at("bar-ticks").replaceChildren(...ticks.map(({ at: place, label }) => {
      const tick = document.createElement("span");
      tick.textContent = label;
      tick.dataset.at = place;
      return tick;
    }));
    placeTicks();
    at("bar").title = legend.sentence;
    at("about").textContent = legend.sentence;
    if (at("range").value !== "fixed") {
      [at("from").value, at("to").value] = range.map(value => String(Number(value.toPrecision(6))));
    }
    at("command").value = legend.command;
  }

  // Marks stand below the colours, wherever these begin.
  function placeTicks() {
    const [colors, row] = [at("bar-colors"), at("bar-ticks")].map(element => element.getBoundingClientRect());
    for (const tick of at("bar-ticks").children) {
      tick.style.left = `${colors.left - row.left + tick.dataset.at * colors.width}px`;
    }
  }

  // A bar of 1, 2 or 5 × 10^k, at most a fifth of the image.
  function ruler() {
    const most = view.width / 5;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map(digit => digit * power).find(value => value <= most);
    at("scale").style.width = `${(length / view.width) * canvas.clientWidth}px`;
    at("scale-label").textContent = Number(length.toPrecision(1)).toString();
  }

  function say(text, isNote = false) {
    at("message").textContent = text;
    at("message").hidden = !text;
    at("message").classList.toggle("note", isNote);
  }

  const report = error => say(error.message);

  // --- reading values --------------------------------------------------------------------------

  const REACH = 5; // CSS pixels within which a crack or a tip takes the pointer's place
  let pointer = null; // continuous pixel coordinates
  let isExact = false; // true while Shift keeps the point where it is
  let hover = null; // the last reading
  let isReading = false;
  let looks = 0; // wishes to read

  async function look() {
    looks++;
    if (isReading || !about) return;
    isReading = true;
    for (let done = 0; done !== looks;) {
      done = looks;
      await read();
    }
    isReading = false;
    mark();
  }

  async function read() {
    if (!pointer) {
      quiet();
      return;
    }
    const pixel = pointer;
    const question = { frame: frame(1), pixel, reach: isExact ? 0 : REACH * density() };
    try {
      const reading = await workers[workers.length - 1].ask("probe", { question });
      reading.isSnapped = Math.hypot(reading.pixel[0] - pixel[0], reading.pixel[1] - pixel[1]) > 1e-6;
      hover = reading;
      tell(reading);
    } catch {
      hover = null; // the image says what is wrong
    }
  }

  function quiet() {
    hover = null;
    at("reading").textContent = "Point at the plot to read values.";
    at("mark").hidden = true;
  }

  function tell({ place, sides, tip, jump, is_inside: isInside }) {
    const name = plain(label());
    const lines = [tip === null || place.startsWith("tip") ? place : `${place}, tip ${tip}`];
    if (!isInside) {
      lines.push("outside the domain");
    } else {
      const values = sides.map(side => side.value + (side.name ? ` ${side.name}` : ""));
      lines[0] += `   ${name} = ${values.join(", ")}${jump === null ? "" : `, jump ${jump}`}`;
      const gradients = sides.map(side => side.gradient).filter(text => text !== null);
      if (gradients.length) lines.push(`gradient ${gradients.join(", ")}`);
    }
    at("reading").replaceChildren(...lines.map(line => {
      const row = document.createElement("div");
      row.textContent = line;
      return row;
    }));
  }

  function label() {
    const text = scene.quantity ?? about.quantity;
    return text.length > 40 ? `${text.slice(0, 39)}…` : text;
  }

  function mark() {
    const isMarked = hover && (hover.isSnapped || document.activeElement === canvas && isKeyed);
    at("mark").hidden = !isMarked;
    if (!isMarked) return;
    const s = pixelSize();
    const [x, y] = [0, 1].map(k => (hover.anchor[k] - view.center[k] + hover.offset[k]) / s);
    at("mark").style.left = `${(0.5 * canvas.width + x) / density()}px`;
    at("mark").style.top = `${(0.5 * canvas.height - y) / density()}px`;
  }

  // --- pointers --------------------------------------------------------------------------------

  const pressed = new Map();
  let isKeyed = false; // true if keys have moved the point that is read

  const place = event => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top].map(v => v * density());
  };

  const middle = points => [0, 1].map(k => points.reduce((sum, p) => sum + p[k], 0) / points.length);
  const spread = ([a, b]) => (b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0);

  canvas.addEventListener("pointerdown", event => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    pressed.set(event.pointerId, place(event));
    point(event);
  });

  canvas.addEventListener("pointermove", event => {
    if (!pressed.has(event.pointerId)) {
      point(event);
      return;
    }
    const before = [...pressed.values()];
    pressed.set(event.pointerId, place(event));
    const after = [...pressed.values()];
    const [from, to] = [before, after].map(middle);
    pointer = to;
    pan(to[0] - from[0], to[1] - from[1]);
    if (after.length === 2 && spread(before) > 0 && spread(after) > 0) zoom(spread(after) / spread(before), to);
  });

  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, event => pressed.delete(event.pointerId));
  }

  canvas.addEventListener("pointerleave", event => {
    if (event.pointerType === "touch" || isKeyed) return;
    pointer = null;
    look();
  });

  function point(event) {
    pointer = place(event);
    isExact = event.shiftKey;
    isKeyed = false;
    look();
  }

  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    const step = -event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.002);
    pointer = place(event);
    zoom(Math.exp(Math.max(-1, Math.min(1, step))), pointer);
  }, { passive: false });

  // True if a reading is that of a pixel, or snapped from it.
  function isNear({ anchor, offset: way, isSnapped }, [x, y]) {
    const s = pixelSize();
    const [dx, dy] = [0, 1].map(k => (anchor[k] - view.center[k] + way[k]) / s);
    const distance = Math.hypot(0.5 * canvas.width + dx - x, 0.5 * canvas.height - dy - y);
    return isSnapped && distance <= REACH * density() + 1;
  }

  canvas.addEventListener("dblclick", () => move(whole()));

  // --- keys ------------------------------------------------------------------------------------

  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const KEYS = {
    "+": () => zoomBy(1.5),
    "=": () => zoomBy(1.5),
    "-": () => zoomBy(1 / 1.5),
    0: () => move(whole()),
    Home: () => move(whole()),
    t: () => nextTip(),
    "[": () => stepTo(scene.subject.step - 1),
    "]": () => stepTo(scene.subject.step + 1),
    " ": () => play(),
    c: () => copyValues(),
    Escape: () => {
      [pointer, isKeyed] = [null, false];
      look();
    },
  };

  canvas.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = ARROWS[event.key];
    if (arrow && event.shiftKey) carry(arrow);
    else if (arrow) pan(...arrow.map((v, k) => (-v * [canvas.width, canvas.height][k]) / 8));
    else if (KEYS[event.key]) KEYS[event.key]();
    else return;
    event.preventDefault();
  });

  function zoomBy(factor) {
    zoom(factor, isKeyed && pointer ? pointer : [0.5 * canvas.width, 0.5 * canvas.height]);
  }

  // Moves the point that is read.
  function carry([x, y]) {
    const from = pointer ?? [0.5 * canvas.width, 0.5 * canvas.height];
    const step = 4 * density();
    pointer = [from[0] + x * step, from[1] + y * step];
    [isKeyed, isExact] = [true, false];
    look();
  }

  function copyValues() {
    if (hover) navigator.clipboard?.writeText(hover.text).catch(report);
  }

  // --- controls --------------------------------------------------------------------------------

  function options(select, groups) {
    select.replaceChildren(...groups.map(([title, choices]) => {
      const group = document.createElement("optgroup");
      group.label = title;
      group.append(...choices.map(({ text, label: words }) => new Option(words, text)));
      return group;
    }));
  }

  const FORMULA = "\u0000formula";

  function fill() {
    const named = ({ text, label: words }) => ({ text, label: plain(words) });
    options(at("quantity"), [
      ["Quantities", about.quantities.map(named)],
      ["Values of cells", about.cells.map(named)],
      ["Other", [{ text: FORMULA, label: "Formula" }]],
    ]);
    at("tips").hidden = about.tips.length === 0;
    at("tip").replaceChildren(new Option("", ""), ...about.tips.map((_, k) => new Option(`Tip ${k}`, k)));
    at("series").hidden = about.loads.length < 2;
    at("step").max = about.loads.length - 1;
    reflect();
  }

  // Shows in the controls what is chosen.
  function reflect() {
    const { quantity, colors, overlays, subject } = scene;
    const text = quantity ?? about.quantity;
    const isListed = [...about.quantities, ...about.cells].some(choice => choice.text === text);
    at("quantity").value = isListed ? text : FORMULA;
    at("formula").value = isListed ? "" : text;
    const map = colors.colormap ?? "";
    at("reversed").checked = map.endsWith("_r");
    at("colormap").value = map.replace(/_r$/, "");
    at("color-scale").value = colors.scale;
    if (at("range-error").hidden) {
      const isNamed = ["auto", "full"].includes(colors.range);
      at("range").value = isNamed ? colors.range : "fixed";
      if (!isNamed && !colors.range.includes("%")) [at("from").value, at("to").value] = colors.range.split(",");
    }
    at("cracks").checked = overlays.shown.includes("cracks");
    at("cells").checked = overlays.shown.includes("cells");
    at("isolines").checked = overlays.isolines !== null;
    if (overlays.isolines !== null) at("levels").value = overlays.isolines;
    at("step").value = subject.step;
    const load = about.loads[subject.step];
    at("load").textContent = `${subject.step} of ${about.loads.length - 1}, load ${Number(load.toPrecision(6))}`;
  }

  function change(id, action, event = "change") {
    at(id).addEventListener(event, () => {
      action(at(id));
      reflect();
      redraw();
      look();
    });
  }

  change("quantity", ({ value }) => {
    if (value === FORMULA) at("formula").focus();
    else scene.quantity = value;
  });
  change("formula", ({ value }) => {
    if (value.trim()) scene.quantity = value.trim();
  });
  const map = () => {
    const name = at("colormap").value || (at("reversed").checked ? "viridis" : "");
    scene.colors.colormap = name ? name + (at("reversed").checked ? "_r" : "") : null;
  };
  change("colormap", map);
  change("reversed", map);
  change("color-scale", ({ value }) => { scene.colors.scale = value; });
  // What is no range stays as it was typed, and the image as it is.
  const refuseRange = reason => {
    for (const id of ["from", "to"]) at(id).setAttribute("aria-invalid", String(Boolean(reason)));
    at("range-error").textContent = reason;
    at("range-error").hidden = !reason;
    if (reason) at("range").value = "fixed";
  };
  const range = () => {
    const numbers = [at("from"), at("to")].map(({ value }) => (value.trim() ? Number(value) : NaN));
    const isRange = numbers[0] < numbers[1] && numbers.every(Number.isFinite);
    const reason = numbers.every(Number.isFinite) ? "From has to be less than To." : "Give two numbers.";
    refuseRange(isRange ? "" : reason);
    if (isRange) scene.colors.range = numbers.join(",");
  };
  change("range", ({ value }) => {
    refuseRange("");
    if (value === "fixed") range();
    else scene.colors.range = value;
  });
  change("from", range);
  change("to", range);
  const overlay = ({ id, checked }) => {
    const others = scene.overlays.shown.filter(name => name !== id);
    scene.overlays.shown = checked ? [...others, id] : others;
  };
  change("cracks", overlay);
  change("cells", overlay);
  const levels = () => {
    scene.overlays.isolines = at("isolines").checked ? at("levels").value.trim() || "auto" : null;
  };
  change("isolines", levels);
  change("levels", levels);
  // Overlays that `ppum export` switched on and that have no check box yet.
  const spacing = { arrows: scene.overlays.arrows, crosses: scene.overlays.crosses };
  const distance = ({ id, checked }) => { scene.overlays[id] = checked ? spacing[id] : null; };
  for (const id of [...scene.overlays.shown, ...Object.keys(spacing).filter(name => spacing[name])]) {
    if (at(id)) continue;
    const input = Object.assign(document.createElement("input"), { id, type: "checkbox", checked: true });
    const label = Object.assign(document.createElement("label"), { className: "check" });
    label.append(input, ` ${id[0].toUpperCase()}${id.slice(1)}`);
    at("levels").parentElement.before(label);
    change(id, id in spacing ? distance : overlay);
  }
  change("tip", ({ value }) => { if (value !== "") goTo(Number(value)); });

  at("controls").addEventListener("submit", event => event.preventDefault());
  at("whole").addEventListener("click", () => move(whole()));
  at("in").addEventListener("click", () => zoomBy(2));
  at("out").addEventListener("click", () => zoomBy(0.5));
  at("save").addEventListener("click", () => canvas.toBlob(blob => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${start.file.replace(/\.\w+$/, "")}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
  }));

  function goTo(tip) {
    at("tip").value = tip;
    hover = null;
    move({ center: [...about.tips[tip]], width: Math.min(view.width, 0.1 * whole().width) });
  }

  function nextTip() {
    const count = about.tips.length;
    if (count) goTo((Number(at("tip").value || -1) + 1) % count);
  }

  // --- series ----------------------------------------------------------------------------------

  let player = 0;
  let asked = 0; // steps whose description is on its way

  async function stepTo(step) {
    if (!(step in about.loads)) return;
    scene.subject.step = step;
    asked++;
    try {
      about = await workers[0].ask("describe", { step });
    } finally {
      asked--;
    }
    if (asked > 0) return;
    fill();
    redraw();
    look();
  }

  at("step").addEventListener("input", () => stepTo(Number(at("step").value)));
  at("play").addEventListener("click", () => play());

  function play() {
    if (about.loads.length < 2) return;
    clearInterval(player);
    const isPlaying = at("play").getAttribute("aria-pressed") === "true";
    at("play").setAttribute("aria-pressed", String(!isPlaying));
    at("play").textContent = isPlaying ? "Play" : "Stop";
    const next = () => {
      if (!isBusy && !asked) stepTo((scene.subject.step + 1) % about.loads.length);
    };
    if (!isPlaying) player = setInterval(next, 250);
  }

  // --- theme and size --------------------------------------------------------------------------

  const dark = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => (document.documentElement.dataset.theme ?? (dark.matches ? "dark" : "light")) === "dark";
  const nameTheme = () => { at("theme").textContent = isDark() ? "Light" : "Dark"; };
  at("theme").addEventListener("click", () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    nameTheme();
  });
  dark.addEventListener("change", nameTheme);

  function fit() {
    const ratio = devicePixelRatio || 1;
    const box = canvas.getBoundingClientRect();
    const [columns, rows] = [box.width, box.height].map(v => Math.max(1, Math.round(v * ratio)));
    if (columns === canvas.width && rows === canvas.height) return;
    const scale = columns / canvas.width;
    [canvas.width, canvas.height] = [columns, rows];
    if (!view) return;
    view = view.isWhole ? whole() : { ...view, width: limited(view.width * scale) };
    present();
    redraw();
    placeTicks();
  }

  async function begin() {
    nameTheme();
    fit();
    await open();
    const last = await workers[0].ask("describe", { step: 0 });
    scene.subject.step ??= last.loads.length - 1;
    about = scene.subject.step === 0 ? last : await workers[0].ask("describe", { step: scene.subject.step });
    const [[x0, y0], [x1, y1]] = about.bounds;
    size = Math.max(x1 - x0, y1 - y0);
    at("colormap").replaceChildren(new Option("Default", ""), ...about.colormaps.map(name => new Option(name, name)));
    fill();
    view = start.view ? shaped(start.view) : whole();
    quiet();
    redraw();
    new ResizeObserver(fit).observe(canvas);
    // for scripts: the tests, and those that people write
    globalThis.page = {
      get view() { return view; },
      get scene() { return scene; },
      get hover() { return hover; },
      get isAtRest() {
        return !(isBusy || isDirty || isReading || asked) && performance.now() - lastMove > 2 * REST;
      },
      get pace() { return pace; },
      get workers() { return workers.length; },
      move,
    };
  }

  begin().catch(error => {
    at("reading").textContent = "";
    report(error);
  });
})();
