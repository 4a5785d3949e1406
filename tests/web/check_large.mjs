// Two million points: the page opens soon and is not large: check_large.mjs PROBE [SECONDS]
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { openBrowser, openPage } from "./browser.mjs";

const kMegabytes = 22; // of points that lie without order; those of a real map pack better
const seconds = Number(process.argv[3] ?? 30); // a shared machine without a graphics card may be slow

const folder = mkdtempSync(join(tmpdir(), "tilth-web-"));
const browser = await openBrowser();
try {
  execFileSync(process.argv[2], [folder, "2000000", "large"]);
  const report = join(folder, "report.html");
  const megabytes = statSync(report).size / 1e6;
  assert.ok(megabytes < kMegabytes, `${megabytes} MB`);
  const page = await openPage(browser, report);
  const opened = await page.evaluate(() => performance.now() / 1000);
  console.log(`${megabytes.toFixed(1)} MB, opened within ${opened.toFixed(1)} s`);
  assert.ok(opened < seconds, `${opened} s`);
  assert.equal(await page.locator("#map .count").textContent(), "2,000,000 points");
  assert.equal(await page.locator("#map label", { hasText: "loop closures" }).count(), 1);
  assert.deepEqual(page.complaints, []);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
