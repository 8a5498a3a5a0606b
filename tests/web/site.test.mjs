// The site of `make docs` in Chromium: node --test tests/web/site.test.mjs. Pictures go to out/site/.
import assert from "node:assert/strict";
import { mkdirSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, packages, served } from "./browser.mjs";
import { root } from "./meshes.mjs";

const { source: axe } = packages("axe-core");
const site = join(root, "build/docs/html"), pictures = join(root, "out/site");
const pages = readdirSync(site, { recursive: true }).filter((name) => name.endsWith(".html") && !name.startsWith("try")).sort();
let server, browser, page;

before(async () => {
  mkdirSync(pictures, { recursive: true });
  server = await served(site);
  browser = await launch();
  page = await browser.newPage();
  page.setDefaultNavigationTimeout(300000);
});
after(async () => {
  await browser?.close();
  server?.close();
});

async function open(name, scheme, width) {
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
  await page.setViewport({ width, height: 844 });
  await page.goto(server.address + name);
}
/** What axe-core finds, a rule and an element each: by all rules of WCAG 2 at level AA, or in the dark of letters' contrast. */
async function faults(scheme) {
  const all = { type: "tag", values: ["wcag2a", "wcag2aa", "wcag21aa"] }, contrast = { type: "rule", values: ["color-contrast"] };
  await page.evaluate(axe);
  const { violations } = await page.evaluate((runOnly) => window.axe.run({ runOnly }), scheme === "dark" ? contrast : all);
  return violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 160)}`));
}

test("versions that stand beside the site are offered", async () => {
  const old = join(site, "versions.txt");
  writeFileSync(old, "1.0.0\n0.9.0\n");
  try {
    await open("reference/blender/index.html", "light", 1280);
    const list = await page.waitForSelector("select[aria-label=Version]");
    assert.deepEqual(await list.$$eval("option", (all) => all.map((one) => one.textContent)), ["newest", "1.0.0", "0.9.0"]);
    const [newest, first] = await list.$$eval("option", (all) => all.map((one) => one.value));
    assert.ok(newest === server.address && first === `${newest}1.0.0/`);
    assert.deepEqual(await faults(), []);
  } finally {
    rmSync(old);
  }
});

for (const name of pages)
  for (const scheme of ["light", "dark"])
    test(`${name}, ${scheme}`, async () => {
      await open(name, scheme, 390);
      assert.deepEqual(await faults(scheme), []);
      const wide = () => [...document.querySelectorAll("article *")].filter((one) => {
        const box = one.getBoundingClientRect();
        return box.right > innerWidth + 1 && box.width > 0 && !one.closest("pre, .table-wrapper, mjx-container, .sig");
      }).map((one) => one.outerHTML.slice(0, 160));
      assert.deepEqual(await page.evaluate(wide), [], "wider than a phone");
      if (["index.html", "guide.html", "comparison.html"].includes(name))
        await page.screenshot({ path: join(pictures, `${name}-${scheme}.png`) });
    });
