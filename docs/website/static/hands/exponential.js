// exp against 1 + [V] t: the same twist for some time, in n steps of I + [V] t/n, and exactly.
hand.exponential = (() => {
  const { eye, hat, addM, scaleM, matmul, transpose, range } = se3;

  // (1 + [V] t/n)^n after k of its n steps, as a four by four matrix.
  const steps = (V, n, k) => range(k).reduce((T) => matmul(T, addM(eye(4), scaleM(1 / n, hat(V)))), eye(4));

  function parts(T) {
    const R = T.slice(0, 3).map((row) => row.slice(0, 3)), p = T.slice(0, 3).map((row) => row[3]);
    const gram = matmul(transpose(R), R), [a, b, c] = transpose(R);
    const skewed = Math.max(...gram.flatMap((row, i) => row.map((x, j) => Math.abs(x - Number(i === j)))));
    return { R, p, volume: se3.dot(a, se3.cross(b, c)), skewed };
  }
  return { steps, parts };
})();

hand.begin("exponential", (root, words) => {
  const { COLOUR, show } = hand, { scale, sub, norm, range } = se3;
  let n = 12, step = 12, turns = 270, rise = 0.6, since = 0;
  const angle = () => (turns * Math.PI) / 180;
  const twist = () => [0, 0, angle(), 0, angle(), rise]; // about the vertical through (−1, 0, 0)
  const size = [0.5, 0.3, 0.12];
  const top = hand.group(root, "top");
  const view = hand.stage(top, words.seen, draw, { scale: 5.2, centre: [-1, 0, 0.4], tilt: 0.55, ratio: 0.72 });
  const controls = hand.group(top, "controls"), numbers = hand.group(top, "numbers");
  const count = hand.slider(controls, words.steps, { min: 1, max: 200, value: n, step: 1, digits: 0 }, (x) => ((n = Math.round(x)), at(n)));
  const where = hand.slider(controls, words.done, { min: 0, max: 1, value: 1, step: 1 / 12, told: () => `${step} / ${n}` }, (x) => at(Math.round(x * n)));
  hand.slider(controls, words.turn, { min: 0, max: 360, value: turns, step: 5, digits: 0, unit: "°" }, (x) => ((turns = x), change()));
  hand.slider(controls, words.rise, { min: 0, max: 1.5, value: rise, step: 0.05, unit: "m" }, (x) => ((rise = x), change()));
  const play = hand.player(controls, words, (seconds) => {
    since += seconds;
    if (since < 4 / n && since < 0.35) return true;
    since = 0;
    if (step >= n) return at(0), true;
    at(step + 1);
    return step < n;
  });
  for (const k of [1, 4, 12, 100]) hand.button(controls, `n = ${k}`, () => { play(false); n = k; count.set(k); at(k); });
  hand.group(controls, "key").innerHTML = `<i style="background:${COLOUR.linear}"></i>exp([V] t)<i style="background:${COLOUR.angular}"></i>(1 + [V] t/n)ⁿ`;

  function at(k) {
    step = Math.max(0, Math.min(n, k));
    where.set(step / n);
    change();
  }
  const change = () => (view.redraw(), tell());
  const exact = (share) => se3.exp6(scale(share, twist()));
  const rough = (k) => hand.exponential.parts(hand.exponential.steps(twist(), n, k));

  function draw(view) {
    
    view.path([[-1, 0, 0], [-1, 0, 1.6]], view.pale(), 2, { dash: [6, 6] });
    view.path(range(61).map((k) => exact(((k / 60) * step) / n).p), COLOUR.linear, 2);
    const places = range(step + 1).map((k) => rough(k).p);
    view.path(places, COLOUR.angular, 2);
    if (n <= 24) places.forEach((p) => view.dot(p, COLOUR.angular, 4));
    view.box(exact(step / n), size, COLOUR.linear, { width: 3 });
    view.box(rough(step), size, COLOUR.angular, { width: 2 });
  }

  function tell() {
    const now = rough(step), goal = exact(step / n);
    numbers.innerHTML = hand.table(["", "exp", `(1 + [V] t/n)ⁿ`], [
      [words.off, "0", `${show(norm(sub(now.p, goal.p)), 4)} m`],
      [words.orthogonal, "0", show(now.skewed, 4)],
      [words.volume, "1", show(now.volume, 4)],
    ]) + `<p class="hand-verdict ${now.skewed > 0.01 ? "is-wrong" : ""}" role="status">${now.skewed > 0.01 ? words.swells : step ? words.nearly : words.begin}</p>`;
  }
  view.fit();
  tell();
});
