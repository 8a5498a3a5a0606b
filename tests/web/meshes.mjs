// The meshes of the tests, and what build/koebe makes of them.
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(fileURLToPath(import.meta.url), "../../..");
const shared = resolve(root, "../shared/meshes"); // scans that are not in this repository, where they are present

const filesOf = (folder, kinds = /\.obj$/) =>
  existsSync(folder) ? readdirSync(folder).filter((name) => kinds.test(name)).sort().map((name) => join(folder, name)) : [];
export const samples = filesOf(join(root, "blend_samples")).filter((path) => !path.includes("template"));
export const good = existsSync(join(shared, "good")) ? filesOf(join(shared, "good")) : samples;
/** Scans and models that are damaged, or no surface with holes. */
export const bad = ["broken", "broken2", "hostile"].flatMap((name) => filesOf(join(shared, name), /\.(obj|ply|stl|off|glb)$/i));

/** Text files that are no surface with holes, each with the end of its name, by the fault. */
export const damaged = {
  "ends_early.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
  "no_number.obj": "v 0 0 0\nv 1 0 zero\nv 0 1 0\nf 1 2 3\n",
  "no_vertex.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
  "infinite.obj": "v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n",
  "empty.stl": "",
  "no_header.off": "hello\n",
  "no_scene.glb": "hello\n",
  "closed.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
  "three_faces_at_an_edge.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n",
};

/** What the command says and writes: {code, lines, report}. */
export function native(path, command = "uniformize", flags = ["--threads", "1"]) {
  const folder = mkdtempSync(join(tmpdir(), "koebe-web-"));
  const report = join(folder, "report.json");
  try {
    const { status, stderr } = spawnSync(join(root, "build/koebe"), [command, path, join(folder, "out.obj"), "--json", report, ...flags]);
    const lines = stderr.toString().replaceAll(path, basename(path)).split("\n").filter(Boolean);
    return { code: status, lines, report: existsSync(report) ? JSON.parse(readFileSync(report, "utf8")) : null };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** The largest difference of any centre's coordinate or radius. */
export function circleDifference(a, b) {
  if (a.length !== b.length) return Infinity;
  const numbers = (loops) => loops.flatMap(({ center, radius }) => [...center, radius]);
  const others = numbers(b);
  return Math.max(...numbers(a).map((x, i) => Math.abs(x - others[i])));
}

/**
 * How much the native circles of an OBJ file change if its coordinates do, by a part in 1e14: where flipped faces are turned
 * back, the last bits can decide how. Systems differ in the last bits of sines and logarithms.
 */
export function sensitivity(path) {
  const { loops } = native(path).report;
  const folder = mkdtempSync(join(tmpdir(), "koebe-web-"));
  try {
    return Math.max(...[1, 2, 3].map((seed) => {
      let state = seed;
      const noise = () => ((state = (state * 48271) % 2147483647) % 3) - 1;
      const line = (text) => text.startsWith("v ") ? "v " + text.slice(2).trim().split(/\s+/).map((x) => Number(x) * (1 + 1e-14 * noise())).join(" ") : text;
      const copy = join(folder, basename(path));
      writeFileSync(copy, readFileSync(path, "utf8").split("\n").map(line).join("\n"));
      return circleDifference(native(copy).report.loops, loops);
    }));
  } finally {
    rmSync(folder, { recursive: true });
  }
}
