// The page in Chromium: node --test tests/web/page.test.mjs. Pictures go to out/web/.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { after, before, test } from "node:test";
import { launch, served } from "./browser.mjs";
import { bad, circleDifference, damaged, good, native, root, samples, sensitivity } from "./meshes.mjs";

const folder = join(root, "dist/web"), pictures = join(root, "out/web");
let server, browser, page, address;

before(async () => {
  mkdirSync(pictures, { recursive: true });
  server = await served(folder);
  address = server.address;
  browser = await launch();
  page = await browser.newPage();
  page.faults = [];
  page.on("pageerror", (error) => page.faults.push(error.message));
  await page.setViewport({ width: 1280, height: 900 });
  await page.goto(address);
});
after(async () => {
  await browser?.close();
  server?.close();
});

const state = () => page.evaluate(() => document.body.dataset.state);
const status = () => page.$eval("#status", (element) => element.textContent);
const report = () => page.evaluate(() => window.koebe.state.result?.report);
async function settled() {
  await page.waitForFunction(() => ["done", "failed", "cancelled"].includes(document.body.dataset.state), { timeout: 600000 });
  return state();
}
async function openPath(path) {
  await page.evaluate(() => (document.body.dataset.state = "waiting"));
  await (await page.$("#file")).uploadFile(path);
  return settled();
}
/** Does something that starts a run, and waits for its end. */
async function after_(action) {
  await page.evaluate(() => (document.body.dataset.state = "waiting"));
  await action();
  return settled();
}
const picture = (name) => page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });

test("a link with ?sample maps the sample at once", async () => {
  await page.goto(`${address}?sample`);
  assert.equal(await settled(), "done", await status());
  await page.goto(address);
});

test("the sample is mapped, and drawn at a desktop's and at a phone's width", async () => {
  await picture("empty");
  assert.equal(await after_(() => page.click("#sample")), "done", await status());
  await picture("desktop");
  await page.setViewport({ width: 390, height: 844 });
  await picture("phone");
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "wider than a phone");
  await page.setViewport({ width: 1280, height: 900 });
});

test("a hole under the pointer lights in the list, in the domain and on the surface", async () => {
  const circle = await (await page.$("#circles circle[data-loop='1']")).boundingBox();
  await page.mouse.move(circle.x + circle.width / 2, circle.y + circle.height / 2);
  const lit = () => page.$$eval(".lit", (elements) => elements.map((element) => element.dataset.loop));
  assert.deepEqual(await lit(), ["1", "1"]);
  await picture("hover");
  await page.focus("#loops button[data-loop='2']");
  assert.deepEqual(await lit(), ["2", "2"]);
});

test("a dragged circle goes where it is let go, and back", async () => {
  const { x, y, width } = await (await page.$("#circles circle[data-loop='1']")).boundingBox();
  const before_ = (await report()).loops[1];
  await after_(async () => {
    await page.mouse.move(x + width / 2, y + width / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 12, y + width / 2 + 6, { steps: 4 });
    await page.mouse.up();
  });
  assert.equal(await state(), "done", await status());
  const now = await report();
  assert.ok(now.loops[1].center[0] > before_.center[0] && now.loops[1].center[1] < before_.center[1]);
  assert.equal(now.flipped, 0);
  await picture("dragged");
  assert.equal(await after_(() => page.click("#reset")), "done");
  assert.ok(circleDifference((await report()).loops.slice(1, 2), [before_]) < 1e-12);
});

test("arrow keys move a circle, Enter maps", async () => {
  const before_ = (await report()).loops[2];
  await page.$eval("#circles circle[data-loop='2']", (circle) => circle.focus());
  await page.keyboard.press("ArrowUp");
  assert.equal(await after_(() => page.keyboard.press("Enter")), "done", await status());
  assert.ok(Math.abs((await report()).loops[2].center[1] - before_.center[1] - 0.02) < 1e-9);
  await after_(() => page.click("#reset"));
});

test("the disk is dragged by a Möbius map", async () => {
  const before_ = (await report()).loops;
  const { x, y, width, height } = await (await page.$("#circles")).boundingBox();
  await after_(async () => {
    await page.mouse.move(x + width / 2, y + height * 0.5);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 40, y + height * 0.5, { steps: 4 });
    await page.mouse.up();
  });
  assert.equal(await state(), "done", await status());
  const inversive = ([a, b]) => Math.abs(a.radius ** 2 + b.radius ** 2 - Math.hypot(a.center[0] - b.center[0], a.center[1] - b.center[1]) ** 2) / (2 * a.radius * b.radius);
  const [p, q] = [before_.slice(1, 3), (await report()).loops.slice(1, 3)].map(inversive);
  assert.ok(Math.abs(p / q - 1) < 0.02, `inversive distances ${p}, ${q}`);
  await after_(() => page.click("#reset"));
});

