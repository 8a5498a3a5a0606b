// The page: what is opened, chosen and dragged becomes a run of the command, and its result is drawn.
import { shared } from "./checker.js";
import { DomainView } from "./domain_view.js";
import { colourOf, geometryOf, pointsByVertex } from "./geometry.js";
import { apply, image } from "./moebius.js";
import { cancel, cancelled, run } from "./runs.js";
import { showFigures } from "./report.js";
import { saveButtons } from "./saving.js";
import { SurfaceView } from "./surface_view.js";

const $ = (id) => document.getElementById(id);
const extensions = $("file").accept.split(",");
const prices = { "-2": 0.0009, "-1": 0.0018, 1: 0.0075, 2: 0.015 }; // about a factor of 2 each; 0: the command's own

/** What is mapped, and how. `center` has the vertices of --center and --point, `circles` is a template. */
const state = { file: null, shape: "disk", even: 0, balance: "none", price: 0, center: null, circles: null, result: null };

const light = (k) => {
  shared.lit.value = state.shape === "parts" ? k : -1;
  surface.light(state.shape === "parts" ? -1 : k);
  domain.light(k);
  for (const button of $("loops").querySelectorAll("button")) button.classList.toggle("lit", Number(button.dataset.loop) === k);
};
const surface = new SurfaceView($("surface"), light);
const domain = new DomainView($("domain"), $("circles"), {
  hover: light,
  preview: () => surface.draw(),
  moveCircles: (circles) => mapAgain({ circles: circles.slice(1), center: null }),
  moveDisk,
});

// ---------------------------------------------------------------- the command

function jobOf({ file, shape, even, balance, price, center, circles }) {
  if (shape === "parts") {
    const flags = prices[price] ? ["--price", String(prices[price])] : [];
    if (even > 0) flags.push("--even", String(even));
    return { file, command: "parts", flags };
  }
  if (circles) {
    const ranks = ranksOfLoops(state.result.report.loops);
    const placed = circles.map(({ center: place, radius }, k) => ({ center: place, radius, loop: ranks[k + 1] }));
    return { file, command: "fit", circles: placed, flags: ["--threads", "1"] };
  }
  const flags = ["--threads", "1", "--even", String(even)];
  if (center) flags.push("--center", String(center.center), "--point", String(center.point));
  else flags.push("--balance", balance);
  return { file, command: "uniformize", flags };
}

/** The numbers of the surface's loops, as templates name them: in the order of their lowest vertices. */
function ranksOfLoops(loops) {
  const lowest = loops.map(({ vertices }) => vertices.reduce((a, b) => Math.min(a, b)));
  const sorted = [...lowest].sort((a, b) => a - b);
  return lowest.map((vertex) => sorted.indexOf(vertex));
}

/** @returns whether there is a map now */
async function map(keepView) {
  if (!state.file) return true;
  const begin = performance.now();
  say("");
  $("advice").hidden = true;
  $("progress").hidden = false;
  showProgress(0, "Starting");
  document.body.dataset.state = "running";
  try {
    const result = await run(jobOf(state), showProgress);
    result.seconds = (performance.now() - begin) / 1000;
    receive(result, keepView);
  } catch (error) {
    if (error === cancelled && document.body.dataset.state !== "cancelled") return true; // another run has begun
    say(error === cancelled ? "Cancelled." : error.message, error !== cancelled);
    document.body.dataset.state = error === cancelled ? "cancelled" : "failed";
    showDomainAgain();
  }
  $("progress").hidden = true;
  return document.body.dataset.state === "done";
}

/** Maps again with something changed. A place that has no map is forgotten. */
async function mapAgain(changed) {
  const { center, circles } = state;
  Object.assign(state, changed);
  if (!(await map(true))) Object.assign(state, { center, circles });
}

function receive(result, keepView) {
  $("progress").hidden = true;
  const done = result.report !== null;
  if (!done) {
    say(result.lines.at(-1) ?? "The command ended without a word.", true);
    $("advice").hidden = state.shape === "parts" || !result.mesh;
    document.body.dataset.state = "failed";
    if (state.result && state.result.file === state.file) return showDomainAgain();
  }
  state.result = { ...result, file: state.file };
  show(result, keepView);
  if (!done) return;
  say(doneText(result));
  document.body.dataset.state = "done";
}

const counted = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

function doneText({ report, code, seconds }) {
  const what = report.parts ? counted(report.parts.length, "part") : counted(report.loops.length - 1, "hole");
  return code === 4 ? `Not converged: ${what}. Read the warnings.` : `Done: ${what} in ${seconds.toFixed(1)} s.`;
}

// ---------------------------------------------------------------- what is shown

function show({ mesh, report }, keepView) {
  if (!mesh) return;
  const parts = report?.parts;
  let partOfTriangle = null;
  if (parts) {
    const ofFace = new Map(parts.flatMap(({ faces }, k) => faces.map((face) => [face, k])));
    partOfTriangle = Float32Array.from(mesh.faces, (face) => ofFace.get(face) ?? -1);
  }
  const mapped = report !== null && mesh.uvs !== null;
  const geometry = geometryOf(mapped ? mesh : { ...mesh, uvs: null }, partOfTriangle);
  const loops = mapped && report.loops ? report.loops : [];
  shared.mapped.value = mapped ? 1 : 0;
  document.body.toggleAttribute("data-mapped", mapped);
  shared.lit.value = -1;
  domain.show(geometry.clone(), mesh, loops, partOfTriangle);
  surface.show(geometry, mesh.positions, loops, partOfTriangle, keepView);
  $("reset").hidden = !state.circles && !state.center;
  showFigures(report, loops, light);
  buttons.enable(mapped);
}

