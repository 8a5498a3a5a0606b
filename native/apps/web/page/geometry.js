// What both views draw: a geometry of corners with points of the disk, and the loops.
import { BufferAttribute, BufferGeometry } from "three";

/** Corners of triangles: `position`, smooth `normal`, `uv` in the disk's coordinates, `part`. */
export function geometryOf({ positions, corners, uvs }, partOfTriangle) {
  const indexed = new BufferGeometry();
  indexed.setAttribute("position", new BufferAttribute(positions, 3));
  indexed.setIndex(new BufferAttribute(new Uint32Array(corners), 1));
  indexed.computeVertexNormals();
  const geometry = indexed.toNonIndexed();
  const points = new Float32Array(2 * corners.length), parts = new Float32Array(corners.length).fill(-1);
  if (uvs) for (let i = 0; i < points.length; ++i) points[i] = 2 * uvs[i] - 1;
  if (partOfTriangle) for (let i = 0; i < parts.length; ++i) parts[i] = partOfTriangle[Math.floor(i / 3)];
  geometry.setAttribute("uv", new BufferAttribute(points, 2));
  geometry.setAttribute("part", new BufferAttribute(parts, 1));
  geometry.computeBoundingSphere();
  return geometry;
}

/** (V, 2) points of the disk by vertex, for maps that have one for each. */
export function pointsByVertex({ positions, corners, uvs }) {
  const points = new Float32Array((positions.length / 3) * 2).fill(NaN);
  corners.forEach((vertex, i) => points.set([2 * uvs[2 * i] - 1, 2 * uvs[2 * i + 1] - 1], 2 * vertex));
  return points;
}

/** The triangle of the domain at a point, or -1. */
export function triangleAt({ corners, uvs }, [x, y]) {
  const u = (1 + x) / 2, v = (1 + y) / 2;
  for (let t = 0; t < corners.length / 3; ++t) {
    const at = (k) => [uvs[6 * t + 2 * k] - u, uvs[6 * t + 2 * k + 1] - v];
    const [a, b, c] = [at(0), at(1), at(2)];
    const side = (p, q) => p[0] * q[1] - p[1] * q[0];
    if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) return t;
  }
  return -1;
}

/** A colour for each loop; the golden angle keeps neighbours apart. */
export const colourOf = (loop) => (loop === 0 ? "hsl(222, 60%, 58%)" : `hsl(${(40 + 137.5 * (loop - 1)) % 360}, 75%, 58%)`);