test("the dials reach the command", async () => {
  const set = (id, value) => page.$eval(`#${id}`, (element, to) => {
    element.value = to;
    element.dispatchEvent(new Event("input"));
    element.dispatchEvent(new Event("change"));
  }, value);
  const spread = async () => (await report()).area_distortion.log_sd;
  const conformal = await spread();
  assert.equal(await after_(() => set("even", 0.8)), "done", await status());
  assert.ok((await spread()) < 0.8 * conformal);
  await after_(() => set("even", 0));
  assert.equal(await after_(() => set("balance", "area")), "done");
  assert.ok((await spread()) < conformal);
  await after_(() => set("balance", "none"));
});

test("a run is cancelled at once, and the next one works", async () => {
  await page.evaluate(() => (document.body.dataset.state = "waiting"));
  await page.click("input[value=parts]");
  await page.waitForSelector("#progress:not([hidden])");
  await page.click("#cancel");
  assert.equal(await settled(), "cancelled");
  assert.equal(await after_(() => page.click("input[value=disk]")), "done", await status());
});

test("a GLB file is mapped as its OBJ", async () => {
  const points = [[0, 0, 0], [3, 0, 0], [3, 3, 0.5], [0, 3, 0], [1, 1, 0], [2, 1, 0], [2, 2, 0.25], [1, 2, 0]];
  const faces = [[0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]];
  const corners = new Float32Array(faces.flat().flatMap((v) => points[v]));
  const json = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], buffers: [{ byteLength: corners.byteLength }],
    bufferViews: [{ buffer: 0, byteLength: corners.byteLength }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 24, type: "VEC3", min: [0, 0, 0], max: [3, 3, 0.5] }] };
  let text = JSON.stringify(json);
  text += " ".repeat((4 - (text.length % 4)) % 4);
  const head = Buffer.alloc(20), middle = Buffer.alloc(8);
  [0x46546c67, 2, 28 + text.length + corners.byteLength, text.length, 0x4e4f534a].forEach((x, i) => head.writeUInt32LE(x, 4 * i));
  [corners.byteLength, 0x004e4942].forEach((x, i) => middle.writeUInt32LE(x, 4 * i));
  const path = join(pictures, "square.glb");
  writeFileSync(path, Buffer.concat([head, Buffer.from(text), middle, Buffer.from(corners.buffer)]));
  assert.equal(await openPath(path), "done", await status());
  const { loops, faces: count, vertices } = await report();
  assert.deepEqual([loops.length, count, vertices], [2, 8, 8]);
});

for (const [name, text] of Object.entries(damaged))
  test(`${name}: the page says why it is refused`, async () => {
    const path = join(pictures, name);
    writeFileSync(path, text);
    assert.equal(await openPath(path), "failed");
    assert.equal(await status(), native(path).lines.at(-1));
  });

test("a file of another kind is refused", async () => {
  const path = join(pictures, "text.txt");
  writeFileSync(path, "hello");
  await (await page.$("#file")).uploadFile(path);
  await page.waitForFunction(() => document.getElementById("status").textContent.includes("reads OBJ"));
});

/**
 * The page's answer is the command's: its circles, or its error's sentence. Where the command itself had to give up circles of a
 * mesh that is too coarse or damaged, the last bits decide which circles it takes instead, and the page must say so too.
 */
const asNative = (path, givenUp = []) => async () => {
  const expected = native(path);
  assert.equal(await openPath(path), expected.report ? "done" : "failed", await status());
  if (!expected.report) return assert.equal(await status(), expected.lines.at(-1));
  const found = await report();
  const difference = circleDifference(found.loops, expected.report.loops);
  if (difference < 1e-9 || difference <= sensitivity(path)) return;
  const gaveUp = ({ warnings }) => warnings.some(({ kind }) => givenUp.includes(kind));
  assert.ok(gaveUp(expected.report) && gaveUp(found), `circles differ by ${difference}`);
  assert.deepEqual([found.loops.length, found.converged, found.flipped], [expected.report.loops.length, expected.report.converged, 0]);
};

// Every one of them with KOEBE_ALL, else the samples and five scans: the rest takes minutes.
for (const path of process.env.KOEBE_ALL ? good : [...samples, ...good.slice(0, 5)])
  test(`${basename(path)} has the native circles in the browser`, asNative(path));
for (const path of process.env.KOEBE_ALL ? bad : [])
  test(`${basename(path)} gets the native answer in the browser`, asNative(path, ["shrunk_circles", "replaced_circles", "lost_circles"]));

test("it works without a network once it was loaded", async () => {
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.setOfflineMode(true);
  await page.reload();
  assert.equal(await after_(() => page.click("#sample")), "done", await status());
  await page.setOfflineMode(false);
});

test("nothing went wrong unseen", () => assert.deepEqual(page.faults, []));
