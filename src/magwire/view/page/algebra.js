// Vectors as arrays of three, matrices as arrays of sixteen by columns.
"use strict";
((parts) => {
  const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const scale = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
  const norm = (a) => Math.hypot(a[0], a[1], a[2]);
  const unit = (a) => {
    const size = norm(a);
    return size > 0 ? scale(a, 1 / size) : [1, 0, 0];
  };
  const at = (flat, k) => [flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]];

  function multiply(a, b) {
    const found = new Float32Array(16);
    for (let column = 0; column < 4; column++)
      for (let row = 0; row < 4; row++)
        for (let k = 0; k < 4; k++) found[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return found;
  }

  function lookAt(eye, right, up, back) {
    return [
      right[0], up[0], back[0], 0,
      right[1], up[1], back[1], 0,
      right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1,
    ];
  }

  function perspective(angle, aspect, near, far) {
    const f = 1 / Math.tan(angle / 2);
    const depth = 1 / (near - far);
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) * depth, -1, 0, 0, 2 * far * near * depth, 0];
  }

  // A direction across another one.
  function across(along) {
    const sizes = along.map(Math.abs);
    const axis = [0, 0, 0];
    axis[sizes.indexOf(Math.min(...sizes))] = 1;
    return unit(cross(along, axis));
  }

  // Principal directions of points, that of the largest extent first: Jacobi's method.
  function principal(points) {
    const count = points.length;
    const mean = scale(points.reduce(add, [0, 0, 0]), 1 / count);
    const m = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
    for (const point of points) {
      const d = sub(point, mean);
      for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) m[i][j] += (d[i] * d[j]) / count;
    }
    const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for (let turn = 0; turn < 30; turn++) {
      const [p, q] = [[0, 1], [0, 2], [1, 2]][turn % 3];
      if (Math.abs(m[p][q]) < 1e-30) continue;
      const angle = 0.5 * Math.atan2(2 * m[p][q], m[q][q] - m[p][p]);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let k = 0; k < 3; k++) [m[k][p], m[k][q]] = [c * m[k][p] - s * m[k][q], s * m[k][p] + c * m[k][q]];
      for (let k = 0; k < 3; k++) [m[p][k], m[q][k]] = [c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]];
      for (let k = 0; k < 3; k++) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
    }
    return [0, 1, 2]
      .sort((i, j) => m[j][j] - m[i][i])
      .map((k) => ({ direction: [v[0][k], v[1][k], v[2][k]], extent: Math.sqrt(Math.max(m[k][k], 0)) }));
  }

  parts.algebra = { add, sub, scale, dot, cross, norm, unit, at, multiply, lookAt, perspective, across, principal };
})((window.magwireParts ??= {}));
