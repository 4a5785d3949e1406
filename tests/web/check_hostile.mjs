// Names made to break the page do not: check_hostile.mjs PROBE, where PROBE OUT POINTS NAME writes a report.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { livePlot, openBrowser, openPage } from "./browser.mjs";

const kName = `a</script><script>window.broken=1</script><img src=x onerror="window.broken=2">'"\n<!--<svg onload=window.broken=3>\${1}&amp;`;
const kPlots = ["top_view", "speed", "ape", "ape_path", "stage_time", "stage_boxes", "time_histogram"];

const folder = mkdtempSync(join(tmpdir(), "tilth-web-"));
const browser = await openBrowser();
try {
  execFileSync(process.argv[2], [folder, "2000", kName]);
  const page = await openPage(browser, join(folder, "report.html"));
  for (const id of kPlots) await livePlot(page, id);
  const box = await page.locator('figure[data-plot="stage_boxes"] svg').first().boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.equal(await page.locator("img").count(), 0);
  assert.equal(await page.locator("h1").textContent(), kName.split("/").at(-1));
  const tables = await page.locator("#setup").textContent();
  assert.ok(tables.includes(kName), "the name stands in the page as it is");
  assert.deepEqual(page.complaints, []);

  const drawing = await browser.newPage();
  await drawing.goto(`file://${join(folder, "plots/stage_boxes.svg")}`);
  assert.equal(await drawing.evaluate(() => document.documentElement.tagName), "svg", "well-formed XML");
  assert.equal(await drawing.evaluate(() => window.broken), undefined);
  assert.ok(readFileSync(join(folder, "plots/stage_boxes.svg"), "utf8").includes("&lt;/script&gt;"));
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
