// Translate my numbers: q, v, a and τ of a floating base from one convention into another (docs/conventions.md).
hand.translate = (() => {
  const { add, sub, cross, matvec, transpose, fromQuaternion } = se3;
  const own = { q: ["position", "real", "imaginary"], v: ["angular", "linear"], turned: [] };
  // Which pieces come in which order, and which of the two are in the axes of the world.
  const SIDES = {
    chapter: own,
    twistwrench: { ...own, q: ["position", "imaginary", "real"] },
    pinocchio: { q: ["position", "imaginary", "real"], v: ["linear", "angular"], turned: [] },
    mujoco: { q: ["position", "real", "imaginary"], v: ["linear", "angular"], turned: ["linear"] },
    drake: { q: ["real", "imaginary", "position"], v: ["angular", "linear"], turned: ["angular", "linear"] },
  };
  const LENGTH = { position: 3, imaginary: 3, real: 1, angular: 3, linear: 3 };

  function take(numbers, order) {
    const pieces = {};
    let k = 0;
    for (const name of order) pieces[name] = numbers.slice(k, (k += LENGTH[name]));
    return { ...pieces, rest: numbers.slice(k) };
  }

  const put = (pieces, order) => [...order.flatMap((name) => pieces[name]), ...pieces.rest];
  const length = (q, side) => {
    const { real, imaginary } = take(q, SIDES[side].q);
    return Math.hypot(...real, ...imaginary);
  };

  // The rotation of the base; q need not have length 1 to the last digit.
  function rotation(q, side) {
    const { real, imaginary } = take(q, SIDES[side].q), size = length(q, side);
    return fromQuaternion([...imaginary, ...real].map((x) => x / size));
  }

  // Into the base's axes with R transposed, or out of them with R, what is in the axes of the world.
  const turn = (pieces, side, R) =>
    Object.fromEntries(Object.entries(pieces).map(([name, x]) => [name, SIDES[side].turned.includes(name) ? matvec(R, x) : x]));

  function state({ q, v, a, tau }, from, to) {
    const R = q && rotation(q, from), out = {};
    if (q) out.q = put(take(q, SIDES[from].q), SIDES[to].q);
    const inside = (x) => turn(take(x, SIDES[from].v), from, R && transpose(R));
    const outside = (pieces) => put(turn(pieces, to, R), SIDES[to].v);
    if (v) out.v = outside(inside(v));
    if (tau) out.tau = outside(inside(tau));
    if (a) { // in the axes of the world the linear part is that of a point: ω × v more
      const pieces = inside(a), twist = v && inside(v), more = twist && cross(twist.angular, twist.linear);
      if (SIDES[from].turned.length) pieces.linear = sub(pieces.linear, more);
      if (SIDES[to].turned.length) pieces.linear = add(pieces.linear, more);
      out.a = outside(pieces);
    }
    return out;
  }

  // Whether the axes differ: then q is needed, and for an acceleration v too.
  const needs = (from, to) => ["angular", "linear"].some((k) => SIDES[from].turned.includes(k) !== SIDES[to].turned.includes(k));
  return { SIDES, state, length, needs };
})();

