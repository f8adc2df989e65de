// se(3) in a page: what the objects of "Take it in your hand" compute with. Twists are (ω, v), wrenches (τ, f),
// matrices are lists of rows. The names are those of the package, whose numbers they give (tests/project/test_site_hands.py).
globalThis.se3 = (() => {
  const range = (n) => [...Array(n).keys()];
  const zeros = (n, m) => range(n).map(() => Array(m).fill(0));
  const eye = (n) => range(n).map((i) => range(n).map((j) => Number(i === j)));
  const add = (a, b) => a.map((x, k) => x + b[k]);
  const sub = (a, b) => a.map((x, k) => x - b[k]);
  const scale = (s, a) => a.map((x) => s * x);
  const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
  const norm = (a) => Math.hypot(...a);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const transpose = (A) => A[0].map((_, j) => A.map((row) => row[j]));
  const matvec = (A, x) => A.map((row) => dot(row, x));
  const matmul = (A, B) => transpose(transpose(B).map((column) => matvec(A, column)));
  const addM = (A, B) => A.map((row, i) => add(row, B[i]));
  const scaleM = (s, A) => A.map((row) => scale(s, row));
  const outer = (a, b) => a.map((x) => scale(x, b));
  const block = (A, B, C, D) => [...A.map((row, i) => [...row, ...B[i]]), ...C.map((row, i) => [...row, ...D[i]])];
  const skew = ([x, y, z]) => [[0, -z, y], [z, 0, -x], [-y, x, 0]];

  // A x = b, by elimination with the largest pivot.
  function solve(A, b) {
    const rows = A.map((row, i) => [...row, b[i]]), n = A.length;
    for (const k of range(n)) {
      const best = range(n).slice(k).reduce((i, j) => (Math.abs(rows[j][k]) > Math.abs(rows[i][k]) ? j : i), k);
      [rows[k], rows[best]] = [rows[best], rows[k]];
      if (rows[k][k] === 0) throw new RangeError("the matrix is singular");
      for (let i = k + 1; i < n; i++) rows[i] = sub(rows[i], scale(rows[i][k] / rows[k][k], rows[k]));
    }
    const x = Array(n).fill(0);
    for (const k of range(n).reverse()) x[k] = (rows[k][n] - dot(rows[k].slice(k + 1, n), x.slice(k + 1))) / rows[k][k];
    return x;
  }

  // sin θ / θ, (1 − cos θ) / θ² and (θ − sin θ) / θ³; by their series where the difference would cancel.
  function ratios(angle) {
    const s = angle * angle, half = Math.sin(angle / 2);
    if (angle < 0.2) {
      const sum = (first) => range(8).reduceRight((rest, k) => 1 - (rest * s) / ((first + 2 * k) * (first + 2 * k + 1)), 1);
      return [sum(2), sum(3) / 2, sum(4) / 6];
    }
    return [Math.sin(angle) / angle, (2 * half * half) / s, (angle - Math.sin(angle)) / (s * angle)];
  }

  function exp3(w) {
    const [a, b] = ratios(norm(w)), W = skew(w);
    return addM(eye(3), addM(scaleM(a, W), scaleM(b, matmul(W, W))));
  }

  // The placement that a constant twist leads to in one second: its rotation and its translation.
  function exp6(V) {
    const w = V.slice(0, 3), [, b, c] = ratios(norm(w)), W = skew(w);
    const D = addM(eye(3), addM(scaleM(b, W), scaleM(c, matmul(W, W))));
    return { R: exp3(w), p: matvec(D, V.slice(3)) };
  }

  const hat = (V) => [...skew(V).map((row, i) => [...row, V[3 + i]]), [0, 0, 0, 0]];
  const compose = (A, B) => ({ R: matmul(A.R, B.R), p: add(A.p, matvec(A.R, B.p)) });
  const act = (T, x) => add(T.p, matvec(T.R, x));
  const motionTransform = (R, p) => block(R, zeros(3, 3), matmul(skew(p), R), R);
  const forceTransform = (R, p) => block(R, matmul(skew(p), R), zeros(3, 3), R);
  const crossMotion = (V) => block(skew(V), zeros(3, 3), skew(V.slice(3)), skew(V));
  const crossForce = (V) => block(skew(V), skew(V.slice(3)), zeros(3, 3), skew(V));

  // The axis of a twist, the point of it that is nearest to the origin, and the pitch; Infinity where nothing turns.
  function screw(V) {
    const w = V.slice(0, 3), v = V.slice(3), s = dot(w, w);
    if (s === 0) return { axis: scale(1 / (norm(v) || 1), v), point: [0, 0, 0], pitch: Infinity };
    return { axis: scale(1 / Math.sqrt(s), w), point: scale(1 / s, cross(w, v)), pitch: dot(w, v) / s };
  }

  // The rotation of a quaternion (x, y, z, w) of length 1.
  function fromQuaternion([x, y, z, w]) {
    return [
      [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
      [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
      [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ];
  }

  return {
    range, zeros, eye, add, sub, scale, dot, norm, cross, transpose, matvec, matmul, addM, scaleM, outer, block, skew, solve,
    exp3, exp6, hat, compose, act, motionTransform, forceTransform, crossMotion, crossForce, screw, fromQuaternion,
  };
})();
