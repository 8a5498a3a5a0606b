// How much slower the page's command is than the native one on one thread: node bench/web_speed.mjs MESH...
// Both run in turn, five times; the median of the seconds that the reports have.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join } from "node:path";
import { native, root } from "../tests/web/meshes.mjs";

const page = join(root, "dist/web"), flags = ["--threads", "1"];
const { runCommand } = createRequire(import.meta.url)(join(page, "worker.js"));
const module = await WebAssembly.compile(readFileSync(join(page, "koebe.wasm")));
const median = (numbers) => numbers.sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

console.log("| mesh | faces | native, s | WebAssembly, s | ratio |\n| --- | --- | --- | --- | --- |");
for (const path of process.argv.slice(2)) {
  const times = [[], []], file = { name: basename(path), bytes: readFileSync(path) };
  let faces = 0;
  for (let k = 0; k < 5; ++k) {
    times[0].push(native(path).report.seconds.total);
    const { report } = await runCommand({ module, file, command: "uniformize", flags }, () => {});
    times[1].push(report.seconds.total);
    faces = report.faces;
  }
  const [one, other] = times.map(median);
  console.log(`| ${file.name} | ${faces} | ${one.toFixed(3)} | ${other.toFixed(3)} | ${(other / one).toFixed(2)} |`);
}
