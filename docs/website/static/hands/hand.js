// What the objects of "Take it in your hand" share: a stage that can be turned, arrows, sliders, and tables of numbers.
// Nothing moves before the reader presses Play; whatever can be dragged has sliders that do the same from the keyboard.
globalThis.hand = (() => {
  const COLOUR = { angular: "#d55e00", linear: "#3a8fc8", x: "#d55e00", y: "#009e73", z: "#3a8fc8", accent: "#cc79a7", warm: "#e69f00" };
  const { add, sub, scale, dot, norm, cross, matvec, range } = se3;
  const element = (tag, properties = {}, ...inside) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...inside);
    return made;
  };
  const show = (x, digits = 2) => {
    const text = Math.abs(x) >= 1e5 || (x !== 0 && Math.abs(x) < 1e-4 && digits > 4) ? x.toExponential(2) : x.toFixed(digits);
    return (/^-[0.]*$/.test(text) ? text.slice(1) : text).replaceAll("-", "−");
  };

  // The places of a page that hold an object: each gets its words and data, and is drawn again when the colours change.
  function begin(name, build) {
    if (!globalThis.document) return; // under Node, only the numbers are asked for
    for (const root of document.querySelectorAll(`.hand[data-hand="${name}"]:not([data-ready])`)) {
      root.dataset.ready = "yes";
      const { words, data } = JSON.parse(root.querySelector('script[type="application/json"]').textContent);
      build(root, words, data);
    }
  }

  function group(root, kind, label = "") {
    const box = element("div", { className: `hand-${kind}` });
    if (label) box.append(element("p", { className: "hand-label", textContent: label }));
    if (kind === "numbers") { // on a phone they may be wider than the page
      box.tabIndex = 0;
      box.setAttribute("role", "region");
      box.setAttribute("aria-label", root.closest(".hand").querySelector("script").dataset.numbers);
    }
    root.append(box);
    return box;
  }

  // A slider with its name before it and its value behind; `value` and `set` are for what is dragged.
  function slider(box, label, { min, max, value, step = (max - min) / 200, digits = 2, unit = "", told }, changed) {
    const input = element("input", { type: "range", min, max, step: "any", value });
    input.addEventListener("keydown", (event) => {
      const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!by) return;
      event.preventDefault();
      input.value = input.valueAsNumber + by * step * (event.shiftKey ? 10 : 1);
      input.dispatchEvent(new Event("input"));
    });
    const output = element("output");
    const tell = () => {
      output.textContent = told ? told(input.valueAsNumber) : `${show(input.valueAsNumber, digits)} ${unit}`.trim();
      input.setAttribute("aria-valuetext", output.textContent);
    };
    const name = element("span");
    name.innerHTML = label;
    input.addEventListener("input", () => (tell(), changed(input.valueAsNumber)));
    box.append(element("label", { className: "hand-slider" }, name, input, output));
    tell();
    return { input, get value() { return input.valueAsNumber; }, set(x) { input.value = x; tell(); } };
  }

  function button(box, label, pressed) {
    const made = element("button", { type: "button", textContent: label });
    made.addEventListener("click", pressed);
    box.append(made);
    return made;
  }

  function choice(box, label, options, changed) {
    const select = element("select");
    select.append(...Object.entries(options).map(([value, text]) => new Option(text, value)));
    select.addEventListener("change", () => changed(select.value));
    box.append(element("label", { className: "hand-choice" }, element("span", { textContent: label }), select));
    return select;
  }

  function check(box, label, on, changed) {
    const input = element("input", { type: "checkbox", checked: on });
    input.addEventListener("change", () => changed(input.checked));
    box.append(element("label", { className: "hand-check" }, input, label));
    return input;
  }

  // Play and pause: `tick` is given the seconds since the last picture, and stops it by returning false.
  function player(box, words, tick) {
    let last = null;
    const made = button(box, words.play, () => play(last === null));
    function play(on) {
      made.textContent = on ? words.pause : words.play;
      last = on ? performance.now() : null;
      if (on) requestAnimationFrame(next);
    }
    function next(now) {
      if (last === null) return;
      const seconds = Math.min(0.1, Math.max(0, now - last) / 1000);
      last = now;
      if (tick(seconds) === false) play(false);
      else requestAnimationFrame(next);
    }
    return play;
  }

  // A table of numbers in HTML: rows with a head each.
  const table = (heads, rows, caption = "") =>
    `<table>${caption ? `<caption>${caption}</caption>` : ""}${heads.length ? `<tr>${heads.map((h) => (h ? `<th scope="col">${h}</th>` : "<td></td>")).join("")}</tr>` : ""}${rows
      .map(([head, ...cells]) => `<tr><th scope="row">${head}</th>${cells.map((c) => `<td>${c}</td>`).join("")}</tr>`).join("")}</table>`;

  // A matrix in HTML; kind(i, j) may name a class of an entry.
  const matrix = (A, name, kind = () => "", digits = 2) =>
    `<table class="hand-matrix" aria-label="${name}">${A.map((row, i) => `<tr>${row.map((x, j) => `<td class="${kind(i, j)}">${show(x, digits)}</td>`).join("")}</tr>`).join("")}</table>`;

  // A canvas on which metres are drawn. Dragging turns the view, dragging a handle moves what it belongs to.
  function stage(root, label, draw, { scale: metres = 3, centre = [0, 0, 0], yaw = 0.6, tilt = 0.35, ratio = 0.75, flat = false, handles = [] } = {}) {
    const canvas = element("canvas", flat ? {} : { tabIndex: 0 }); // the keys turn it, unless it is flat
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    canvas.style.aspectRatio = `1 / ${ratio}`;
    root.append(element("div", { className: "hand-stage" }, canvas));
    const pen = canvas.getContext("2d");
    let held = null, from = null;
    const right = () => [Math.cos(yaw), Math.sin(yaw), 0];
    const up = () => [-Math.sin(yaw) * Math.sin(tilt), Math.cos(yaw) * Math.sin(tilt), Math.cos(tilt)];
    const pixels = () => canvas.width / metres;
    const at = (p) => {
      const d = sub(p, centre);
      return [canvas.width / 2 + pixels() * dot(right(), d), canvas.height / 2 - pixels() * dot(up(), d)];
    };
    const depth = (p) => dot(cross(right(), up()), p); // larger is nearer
    const style = (name) => getComputedStyle(canvas).getPropertyValue(name).trim();
    const view = {
      canvas, pen, at, depth, unit: () => unit(),
      ink: () => style("--pst-color-text-base") || "#222",
      pale: () => style("--pst-color-border") || "#c9c9c9",
      path(points, colour, width = 2, { fill = "", dash = [], alpha = 1 } = {}) {
        pen.save();
        pen.globalAlpha = alpha;
        pen.strokeStyle = colour;
        pen.lineWidth = width * unit();
        pen.lineCap = pen.lineJoin = "round";
        pen.setLineDash(dash.map((x) => x * unit()));
        pen.beginPath();
        points.forEach((p, k) => pen[k ? "lineTo" : "moveTo"](...at(p)));
        if (fill) {
          pen.closePath();
          pen.fillStyle = fill;
          pen.fill();
        }
        if (colour) pen.stroke();
        pen.restore();
      },
      arrow(p, d, colour, width = 3) {
        const [a, b] = [at(p), at(add(p, d))], long = Math.hypot(b[0] - a[0], b[1] - a[1]);
        if (long < 2) return;
        const tip = Math.min(4 * width * unit(), 0.6 * long), along = Math.atan2(b[1] - a[1], b[0] - a[0]);
        pen.save();
        pen.strokeStyle = pen.fillStyle = colour;
        pen.lineWidth = width * unit();
        pen.beginPath();
        pen.moveTo(...a);
        pen.lineTo(b[0] - 0.8 * tip * Math.cos(along), b[1] - 0.8 * tip * Math.sin(along));
        pen.stroke();
        pen.beginPath();
        pen.moveTo(...b);
        for (const turn of [2.7, -2.7]) pen.lineTo(b[0] + tip * Math.cos(along + turn), b[1] + tip * Math.sin(along + turn));
        pen.fill();
        pen.restore();
      },
      dot(p, colour, radius = 5, ring = "") {
        pen.save();
        pen.beginPath();
        pen.arc(...at(p), radius * unit(), 0, 7);
        pen.fillStyle = colour;
        pen.fill();
        pen.strokeStyle = ring;
        pen.lineWidth = 2 * unit();
        if (ring) pen.stroke();
        pen.restore();
      },
      text(p, words, colour = view.ink(), by = [6, -6]) {
        pen.font = `${14 * unit()}px system-ui, sans-serif`;
        const [x, y] = at(p), wide = pen.measureText(words).width;
        pen.fillStyle = colour;
        pen.fillText(words, Math.max(2, Math.min(canvas.width - wide - 2, x + by[0] * unit())), y + by[1] * unit());
      },
      frame(T, name, long = 0.5, width = 3) {
        ["x", "y", "z"].forEach((axis, k) => {
          const d = scale(long, T.R.map((row) => row[k]));
          view.arrow(T.p, d, COLOUR[axis], width);
          view.text(add(T.p, scale(1.12, d)), axis, COLOUR[axis], [-3, 4]);
        });
        if (name) view.text(T.p, name, view.ink(), [-18, 16]);
      },
      box(T, size, colour, { width = 2, fill = "" } = {}) {
        const corner = (k) => se3.act(T, size.map((s, i) => (((k >> i) & 1) - 0.5) * s));
        const faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]].map((f) => f.map(corner));
        const height = (f) => f.reduce((sum, p) => sum + depth(p), 0);
        faces.sort((a, b) => height(a) - height(b)).forEach((f) => view.path([...f, f[0]], colour, width, { fill }));
      },
      floor(half = 1.5, step = 0.5, z = 0) {
        for (let k = -half; k <= half + 1e-9; k += step) {
          view.path([[k, -half, z], [k, half, z]], view.pale(), 1);
          view.path([[-half, k, z], [half, k, z]], view.pale(), 1);
        }
      },
      handles: () => handles.forEach((h) => view.dot(h.at(), style("--pst-color-background") || "#fff", 7, h.colour ?? COLOUR.accent)),
      redraw,
    };
    const unit = () => canvas.width / Math.max(1, canvas.clientWidth);
    function redraw() {
      pen.clearRect(0, 0, canvas.width, canvas.height);
      draw(view);
      view.handles();
    }
    function fit() {
      const wide = Math.max(200, Math.round(canvas.clientWidth * devicePixelRatio));
      if (wide === canvas.width) return;
      canvas.width = wide;
      canvas.height = Math.round(wide * ratio);
      redraw();
    }
    const turn = (a, b) => {
      if (flat) return;
      yaw += a;
      tilt = Math.max(-0.2, Math.min(1.5, tilt + b));
      redraw();
    };
    canvas.addEventListener("pointerdown", (event) => {
      const box = canvas.getBoundingClientRect(), k = canvas.width / box.width;
      const [x, y] = [(event.clientX - box.left) * k, (event.clientY - box.top) * k];
      const far = (h) => Math.hypot(at(h.at())[0] - x, at(h.at())[1] - y);
      const near = handles.filter((h) => far(h) < 26 * unit()).sort((a, b) => far(a) - far(b));
      held = near[0] ?? null;
      from = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
      if (held) event.preventDefault();
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons || !from) return;
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]].map((d) => (d * canvas.width) / canvas.clientWidth / pixels());
      from = [event.clientX, event.clientY];
      if (!held) return turn((-dx * pixels()) / (150 * unit()), (dy * pixels()) / (150 * unit()));
      const level = held.level ? Math.max(0.25, Math.sin(tilt)) : 0; // in a level plane, a step up is a step away
      const away = [-Math.sin(yaw), Math.cos(yaw), 0];
      held.move(add(scale(dx, right()), level ? scale(-dy / level, away) : scale(-dy, up())));
      redraw();
    });
    for (const over of ["pointerup", "pointercancel"]) canvas.addEventListener(over, () => (from = held = null));
    canvas.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
      if (!by || flat) return;
      event.preventDefault();
      turn(...by);
    });
    new ResizeObserver(fit).observe(canvas);
    new MutationObserver(redraw).observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
    return Object.assign(view, { fit });
  }

  return { COLOUR, element, show, begin, group, slider, button, choice, check, player, table, matrix, stage };
})();
