// The report of a real run in a real browser: check_run.mjs TILTH
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { canvasColors, livePlot, openBrowser, openPage } from "./browser.mjs";

// Loops where hardly a way is gone: a keyframe every step, held against those just passed.
const kLoops = ["--loop-closure", "--set", "loop.keyframe.distance=0.1", "--set", "loop.detect.min_path=0.5", "--set", "loop.submap_from=1"];
const tilth = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "tilth-web-"));
const browser = await openBrowser();

function rows(file, separator) {
  const text = readFileSync(join(folder, "out", file), "utf8").trim();
  return text.split("\n").map((line) => line.split(separator));
}

function column(name, file = "scans.csv", kind = Number) {
  const [head, ...body] = rows(file, ",");
  return body.map((row) => kind(row[head.indexOf(name)]));
}

function sum(counts) {
  return Object.values(counts).reduce((a, b) => a + b, 0);
}

/** Share of pixels that are not of the commonest colour. */
function drawnRatio(counts) {
  return 1 - Math.max(...Object.values(counts)) / sum(counts);
}

async function theCurvesHoldTheData(page) {
  const { data } = await livePlot(page, "scan_time");
  const [stamps, times] = [column("stamp"), column("ms_register")];
  assert.equal(data[0].length, stamps.length);
  for (const i of [0, 7, stamps.length - 1]) {
    assert.ok(Math.abs(data[0][i] - (stamps[i] - stamps[0])) < 1e-3);
    assert.ok(Math.abs(data[1][i] - times[i]) < 1e-3);
  }
  const speed = await livePlot(page, "speed");
  assert.equal(speed.data.length, 4, "time, truth, before loop closure, estimate");
}

async function theLoopsAreShown(page) {
  const verdicts = column("verdict", "closures.csv", String).filter((verdict) => verdict === "accepted");
  assert.ok(verdicts.length > 0, "the run closes loops");
  const { keyframes, closures, paths } = await page.evaluate(() => JSON.parse(document.getElementById("report").textContent).map);
  assert.equal(closures.length, verdicts.length);
  assert.ok(keyframes.length > verdicts.length / 2);
  assert.deepEqual(paths.map((path) => path.name), ["tilth", "before loop closure", "truth"]);
  await page.evaluate(() => window.scrollTo(0, 0));
  const parts = ["keyframes", "loop closures", "trajectory", "truth", "before loop closure"]; // from the uppermost down
  for (const part of parts) {
    const before = await canvasColors(page);
    await page.locator("#map label", { hasText: part }).locator("input").uncheck();
    assert.notDeepEqual(await canvasColors(page), before, `${part}: not drawn`);
  }
  for (const part of parts) await page.locator("#map label", { hasText: part }).locator("input").check();
  await livePlot(page, "top_view");
  const top = page.locator('figure[data-plot="top_view"]');
  assert.equal(await top.locator(".dots circle").count(), keyframes.length);
  assert.equal(await top.locator(".links path").count(), closures.length);
}

async function theSliderMovesTheRobot(page) {
  const readout = page.locator("#map output");
  const before = await readout.textContent();
  await page.locator('#map input[title="moment of the run"]').evaluate((slider) => {
    slider.value = 2;
    slider.dispatchEvent(new Event("input"));
  });
  const after = await readout.textContent();
  assert.notEqual(after, before);
  const poses = rows("trajectory.tum", " ").map((row) => row.map(Number));
  const pose = poses.filter((p) => p[0] - poses[0][0] <= 2.0 + 1e-6).at(-1);
  const numbers = after.replaceAll("−", "-").match(/-?\d+\.\d+/g).map(Number);
  assert.equal(numbers[0], 2.0);
  for (const axis of [1, 2, 3]) assert.ok(Math.abs(numbers[axis] - pose[axis]) < 0.0051, after);
}

async function aResizeWorks(page) {
  const before = await livePlot(page, "speed");
  await page.setViewportSize({ width: 600, height: 800 });
  await page.waitForFunction((w) => document.querySelector("#map canvas").getBoundingClientRect().width < w, 600);
  await page.waitForTimeout(300);
  const after = await livePlot(page, "speed");
  assert.ok(Math.abs(after.width - after.place) < 2, "the plot fills its place");
  assert.ok(before.width !== after.width);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 600, `nothing sticks out: ${wide}`);
  assert.ok(drawnRatio(await canvasColors(page)) > 0.02);
}

async function hoveringSaysTheValue(page) {
  const figure = page.locator('figure[data-plot="ape"]');
  await livePlot(page, "ape");
  const over = await figure.locator(".u-over").boundingBox();
  await page.mouse.move(over.x + over.width / 2, over.y + over.height / 2);
  await page.waitForFunction(() => /\d m/.test(document.querySelector('figure[data-plot="ape"] .u-legend').textContent));
}

async function itTurnsUnderTheMouse(page) {
  await page.evaluate(() => window.scrollTo(0, 0));
  const before = await canvasColors(page);
  const box = await page.locator("#map canvas").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 150, box.y + box.height / 2 + 60, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(600);
  assert.notDeepEqual(await canvasColors(page), before);
}

try {
  execFileSync(tilth, ["simulate", "corridor", "--out", join(folder, "sim"), "--duration", "16", "--quiet"]);
  execFileSync(tilth, ["run", join(folder, "sim"), "--out", join(folder, "out"), "--truth", join(folder, "sim/truth.tum"), "--quiet", ...kLoops]);
  const report = join(folder, "out/report.html");
  assert.ok(readdirSync(join(folder, "out/plots")).includes("ape.svg"));

  const page = await openPage(browser, report);
  assert.ok(drawnRatio(await canvasColors(page)) > 0.02, "the map is drawn");
  await theCurvesHoldTheData(page);
  await theLoopsAreShown(page);
  await hoveringSaysTheValue(page);
  await theSliderMovesTheRobot(page);
  await itTurnsUnderTheMouse(page);
  await aResizeWorks(page);
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests.filter((url) => !/^(file|blob|data):/.test(url)), [], "nothing is fetched");

  const dark = await openPage(browser, report, { colorScheme: "dark" });
  const background = (p) => p.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.notEqual(await background(dark), await background(page));
  assert.ok(drawnRatio(await canvasColors(dark)) > 0.02);
  assert.deepEqual(dark.complaints, []);

  const still = await openPage(browser, report, { javaScriptEnabled: false });
  assert.ok((await still.locator("figure svg").count()) > 15, "without its script the page has its drawings");
  assert.match(await still.locator("table").first().textContent(), /RMSE/);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
