// A twist as a field: the velocity of every point of the body, the screw axis, and a point that runs along its helix.
hand.field = (() => {
  const { scale, add, cross, norm, screw } = se3;

  // The twist of a screw: its axis through a point, and turning and sliding as the cosine and the sine of an angle, so
  // that the pitch, their ratio, goes from 0 to infinity without a jump.
  function twist(axis, point, angle) {
    const n = scale(1 / norm(axis), axis), w = scale(Math.cos(angle), n);
    return [...w, ...add(cross(point, w), scale(Math.sin(angle), n))];
  }

  const velocity = (V, p) => add(V.slice(3), cross(V.slice(0, 3), p));
  return { twist, velocity, screw };
})();

hand.begin("field", (root, words) => {
  const { COLOUR, show } = hand, { add, scale, norm, range } = se3;
  let point = [0.4, 0.2, 0], lean = 15, angle = 20, seconds = 0;
  const radians = (degrees) => (degrees * Math.PI) / 180;
  const axis = () => [Math.sin(radians(lean)), 0, Math.cos(radians(lean))];
  // exactly at the ends, where a cosine of 90° would not be nothing
  const twist = () => (angle >= 90 ? [0, 0, 0, ...axis()] : hand.field.twist(axis(), point, radians(angle)));
  const top = hand.group(root, "top");
  const view = hand.stage(top, words.seen, draw, {
    scale: 3.6, tilt: 0.5, ratio: 0.72,
    handles: [{ at: () => point, level: true, move: (d) => place(add(point, d)) }],
  });
  const controls = hand.group(top, "controls"), numbers = hand.group(top, "numbers");
  const told = (a) => (a >= 90 ? "∞" : `${show(Math.tan(radians(a)))} m/rad`);
  const pitch = hand.slider(controls, words.pitch, { min: 0, max: 90, value: angle, step: 1, told }, (a) => ((angle = a), change()));
  const along = ["x", "y"].map((name, k) =>
    hand.slider(controls, `${words.axis_at} ${name}`, { min: -1, max: 1, value: point[k], step: 0.05, unit: "m" }, (x) => ((point[k] = x), change())));
  hand.slider(controls, words.lean, { min: -60, max: 60, value: lean, step: 5, digits: 0, unit: "°" }, (x) => ((lean = x), change()));
  for (const [name, a] of [["turning", 0], ["both", 20], ["sliding", 90]]) hand.button(controls, words[name], () => (pitch.set((angle = a)), change()));
  const time = hand.slider(controls, words.time, { min: 0, max: 12, value: 0, step: 0.1, digits: 1, unit: "s" }, (t) => ((seconds = t), view.redraw()));
  hand.player(controls, words, (step) => {
    seconds = (seconds + step * 1.5) % 12;
    time.set(seconds);
    view.redraw();
  });

  function place(p) {
    point = p.map((x, k) => (k < 2 ? Math.max(-1, Math.min(1, x)) : 0));
    along.forEach((slider, k) => slider.set(point[k]));
    change();
  }
  const change = () => (view.redraw(), tell());

  function draw(view) {
    const V = twist(), inner = [-1.2, -0.6, 0, 0.6, 1.2];
    view.floor(1.2, 0.6);
    const places = inner.flatMap((x) => inner.flatMap((y) => [-0.6, 0, 0.6].map((z) => [x, y, z])));
    places.sort((a, b) => view.depth(a) - view.depth(b));
    for (const p of places) view.arrow(p, scale(0.28, hand.field.velocity(V, p)), view.depth(p) < 0 ? view.pale() : COLOUR.linear, 2);
    if (angle < 90) {
      view.path([-1.1, 1.1].map((s) => add(point, scale(s, axis()))), COLOUR.angular, 3, { dash: [10, 6] });
      view.arrow(point, scale(0.7 * norm(V.slice(0, 3)), axis()), COLOUR.angular, 5);
    } else view.text([-0.4, 0, 1.1], words.no_axis, COLOUR.angular);
    const start = [0.9, -0.5, -0.6], at = (t) => se3.act(se3.exp6(scale(t, V)), start);
    view.path(range(121).map((k) => at((k / 120) * 12)).filter((p) => p[2] < 1.6 && p[2] > -1.6), COLOUR.accent, 2);
    view.dot(at(seconds), COLOUR.accent, 6);
  }

  function tell() {
    const V = twist(), found = hand.field.screw(V);
    numbers.innerHTML = hand.table(["", ..."xyz"], [
      ["ω [rad/s]", ...V.slice(0, 3).map((x) => show(x))], [words.v, ...V.slice(3).map((x) => show(x))],
      [words.nearest, ...(angle < 90 ? found.point.map((x) => show(x)) : ["–", "–", "–"])],
    ]) + `<p class="hand-verdict" role="status">${angle <= 0 ? words.says_turning : angle >= 90 ? words.says_sliding : words.says_both} h = ω·v / ω·ω = ${told(angle)}</p>`;
  }
  view.fit();
  tell();
});
