// The site of `make docs` in Chromium: node --test tests/web/site.test.mjs. Pictures go to out/site/.
import assert from "node:assert/strict";
import { mkdirSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { root } from "./meshes.mjs";

const packages = createRequire(join(root, "build/web/page/package.json"));
const { source: axe } = packages("axe-core");
const site = join(root, "build/docs/html"), pictures = join(root, "out/site");
const pages = readdirSync(site, { recursive: true }).filter((name) => name.endsWith(".html")).sort();
let browser, page;

before(async () => {
  mkdirSync(pictures, { recursive: true });
  browser = await packages("puppeteer-core").launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", protocolTimeout: 900000,
    args: ["--no-sandbox", "--allow-file-access-from-files"],
  });
  page = await browser.newPage();
  await page.setRequestInterception(true);
  page.on("request", (request) => (request.url().startsWith("http") ? request.abort() : request.continue()));
  page.setDefaultNavigationTimeout(300000);
});
after(() => browser?.close());

async function open(name, scheme, width) {
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
  await page.setViewport({ width, height: 844 });
  await page.goto(pathToFileURL(join(site, name)).href);
}
/** What axe-core finds, by the rules of WCAG 2 at level AA: a rule, an element and what is wrong with it. */
async function faults() {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa"] }));
  return violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 160)}`));
}

for (const name of pages)
  for (const scheme of ["light", "dark"])
    test(`${name}, ${scheme}`, async () => {
      await open(name, scheme, 390);
      assert.deepEqual(await faults(), []);
      const wide = () => [...document.querySelectorAll("article *")].filter((one) => {
        const box = one.getBoundingClientRect();
        return box.right > innerWidth + 1 && box.width > 0 && !one.closest("pre, .table-wrapper, mjx-container, .sig");
      }).map((one) => one.outerHTML.slice(0, 160));
      assert.deepEqual(await page.evaluate(wide), [], "wider than a phone");
      if (["index.html", "guide.html", "comparison.html"].includes(name))
        await page.screenshot({ path: join(pictures, `${name}-${scheme}.png`) });
    });
