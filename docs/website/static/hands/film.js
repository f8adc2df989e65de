// RNEA as a film on Go2: twists run outward, wrenches come inward; the base held in the air, or standing on its feet.
hand.film = (() => {
  // The steps: each body outward with its twist, then each inward with its wrench and the torque of its joint.
  const steps = (count) => [
    ...se3.range(count - 1).map((k) => ({ body: k + 1, inward: false })),
    ...se3.range(count - 1).map((k) => ({ body: count - 1 - k, inward: true })),
  ];
  return { steps };
})();

hand.begin("film", (root, words, robot) => {
  const { COLOUR, show } = hand, { add, scale, matvec } = se3;
  const steps = hand.film.steps(robot.names.length), METRE = [0.15, 1 / 350];
  const centre = add(robot.p[1], [0, 0, -0.1]);
  let now = steps.length / 2 - 1, held = 0, waited = 0;
  const top = hand.group(root, "top");
  const view = hand.stage(top, words.seen, draw, { scale: 1.05, centre, yaw: 0.5, tilt: 0.35, ratio: 0.85 });
  const controls = hand.group(top, "controls"), numbers = hand.group(top, "numbers");
  hand.choice(controls, words.how, { 0: words.held, 1: words.standing }, (k) => ((held = Number(k)), at(now)));
  const where = hand.slider(controls, words.step, { min: 0, max: steps.length - 1, value: now, step: 1, told: () => `${now + 1} / ${steps.length}` }, (x) => at(Math.round(x)));
  hand.button(controls, "←", () => at(now - 1)).setAttribute("aria-label", words.back);
  hand.button(controls, "→", () => at(now + 1)).setAttribute("aria-label", words.on);
  hand.player(controls, words, (seconds) => {
    waited += seconds;
    if (waited < 0.5) return true;
    waited = 0;
    at((now + 1) % steps.length);
    return true;
  });
  hand.group(controls, "key").innerHTML = [[COLOUR.linear, words.velocity], [COLOUR.y, words.spin], [COLOUR.angular, words.force], [COLOUR.accent, words.ground]]
    .map(([colour, text]) => `<i style="background:${colour}"></i>${text}`).join("");

  function at(k) {
    now = (k + steps.length) % steps.length;
    where.set(now);
    view.redraw();
    tell();
  }

  function draw(view) {
    view.floor(0.5, 0.1);
    const { body, inward } = steps[now];
    robot.sticks.forEach((ends) => view.path(ends, "#808080", 5, { alpha: 0.6 }));
    if (held) for (const [p, f] of robot.feet) view.arrow(p, scale(METRE[1], f), COLOUR.accent, 4);
    for (const step of steps.slice(0, now + 1).filter((s) => s.inward === inward)) {
      const R = robot.R[step.body], p = robot.p[step.body], six = inward ? robot.F[held][step.body] : robot.V[step.body];
      const width = step.body === body ? 5 : 2.5;
      if (inward) view.arrow(p, scale(METRE[1], matvec(R, six.slice(3))), COLOUR.angular, width);
      else {
        view.arrow(p, scale(METRE[0], matvec(R, six.slice(3))), COLOUR.linear, width);
        view.arrow(p, scale(METRE[0] / 4, matvec(R, six.slice(0, 3))), COLOUR.y, width);
      }
    }
    view.dot(robot.p[body], COLOUR.warm, 7, view.ink());
    view.text(robot.p[body], robot.names[body], view.ink(), [10, -8]);
  }

  function tell() {
    const { body, inward } = steps[now], x = inward ? robot.F[held][body] : robot.V[body];
    const name = `<i>${inward ? "F" : "V"}</i><sub>${body}</sub>`, parent = robot.names[robot.parent[body]];
    const says = !inward ? (body === 1 ? words.base_twist : words.outward) : body === 1 ? words[held ? "base_stands" : "base_held"] : words.inward;
    const torque = inward && body > 1 ? ` τ = ${show(robot.tau[held][body - 2], 2)} N m.` : "";
    const line = `<p class="hand-formula">${robot.formulas[Number(inward)][body]}</p><pre class="hand-line">${robot.lines[Number(inward)]}</pre>`;
    numbers.innerHTML = line + hand.table(["", ..."xyz"], [
      [inward ? words.moment : words.omega, ...x.slice(0, 3).map((c) => show(c, 3))], [inward ? words.f : words.v, ...x.slice(3).map((c) => show(c, 3))],
    ], `${name}, ${words.frame} ${robot.names[body]}`) + `<p class="hand-verdict">${says.replace("{parent}", parent).replace("{body}", robot.names[body])}${torque}</p>`;
  }
  at(now);
  view.fit();
});
