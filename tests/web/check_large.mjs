// Two million points: the page opens soon and is not large: check_large.mjs PROBE [SECONDS]
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { openBrowser, openPage } from "./browser.mjs";

const kMegabytes = 14; // measured: 10.8
const seconds = Number(process.argv[3] ?? 20); // measured: 6 s without a graphics card, on two shared cores

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
  const count = parseInt((await page.locator("#map .count").textContent()).replaceAll(",", ""), 10);
  assert.ok(count <= 2e6 && count > 1.99e6, `${count} points`); // thinned evenly, by share
  assert.equal(await page.locator("#map label", { hasText: "loop closures" }).count(), 1);
  assert.deepEqual(page.complaints, []);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
