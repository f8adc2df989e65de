// Four feet under a push: the least forces that carry it, the cones, the polygon, and the centre of pressure.
hand.feet = (() => {
  const { add, sub, scale, cross, norm, range, skew, eye, zeros, transpose, matvec, matmul, solve } = se3;

  // The forces on the feet, of all that balance the weight and the push those of least norm, and where they press.
  function carried({ feet, com, weight }, push, at) {
    const middle = scale(1 / feet.length, feet.reduce(add));
    const G = transpose(feet.flatMap((p) => transpose([...skew(sub(p, middle)), ...eye(3)])));
    const load = [[0, 0, -weight], push], points = [com, at];
    const moment = load.map((f, k) => cross(sub(points[k], middle), f)).reduce(add), force = load.reduce(add);
    const flat = matvec(transpose(G), solve(matmul(G, transpose(G)), scale(-1, [...moment, ...force])));
    const forces = feet.map((_, k) => flat.slice(3 * k, 3 * k + 3));
    // where a force of the ground alone, without a moment about a level axis, would balance it
    const pressure = add(middle, [-moment[1] / force[2], moment[0] / force[2], 0]);
    return { forces, pressure };
  }

  // How far a point is inside a convex polygon whose corners go round counterclockwise; negative outside.
  const inside = (corners, p) =>
    Math.min(...corners.map((a, k) => {
      const along = sub(corners[(k + 1) % corners.length], a);
      return cross(along, sub(p, a))[2] / norm(along);
    }));
  return { carried, inside };
})();

hand.begin("feet", (root, words, robot) => {
  const { COLOUR, show } = hand, { add, scale, sub, norm, range } = se3, NEWTON = 1 / 400;
  const order = ["FL", "RL", "RR", "FR"].map((name) => robot.names.indexOf(name));
  const corners = order.map((k) => robot.feet[k]);
  let push = [20, 15, 0], height = 0.3, friction = 0.6, cones = true;
  const at = () => [robot.com[0], robot.com[1], height];
  const now = () => hand.feet.carried(robot, push, at());
  const slips = (f) => Math.hypot(f[0], f[1]) > friction * Math.max(0, f[2]);
  const top = hand.group(root, "top");
  const view = hand.stage(top, words.seen, draw, {
    scale: 1.15, centre: [0, 0, 0.16], yaw: 0.5, tilt: 0.4, ratio: 0.75,
    handles: [{ at: () => add(at(), scale(NEWTON, push)), level: true, colour: COLOUR.warm, move: (d) => set(add(push, scale(1 / NEWTON, d))) }],
  });
  const controls = hand.group(top, "controls"), numbers = hand.group(root, "numbers");
  const sliders = ["x", "y"].map((axis, k) =>
    hand.slider(controls, `${words.push} ${axis}`, { min: -120, max: 120, value: push[k], step: 2, digits: 0, unit: "N" }, (x) => ((push[k] = x), change())));
  hand.slider(controls, words.height, { min: 0, max: 0.5, value: height, step: 0.02, unit: "m" }, (x) => ((height = x), change()));
  hand.slider(controls, words.friction, { min: 0.1, max: 1.2, value: friction, step: 0.05 }, (x) => ((friction = x), change()));
  hand.check(controls, words.cones, true, (on) => ((cones = on), change()));
  hand.group(controls, "key").innerHTML = [[COLOUR.linear, words.carries], [COLOUR.warm, words.slides], [COLOUR.angular, words.pulls]]
    .map(([colour, text]) => `<i style="background:${colour}"></i>${text}`).join("");

  function set(x) {
    push = x.map((c, k) => (k < 2 ? Math.max(-120, Math.min(120, c)) : 0));
    sliders.forEach((slider, k) => slider.set(push[k]));
    change();
  }
  const change = () => (view.redraw(), tell());
  const colour = (f) => (f[2] < 0 ? COLOUR.angular : slips(f) ? COLOUR.warm : COLOUR.linear);

  // Where the label of the centre of pressure stands clear of the feet's names: below, above, or on either side, higher or lower.
  function clear(view, pressure) {
    view.text(pressure, "", view.ink()); // sets the letters that are measured
    const unit = view.unit(), wide = view.pen.measureText(words.pressure).width, [x, y] = view.at(pressure);
    const covers = ([right, down]) => {
      const left = Math.max(2, Math.min(view.canvas.width - wide - 2, x + right * unit)), base = y + down * unit;
      return robot.feet.some((p) => {
        const [u, v] = view.at(p);
        return u + 16 * unit > left && u - 14 * unit < left + wide && Math.abs(v + 18 * unit - base) < 18 * unit;
      });
    };
    const places = [16, -12, 36, -32].flatMap((down) => [[10, down], [-10 - wide / unit, down]]);
    return places.find((by) => !covers(by)) ?? places[0];
  }

  function draw(view) {
    const { forces, pressure } = now(), wide = 0.12;
    view.floor(0.5, 0.1);
    view.path([...corners, corners[0]], COLOUR.y, 2, { fill: "rgba(0, 158, 115, 0.15)" });
    robot.sticks.forEach((ends) => view.path(ends, "#808080", 6));
    robot.feet.forEach((p, k) => {
      if (cones) {
        const rim = range(25).map((i) => add(p, [wide * friction * Math.cos((i * Math.PI) / 12), wide * friction * Math.sin((i * Math.PI) / 12), wide]));
        view.path(rim, colour(forces[k]), 1, { fill: "rgba(128, 128, 128, 0.12)" });
        for (const i of [0, 6, 12, 18]) view.path([p, rim[i]], colour(forces[k]), 1);
      }
      view.arrow(p, scale(NEWTON, forces[k]), colour(forces[k]), 4);
      view.text(p, robot.names[k], view.ink(), [-10, 18]);
    });
    view.arrow(at(), scale(NEWTON, push), COLOUR.warm, 5);
    view.dot(at(), view.ink(), 4);
    const out = hand.feet.inside(corners, pressure) < 0;
    view.dot(pressure, out ? COLOUR.angular : COLOUR.y, 7, view.ink());
    view.text(pressure, words.pressure, out ? COLOUR.angular : view.ink(), clear(view, pressure));
  }

  function tell() {
    const { forces, pressure } = now(), margin = hand.feet.inside(corners, pressure);
    const sideways = forces.reduce(add).slice(0, 2), all = forces.reduce((sum, f) => sum + f[2], 0);
    const needed = Math.hypot(...sideways) / all;
    const says = margin < 0 ? words.tips : needed > friction ? words.slides_all : forces.some((f) => f[2] < 0) ? words.shared : forces.some(slips) ? words.some_slip : words.stands;
    numbers.innerHTML = hand.table(["", ..."xyz", words.ratio, ""], robot.names.map((name, k) => [
      name, ...forces[k].map((x) => show(x, 1)), forces[k][2] > 0 ? show(Math.hypot(forces[k][0], forces[k][1]) / forces[k][2]) : "–",
      forces[k][2] < 0 ? words.pulls : slips(forces[k]) ? words.slides : "",
    ]), words.unit) + `<p class="hand-verdict ${says === words.stands ? "" : "is-wrong"}" role="status">${words.margin} ${show(100 * margin, 1)} cm${words.stop}${says}</p>`;
  }
  view.fit();
  tell();
});
