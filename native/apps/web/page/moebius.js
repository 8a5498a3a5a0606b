// Automorphisms z -> (z - a) / (1 - conj(a) z) of the unit disk, for what is drawn while the disk is dragged. The command
// makes the map itself.

export const apply = ([ax, ay], [x, y]) => {
  const above = [x - ax, y - ay], below = [1 - ax * x - ay * y, ay * x - ax * y];
  const size = below[0] ** 2 + below[1] ** 2;
  return [(above[0] * below[0] + above[1] * below[1]) / size, (above[1] * below[0] - above[0] * below[1]) / size];
};

/** The one that takes p to q: a (1 - |c|^2) = d + c conj(d), c = p q, d = p - q. */
export function taking([px, py], [qx, qy]) {
  const c = [px * qx - py * qy, px * qy + py * qx], d = [px - qx, py - qy];
  const size = 1 - c[0] ** 2 - c[1] ** 2;
  return [(d[0] + c[0] * d[0] + c[1] * d[1]) / size, (d[1] + c[1] * d[0] - c[0] * d[1]) / size];
}

/** Image of a circle inside the disk: the circle through the images of three of its points. */
export function image(a, { center: [x, y], radius }) {
  const [[x0, y0], [x1, y1], [x2, y2]] = [0, 2, 4].map((angle) =>
    apply(a, [x + radius * Math.cos(angle), y + radius * Math.sin(angle)]));
  const bx = x1 - x0, by = y1 - y0, cx = x2 - x0, cy = y2 - y0, twice = 2 * (bx * cy - by * cx);
  const b = bx * bx + by * by, c = cx * cx + cy * cy;
  const from = [(cy * b - by * c) / twice, (bx * c - cx * b) / twice];
  return { center: [x0 + from[0], y0 + from[1]], radius: Math.hypot(...from) };
}