hand.begin("translate", (root, words) => {
  const { SIDES, state, length, needs } = hand.translate, { element } = hand;
  const NAMES = { chapter: words.chapter, twistwrench: "twistwrench", pinocchio: "Pinocchio", mujoco: "MuJoCo", drake: "Drake" };
  const START = {
    q: "0.1 0.2 0.3  0 0 0.6 0.8  0.1 0.9 -1.8", v: "0.5 0 0  0 0 1  0.2 0 0", a: "", tau: "",
  };
  const sides = hand.group(root, "controls"), fields = hand.group(root, "fields"), says = hand.group(root, "says");
  says.setAttribute("role", "status");
  const from = hand.choice(sides, words.from, NAMES, translate), to = hand.choice(sides, words.to, NAMES, translate);
  hand.button(sides, words.swap, () => {
    const results = Object.fromEntries(Object.entries(rows).map(([k, row]) => [k, row.out.value]));
    [from.value, to.value] = [to.value, from.value];
    for (const [k, row] of Object.entries(rows)) if (results[k]) row.in.value = results[k];
    translate();
  });
  [from.value, to.value] = ["pinocchio", "mujoco"];
  const rows = {};
  for (const [k, name] of Object.entries({ q: "q", v: "v", a: "a", tau: "τ" })) {
    const box = element("textarea", { value: START[k], rows: 2, spellcheck: false });
    const out = element("textarea", { rows: 2, readOnly: true });
    const wrong = element("p", { className: "hand-wrong", id: `hand-wrong-${k}` });
    box.setAttribute("aria-describedby", wrong.id);
    box.addEventListener("input", translate);
    const copy = element("button", { type: "button" });
    const say = (word) => ((copy.textContent = word), copy.setAttribute("aria-label", `${word}: ${name}`));
    say(words.copy);
    copy.addEventListener("click", () => {
      out.select();
      if (document.execCommand("copy")) say(words.copied), setTimeout(() => say(words.copy), 2000);
    });
    const order = [element("small"), element("small")];
    const label = (text, field, small) => element("label", {}, element("span", {}, element("b", { textContent: text }), " ", small), field);
    fields.append(element("div", { className: "hand-row" }, label(name, box, order[0]), label(`${name} →`, out, order[1]), copy, wrong));
    rows[k] = { in: box, out, wrong, order };
  }

  const numbers = (text) => (text.replace(/np\.|numpy\.|array|[[\](),;]/g, " ").trim() || null)?.split(/\s+/).map((x) => Number(x.replace("−", "-")));
  const fill = (text, values) => text.replace(/\{(\w+)\}/g, (_, name) => values[name]);
  const written = (x, _, all) => String(Math.abs(x) < 4e-16 * Math.max(...all.map(Math.abs)) ? 0 : Number(x.toPrecision(12)));

  // What is wrong with the numbers of a field, or nothing.
  function complaint(k, x, given) {
    if (x.some(Number.isNaN)) return words.not_number;
    if (x.length < (k === "q" ? 7 : 6)) return fill(words.short, { least: k === "q" ? 7 : 6, got: x.length });
    if (k === "q" && Math.abs(length(x, from.value) - 1) > 1e-3) {
      const other = Object.keys(SIDES).find((side) => Math.abs(length(x, side) - 1) < 1e-3);
      const size = hand.show(length(x, from.value), 3);
      return fill(words.not_unit, { size }) + (other ? fill(words.would_be, { side: NAMES[other] }) : "");
    }
    if (k !== "q" && needs(from.value, to.value) && !given.q) return words.need_q;
    if (k === "a" && needs(from.value, to.value) && !given.v) return words.need_v;
    return "";
  }

  function translate() {
    const given = {}, good = {};
    for (const k of Object.keys(rows)) given[k] = numbers(rows[k].in.value);
    for (const [k, row] of Object.entries(rows)) {
      row.wrong.textContent = given[k] ? complaint(k, given[k], good) : "";
      if (given[k] && !row.wrong.textContent) good[k] = given[k];
      [from, to].forEach((side, n) => (row.order[n].innerHTML = words[`${k === "q" ? "q" : "v"}_${side.value}`]));
    }
    const out = state(good, from.value, to.value);
    for (const [k, row] of Object.entries(rows)) row.out.value = out[k] ? out[k].map(written).join(" ") : "";
    const done = [];
    const [a, b] = [SIDES[from.value], SIDES[to.value]];
    const same = (x, y) => x.join() === y.join();
    if (!same(a.q, b.q)) done.push(words.reorder_q);
    if (!same(a.v, b.v)) done.push(words.reorder_v);
    const differ = b.turned.concat(a.turned).filter((k) => a.turned.includes(k) !== b.turned.includes(k));
    if (differ.length) {
      const text = b.turned.length > a.turned.length ? words.turn_out : words.turn_in;
      done.push(fill(text, { parts: differ.map((k) => words[k]).join(words.and) }));
    }
    if (needs(from.value, to.value) && a.turned.length * b.turned.length === 0) done.push(words.classical);
    if (!done.length) done.push(words.same);
    says.innerHTML = `<p>${[...done, words.joints].join(" ")}</p>`;
  }
  translate();
});
