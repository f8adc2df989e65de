// A body that tumbles: its box in the world, and beside it the momentum sphere and the energy ellipsoid in its own axes.
hand.tumbling = (() => {
  const { add, scale, cross, norm, matvec, matmul, transpose, exp3, eye, range } = se3;

  // Euler's equation for the momentum in the body's axes, with the principal inertias I: its rate is L × ω.
  const rate = (L, I) => cross(L, L.map((x, k) => x / I[k]));

  // The momentum and the rotation at equal times: the momentum by Runge and Kutta's fourth order, the rotation such that
  // the momentum stays where it is in the world to the same order (the two evaluations of Magnus).
  function course(I, spin, seconds, count, fine = 8) {
    const h = seconds / count / fine, turning = (L) => L.map((x, k) => x / I[k]);
    let L = spin.map((x, k) => x * I[k]), R = eye(3);
    const out = [{ L, R }];
    const step = (L, h) => {
      const a = rate(L, I), b = rate(add(L, scale(h / 2, a)), I), c = rate(add(L, scale(h / 2, b)), I), d = rate(add(L, scale(h, c)), I);
      return add(L, scale(h / 6, range(3).map((k) => a[k] + 2 * b[k] + 2 * c[k] + d[k])));
    };
    for (const k of range(count * fine)) {
      const half = step(L, h / 2), next = step(half, h / 2);
      const [w0, w1, w2] = [L, half, next].map(turning);
      const mean = range(3).map((i) => (h / 6) * (w0[i] + 4 * w1[i] + w2[i]));
      R = matmul(R, exp3(add(mean, scale((h * h) / 12, cross(w0, w2)))));
      L = next;
      if ((k + 1) % fine === 0) out.push({ L, R });
    }
    return out;
  }

  const energy = (L, I) => L.reduce((sum, x, k) => sum + (x * x) / I[k], 0) / 2;
  return { rate, course, energy };
})();

hand.begin("tumbling", (root, words) => {
  const { COLOUR, show } = hand, { scale, norm, matvec, transpose, range, eye } = se3;
  const size = [0.55, 1, 0.18], mass = 12, SECONDS = 24, COUNT = 720; // a book of 1 m: I₁ < I₂ < I₃ along y, x, z
  const I = [(size[1] ** 2 + size[2] ** 2), (size[0] ** 2 + size[2] ** 2), (size[0] ** 2 + size[1] ** 2)].map((x) => (mass / 12) * x);
  let axis = 0, lean = 2, now = 0, course;
  const top = hand.group(root, "top"), pair = hand.group(top, "two");
  const left = hand.stage(pair, words.seen_box, drawBox, { scale: 2.4, ratio: 0.95 });
  const right = hand.stage(pair, words.seen_sphere, drawSphere, { scale: 3, ratio: 0.95, yaw: 0.9, tilt: 0.45 });
  const controls = hand.group(top, "controls"), numbers = hand.group(top, "numbers");
  [["least", 1], ["middle", 0], ["most", 2]].forEach(([name, k]) => hand.button(controls, words[name], () => ((axis = k), begin())));
  hand.slider(controls, words.lean, { min: 0, max: 20, value: lean, step: 1, digits: 1, unit: "°" }, (x) => ((lean = x), begin()));
  const time = hand.slider(controls, words.time, { min: 0, max: SECONDS, value: 0, step: 0.1, digits: 1, unit: "s" }, (t) => at(t));
  hand.player(controls, words, (seconds) => at((now + seconds) % SECONDS));
  hand.group(controls, "key").innerHTML = `<i style="background:${COLOUR.accent}"></i>L<i style="background:${COLOUR.angular}"></i>ω<i style="background:${COLOUR.linear}"></i>${words.ellipsoid}<i style="background:#808080"></i>${words.sphere}`;

  function begin() {
    const turned = (lean * Math.PI) / 180, spin = [0, 0, 0];
    spin[axis] = 3 * Math.cos(turned);
    spin[(axis + 1) % 3] = 3 * Math.sin(turned);
    course = hand.tumbling.course(I, spin, SECONDS, COUNT);
    at(0);
  }
  function at(t) {
    now = t;
    time.set(t);
    left.redraw();
    right.redraw();
    tell();
  }
  const state = () => course[Math.min(COUNT, Math.round((now / SECONDS) * COUNT))];

  function drawBox(view) {
    if (!course) return;
    const { L, R } = state(), unit = 0.95 / norm(L);
    view.box({ R, p: [0, 0, 0] }, size, "#808080", { width: 2, fill: "rgba(86, 180, 233, 0.25)" });
    ["x", "y", "z"].forEach((name, k) => view.path([[0, 0, 0], scale(0.62 * size[k], R.map((row) => row[k]))], COLOUR[name], 3));
    view.arrow([0, 0, 0], matvec(R, scale(unit, L)), COLOUR.accent, 5);
    view.arrow([0, 0, 0], scale(0.28, matvec(R, L.map((x, k) => x / I[k]))), COLOUR.angular, 4);
  }

  // Everything here is divided by the size of L: the sphere has radius 1.
  function drawSphere(view) {
    if (!course) return;
    const { L } = state(), long = norm(L), E = hand.tumbling.energy(L, I);
    const half = I.map((x) => Math.sqrt(2 * E * x) / long), ring = (a, b, r) => range(49).map((k) => {
      const p = [0, 0, 0];
      p[a] = r[a] * Math.cos((k * Math.PI) / 24);
      p[b] = r[b] * Math.sin((k * Math.PI) / 24);
      return p;
    });
    for (const [a, b] of [[0, 1], [1, 2], [2, 0]]) {
      view.path(ring(a, b, [1, 1, 1]), "#808080", 1.5);
      view.path(ring(a, b, half), COLOUR.linear, 2);
    }
    const path = course.map((c) => scale(1 / long, c.L));
    path.slice(1).forEach((p, k) => view.path([path[k], p], COLOUR.accent, 2, { alpha: view.depth(p) > 0 ? 1 : 0.3 }));
    ["x", "y", "z"].forEach((name, k) => view.text(eye(3)[k].map((x) => 1.12 * x), name, COLOUR[name], [-3, 4]));
    view.dot(scale(1 / long, L), COLOUR.accent, 7, view.ink());
  }

  function tell() {
    const { L, R } = state(), six = (x) => x.map((c) => show(c));
    numbers.innerHTML = hand.table(["", ..."xyz"], [
      [words.omega, ...six(L.map((x, k) => x / I[k]))], [words.momentum_body, ...six(L)], [words.momentum_world, ...six(matvec(R, L))],
    ], words.unit) + `<p class="hand-verdict">${words.constant} |L| = ${show(norm(L), 4)} ${words.momentum}${words.comma}E = ${show(hand.tumbling.energy(L, I), 4)} J${words.stop}${lean === 0 ? words.says_still : words[`says_${axis}`]}</p>`;
  }
  begin();
  left.fit();
  right.fit();
});
