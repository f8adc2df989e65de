// Two frames: one twist and one wrench, written in both, with the two matrices that lead from A to B.
hand.frames = (() => {
  const { scale, dot, matvec, matmul, transpose, motionTransform, forceTransform } = se3;

  // T is the placement of B in A. `mistaken` takes the wrench by the transpose of what takes the twist.
  function carried(T, V, F, mistaken = false) {
    const back = transpose(T.R), p = scale(-1, matvec(back, T.p));
    const X = motionTransform(back, p), Xstar = mistaken ? transpose(X) : forceTransform(back, p);
    const there = { V: matvec(X, V), F: matvec(Xstar, F) };
    return { X, Xstar, ...there, power: dot(F, V), powerThere: dot(there.F, there.V) };
  }

  const rotation = ([x, y, z]) => matmul(se3.exp3([0, 0, z]), matmul(se3.exp3([0, y, 0]), se3.exp3([x, 0, 0])));
  return { carried, rotation };
})();

hand.begin("frames", (root, words) => {
  const { COLOUR, show } = hand, { add, scale, matvec } = se3;
  const V = [0, 0.4, 0.8, 0.5, 0.2, 0], F = [0.2, 0, 0.3, 0, 0.5, 0.6];
  let p = [1, 0.2, 0.4], angles = [0, 0, 0.6], mistaken = false;
  const shown = { V: true, F: false };
  const T = () => ({ R: hand.frames.rotation(angles), p });
  const top = hand.group(root, "top");
  const view = hand.stage(top, words.seen, draw, {
    scale: 3.8, centre: [0.5, 0.1, 0.3], ratio: 0.62,
    handles: [{ at: () => p, move: (d) => (set(add(p, d).map((x) => Math.max(-1.5, Math.min(1.5, x)))), tell()) }],
  });
  const controls = hand.group(top, "controls"), numbers = hand.group(root, "numbers");
  const place = ["p<sub>x</sub>", "p<sub>y</sub>", "p<sub>z</sub>"].map((name, k) =>
    hand.slider(controls, name, { min: -1.5, max: 1.5, value: p[k], step: 0.05, unit: "m" }, (x) => ((p[k] = x), change())));
  ["x", "y", "z"].forEach((axis, k) =>
    hand.slider(controls, `${words.about} ${axis}`, { min: -180, max: 180, value: (angles[k] * 180) / Math.PI, step: 5, digits: 0, unit: "°" },
      (x) => ((angles[k] = (x * Math.PI) / 180), change())));
  hand.check(controls, words.twist, true, (on) => ((shown.V = on), change()));
  hand.check(controls, words.wrench, false, (on) => ((shown.F = on), change()));
  hand.check(controls, words.mistake, false, (on) => ((mistaken = on), change()));

  function set(x) {
    p = x;
    place.forEach((slider, k) => slider.set(p[k]));
  }
  const change = () => (view.redraw(), tell());

  function six(at, R, x, strength) {
    view.arrow(at, scale(strength, matvec(R, x.slice(0, 3))), COLOUR.angular, 4);
    view.arrow(at, scale(strength, matvec(R, x.slice(3))), COLOUR.linear, 4);
  }

  function draw(view) {
    const A = { R: se3.eye(3), p: [0, 0, 0] }, B = T(), there = hand.frames.carried(B, V, F, mistaken);
    view.floor(1.5, 0.5);
    view.path([A.p, B.p], view.pale(), 2, { dash: [6, 6] });
    view.frame(A, "A", 0.45, 2);
    view.frame(B, "B", 0.45, 2);
    if (shown.V) six(A.p, A.R, V, 0.7), six(B.p, B.R, there.V, 0.7);
    if (shown.F) six(A.p, A.R, F, 0.7), six(B.p, B.R, there.F, 0.7);
  }

  function tell() {
    const there = hand.frames.carried(T(), V, F, mistaken), wrong = Math.abs(there.power - there.powerThere) > 1e-9;
    const part = (i, j, lower) => (i < 3 === j < 3 ? "turns" : lower === i > j ? "moves" : "zero");
    const kind = (lower) => (i, j) => part(i, j, lower);
    const six = (x) => x.map((c) => show(c));
    numbers.innerHTML = `<div class="hand-pair"><figure><figcaption><b><sup>B</sup>X<sub>A</sub></b> ${words.takes_twist}</figcaption>${hand.matrix(there.X, words.X, kind(true))}</figure>
      <figure><figcaption><b>${mistaken ? "<sup>B</sup>X<sub>A</sub><sup>T</sup>" : "<sup>B</sup>X<sub>A</sub>*"}</b> ${words.takes_wrench}</figcaption>${hand.matrix(there.Xstar, words.Xstar, kind(false))}</figure></div>
      ${hand.table(["", ...words.heads.split(" ")], [
        [`V, ${words.in} A`, ...six(V)], [`V, ${words.in} B`, ...six(there.V)],
        [`F, ${words.in} A`, ...six(F)], [`F, ${words.in} B`, ...six(there.F)],
      ], words.unit)}
      <p class="hand-verdict ${wrong ? "is-wrong" : ""}" role="status">${words.power}: F·V ${words.in} A = ${show(there.power, 4)} W${words.comma}${words.in} B = ${show(there.powerThere, 4)} W${words.stop}${wrong ? words.differs : words.equal}</p>`;
  }
  view.fit();
  tell();
});
