// Felt mass: a chain of rods in the hand, whose joints are locked or free, and the force that 1 m/s² takes.
hand.felt = (() => {
  const { add, addM, scaleM, sub, scale, dot, outer, matvec, matmul, transpose, exp3, motionTransform, eye } = se3;
  const S = [0, 1, 0, 0, 0, 0]; // all joints turn about y

  // The articulated-body inertia that the hand feels, in the axes of the hand: what is beyond each joint, less what it lets go.
  function apparent(inertia, angles, free) {
    let carried = null;
    for (let i = angles.length - 1; i >= 0; i--) {
      let I = inertia;
      if (carried) I = addM(I, carried);
      const U = matvec(I, S), D = dot(S, U);
      const Ia = free[i] ? addM(I, scaleM(-1 / D, outer(U, U))) : I;
      const R = exp3([0, -angles[i], 0]), p = i ? [0, 0, -1] : [0, 0, 0]; // of the rod in its parent's frame
      const X = motionTransform(transpose(R), scale(-1, matvec(transpose(R), p)));
      carried = matmul(transpose(X), matmul(Ia, X));
    }
    return carried;
  }

  // The ends of the rods: angles are counted from the rod before, the first from straight down.
  function ends(angles) {
    const places = [[0, 0, 0]];
    let turned = 0;
    for (const angle of angles) {
      turned += angle;
      places.push(add(places.at(-1), [Math.sin(turned), 0, -Math.cos(turned)]));
    }
    return places;
  }
  return { apparent, ends };
})();

hand.begin("felt", (root, words, { inertia }) => {
  const { COLOUR, show } = hand, { add, sub, norm, range, matvec } = se3;
  let angles = [0.7], free = [true], all = [[0.7, 0.9, -0.8], [true, true, true]];
  const top = hand.group(root, "top");
  const radians = (degrees) => (degrees * Math.PI) / 180;
  let handles = [];
  const view = hand.stage(top, words.seen, draw, { scale: 5.6, centre: [0.4, 0, -0.7], yaw: 0, tilt: 0, ratio: 0.85, flat: true, handles });
  const controls = hand.group(top, "controls"), numbers = hand.group(top, "numbers");
  const count = hand.choice(controls, words.rods, { 1: 1, 2: 2, 3: 3 }, (n) => build(Number(n)));
  const joints = hand.group(controls, "joints");
  for (const [name, on] of [["lock", false], ["release", true]]) {
    hand.button(controls, words[name], () => { free = free.map(() => on); build(free.length, free); });
  }
  hand.group(controls, "key").innerHTML = `<i style="background:${COLOUR.warm}"></i>${words.locked}<i style="background:${COLOUR.linear}"></i>${words.now}`;
  let sliders = [];

  function build(n, given) {
    angles = range(n).map((k) => angles[k] ?? all[0][k]);
    free = given ?? range(n).map((k) => free[k] ?? true);
    joints.replaceChildren();
    sliders = angles.map((angle, k) => {
      const slider = hand.slider(joints, `${words.joint} ${k + 1}`, { min: -180, max: 180, value: (angle * 180) / Math.PI, step: 5, digits: 0, unit: "°" },
        (x) => ((angles[k] = radians(x)), change()));
      hand.check(joints, `${words.joint} ${k + 1}: ${words.free}`, free[k], (on) => ((free[k] = on), change()));
      return slider;
    });
    handles.splice(0, handles.length, ...angles.map((_, k) => ({
      at: () => hand.felt.ends(angles)[k + 1],
      move(d) { // the rod turns after the hand, and the rods beyond it keep their angles to it
        const [a, b] = hand.felt.ends(angles).slice(k, k + 2), to = sub(add(b, d), a);
        const turned = Math.atan2(to[0], -to[2]), before = angles.slice(0, k).reduce((s, x) => s + x, 0);
        angles[k] = Math.atan2(Math.sin(turned - before), Math.cos(turned - before));
        sliders[k].set((angles[k] * 180) / Math.PI);
        tell();
      },
    })));
    change();
  }
  const change = () => (view.redraw(), tell());
  const block = (free) => {
    const I = hand.felt.apparent(inertia, angles, free);
    return [[I[3][3], I[3][5]], [I[5][3], I[5][5]]];
  };
  // The force for 1 m/s² in every direction; drawn one metre for two kilograms.
  const curve = (M) => range(73).map((k) => {
    const u = [Math.cos((k * Math.PI) / 36), Math.sin((k * Math.PI) / 36)], f = matvec(M, u);
    return [f[0] / 2, 0, f[1] / 2];
  });

  function draw(view) {
    const places = hand.felt.ends(angles);
    view.path(curve(block(free.map(() => false))), COLOUR.warm, 2, { dash: [7, 5] });
    view.path(curve(block(free)), COLOUR.linear, 4, { fill: "rgba(58, 143, 200, 0.15)" });
    places.slice(1).forEach((p, k) => view.path([places[k], p], "#808080", 9));
    places.slice(0, -1).forEach((p, k) => view.dot(p, free[k] ? COLOUR.linear : COLOUR.warm, 6, view.ink()));
    view.text([0, 0, 0], words.hand, view.ink(), [-14, -14]);
  }

  function tell() {
    const M = block(free), mass = free.length, middle = (M[0][0] + M[1][1]) / 2;
    const half = Math.hypot((M[0][0] - M[1][1]) / 2, M[0][1]), [least, most] = [middle - half, middle + half];
    numbers.innerHTML = hand.table(["", words.x, words.z], [
      [words.ax, ...M.map((row) => `${show(row[0], 3)} N`)], [words.az, ...M.map((row) => `${show(row[1], 3)} N`)],
    ]) + `<p class="hand-verdict" role="status">${words.mass} ${mass} kg${words.stop}${words.feels} ${show(least, 3)} … ${show(most, 3)} kg${words.stop}${free.some(Boolean) ? words.ellipse : words.circle}</p>`;
  }
  build(1);
  view.fit();
});
