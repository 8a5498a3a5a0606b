// A folder served on this machine, and Chromium.
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join } from "node:path";
import { root } from "./meshes.mjs";

export const packages = createRequire(join(root, "build/web/page/package.json"));
const types = {
  ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm", ".obj": "text/plain",
};

/** Serves the folder: {address, close}. */
export async function served(folder) {
  const server = createServer((request, answer) => {
    const name = decodeURIComponent(new URL(request.url, "http://x").pathname);
    const path = join(folder, name.endsWith("/") ? `${name}index.html` : name);
    if (!existsSync(path)) return answer.writeHead(404).end();
    answer.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream" }).end(readFileSync(path));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export const launch = () => packages("puppeteer-core").launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", protocolTimeout: 900000,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
