// The command in WebAssembly, without a browser: node --test tests/web/command.test.mjs
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join } from "node:path";
import test from "node:test";
import { circleDifference, damaged, native, root, samples } from "./meshes.mjs";

const page = join(root, "dist/web");
const { runCommand } = createRequire(import.meta.url)(join(page, "worker.js"));
const module = await WebAssembly.compile(readFileSync(join(page, "koebe.wasm")));
const onThread = ["--threads", "1"];

const runOn = (name, bytes, job = {}, progress = () => {}) =>
  runCommand({ module, file: { name, bytes }, command: "uniformize", flags: onThread, ...job }, progress);
const runFile = (path, ...rest) => runOn(basename(path), readFileSync(path), ...rest);

for (const path of samples)
  test(`${basename(path)} has the circles of the native command`, async () => {
    const { code, report, mesh } = await runFile(path);
    assert.equal(code, 0);
    assert.ok(circleDifference(report.loops, native(path).report.loops) < 1e-9);
    assert.equal(report.flipped, 0);
    assert.equal(mesh.faces.length, report.faces);
  });

test("the drawn corners lie where the report says", async () => {
  const { report, mesh } = await runFile(samples[0]);
  report.loops.forEach(({ vertices, center, radius, off_circle: off }) => {
    for (const v of vertices.filter((vertex) => !off.includes(vertex))) {
      const i = mesh.corners.indexOf(v);
      const [x, y] = [2 * mesh.uvs[2 * i] - 1, 2 * mesh.uvs[2 * i + 1] - 1];
      assert.ok(Math.abs(Math.hypot(x - center[0], y - center[1]) - radius) < 1e-5);
    }
  });
});

test("progress rises, and names stages", async () => {
  const seen = [];
  await runFile(samples[0], {}, (fraction, stage) => seen.push([fraction, stage]));
  assert.ok(seen.length > 3 && seen.every(([fraction], i) => i === 0 || fraction >= seen[i - 1][0]));
  assert.ok(new Set(seen.map(([, stage]) => stage)).size > 2);
});

test("circles go where a template has them", async () => {
  const circles = [[0, -0.4, 0.2], [-0.35, 0.3, 0.15], [0.35, 0.3, 0.15]].map(([x, y, radius]) => ({ center: [x, y], radius }));
  const { code, report } = await runFile(samples[0], { command: "fit", circles });
  assert.equal(code, 0);
  assert.ok(circleDifference(report.loops.slice(1), circles) < 1e-12);
});

test("any mesh is cut into parts", async () => {
  const closed = new TextEncoder().encode(damaged["closed.obj"]);
  const { code, report } = await runOn("closed.obj", closed, { command: "parts", flags: [] });
  assert.equal(code, 0);
  assert.equal(report.parts.flatMap(({ faces }) => faces).length, 4);
});

test("the same bytes again: a run leaves nothing behind", async () => {
  const [a, b] = [await runFile(samples[0]), await runFile(samples[0])];
  assert.deepEqual(a.obj, b.obj);
});

for (const [name, text] of Object.entries(damaged))
  test(`${name} is refused in the native command's words`, async (context) => {
    const folder = mkdtempSync(join(root, "build/web-test-"));
    context.after(() => rmSync(folder, { recursive: true }));
    const path = join(folder, name);
    writeFileSync(path, text);
    const { code, lines, report } = await runOn(name, new TextEncoder().encode(text));
    const expected = native(path);
    assert.equal(report, null);
    assert.equal(code, expected.code);
    assert.deepEqual(lines, expected.lines);
  });
