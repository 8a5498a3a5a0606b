// Puts the page together: node native/apps/web/page/build.mjs COMMAND PACKAGES OUT. COMMAND is the folder of koebe.js and
// koebe.wasm, PACKAGES the folder where the packages of package.json are installed.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [command, packages, out] = process.argv.slice(2).map((path) => resolve(path));
const esbuild = createRequire(join(packages, "package.json"))("esbuild");
const text = (name) => readFileSync(join(here, name), "utf8");
const write = (name, content) => writeFileSync(join(out, name), content);

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
await esbuild.build({
  entryPoints: [join(here, "page.js")], outfile: join(out, "page.js"), bundle: true, minify: true, format: "esm",
  target: "es2022", nodePaths: [join(packages, "node_modules")], legalComments: "inline",
});
const worker = readFileSync(join(command, "koebe.js"), "utf8") + text("worker.js");
write("worker.js", (await esbuild.transform(worker, { minify: true, target: "es2022" })).code);
const rows = text("../../../io/io/mesh_formats.cpp").matchAll(/^ {4}\{"\.(\w+)"/gm);
const formats = [...rows].map((row) => row[1]);
const page = text("index.html").replace("EXTENSIONS", formats.map((one) => `.${one}`).join(","))
  .replace("FORMATS", formats.join(", ").toUpperCase());
write("index.html", page.replace("/* style.css */", (await esbuild.transform(text("style.css"), { loader: "css", minify: true })).code));
copyFileSync(join(command, "koebe.wasm"), join(out, "koebe.wasm"));
copyFileSync(join(here, "../../../blend_samples/face.obj"), join(out, "face.obj"));
const hash = createHash("sha256");
for (const name of ["index.html", "page.js", "worker.js", "koebe.wasm"]) hash.update(readFileSync(join(out, name)));
write("offline.js", text("offline.js").replace("VERSION", hash.digest("hex").slice(0, 16)));