function showDomainAgain() {
  if (state.result?.report) show(state.result, true);
  else shared.moved.value.set(0, 0);
}

function showProgress(fraction, stage) {
  $("bar").value = fraction;
  $("stage").textContent = stage ? stage[0].toUpperCase() + stage.slice(1) : "";
}

function say(text, isError = false) {
  $("status").textContent = text;
  $("status").classList.toggle("error", isError);
}

// ---------------------------------------------------------------- the disk moved

/** The whole disk was dragged: the vertex that comes to the middle, and the one that comes to 1, name the same map. */
function moveDisk(a) {
  if (state.circles) return mapAgain({ circles: state.circles.map((circle) => image(a, circle)) });
  const { mesh, report } = state.result, points = pointsByVertex(mesh);
  const nearest = (vertices, away) => vertices.reduce((best, v) => (away(v) < away(best) ? v : best));
  const at = (v) => [points[2 * v], points[2 * v + 1]];
  const onRims = new Set(report.loops.flatMap(({ vertices }) => vertices));
  const inside = Array.from({ length: points.length / 2 }, (_, v) => v).filter((v) => !onRims.has(v) && points[2 * v] === points[2 * v]);
  const center = nearest(inside, (v) => Math.hypot(at(v)[0] - a[0], at(v)[1] - a[1]));
  const point = nearest(report.loops[0].vertices, (v) => Math.hypot(apply(a, at(v))[0] - 1, apply(a, at(v))[1]));
  $("balance").value = "none";
  return mapAgain({ center: { center, point }, balance: "none" });
}

// ---------------------------------------------------------------- what is opened

async function open(name, buffer) {
  if (!extensions.some((one) => name.toLowerCase().endsWith(one)))
    return say(`Koebe UV reads ${extensions.map((one) => one.slice(1).toUpperCase()).join(", ")}.`, true);
  try {
    let file = { name, bytes: new Uint8Array(buffer) };
    // What three.js cannot read goes to the command as it is, which says why.
    if (/\.glb$/i.test(name)) file = await (await import("./gltf_mesh.js")).objOfGltf(name, buffer).catch(() => file);
    Object.assign(state, { file, center: null, circles: null });
    await map(false);
  } catch (error) {
    say(`${name} cannot be read: ${error.message}`, true);
    document.body.dataset.state = "failed";
  }
}

$("file").addEventListener("change", async ({ target }) => {
  const [file] = target.files;
  if (file) await open(file.name, await file.arrayBuffer());
  target.value = "";
});
$("sample").addEventListener("click", async () => open("face.obj", await (await fetch("face.obj")).arrayBuffer()));
if (new URLSearchParams(location.search).has("sample")) $("sample").click(); // the site's link
addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dragged");
});
addEventListener("dragleave", (event) => event.relatedTarget || document.body.classList.remove("dragged"));
addEventListener("drop", async (event) => {
  event.preventDefault();
  document.body.classList.remove("dragged");
  const [file] = event.dataTransfer.files;
  if (file) open(file.name, await file.arrayBuffer());
});

// ---------------------------------------------------------------- dials

function choose(shape) {
  document.querySelector(`input[value=${shape}]`).checked = true;
  for (const [name, hidden] of [["disk-only", shape !== "disk"], ["parts-only", shape !== "parts"]])
    for (const element of document.getElementsByClassName(name)) element.hidden = hidden;
  return mapAgain({ shape, center: null, circles: null });
}
for (const radio of document.getElementsByName("shape")) radio.addEventListener("change", () => choose(radio.value));
$("to-parts").addEventListener("click", () => choose("parts"));
$("even").addEventListener("input", () => ($("even-value").textContent = $("even").value));
$("even").addEventListener("change", () => mapAgain({ even: Number($("even").value), circles: null }));
$("balance").addEventListener("change", () => mapAgain({ balance: $("balance").value, center: null, circles: null }));
$("price").addEventListener("input", () => ($("price-value").textContent =
  { "-2": "many", "-1": "more", 0: "as needed", 1: "fewer", 2: "few" }[$("price").value]));
$("price").addEventListener("change", () => mapAgain({ price: Number($("price").value) }));
$("reset").addEventListener("click", () => mapAgain({ center: null, circles: null }));
$("cancel").addEventListener("click", () => {
  document.body.dataset.state = "cancelled";
  cancel();
});

const buttons = saveButtons({
  result: () => state.result, name: () => state.file.name.replace(/\.\w+$/, ""), picture: () => domain.picture(2048),
});

if ("serviceWorker" in navigator && location.protocol.startsWith("http")) navigator.serviceWorker.register("offline.js");
document.body.dataset.state = "ready";

/** For tests: what the command said. */
window.koebe = { state, open, colourOf };
