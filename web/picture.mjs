// A picture of a report's 3D view: node web/picture.mjs REPORT PICTURE.png [hide=PART,...] [cut=SHARE] [from=top]
// PART: map, trajectory, truth, grid. SHARE, 0 to 1, of the height up to which the map is shown.
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [report, picture, ...choices] = process.argv.slice(2);
if (!picture) {
  console.error("usage: node web/picture.mjs REPORT PICTURE.png [hide=PART,...] [cut=SHARE] [from=top]");
  process.exit(2);
}
const chosen = Object.fromEntries(choices.map((choice) => choice.split("=")));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  timeout: 120_000,
});
const page = await browser.newPage({ viewport: { width: 1000, height: 860 } });
page.setDefaultTimeout(300_000);
await page.goto(pathToFileURL(report).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "yes");
for (const part of chosen.hide?.split(",") ?? []) await page.locator("#map label", { hasText: part }).first().locator("input").uncheck();
if (chosen.hide) await page.locator("#map button", { hasText: "oblique" }).click();
if (chosen.from === "top") await page.locator("#map button", { hasText: "from above" }).click();
if (chosen.cut) {
  await page.locator("#map .cut input").evaluate((slider, share) => {
    slider.value = share;
    slider.dispatchEvent(new Event("input"));
  }, chosen.cut);
}
await page.evaluate(() => document.querySelector("#map .hint").remove());
await page.waitForTimeout(500);
await page.waitForFunction(() => Number(document.querySelector("#map .stage").dataset.drawn) >= Number(document.querySelector("#map .count").dataset.points));
await page.locator("#map .stage").screenshot({ path: picture });
await browser.close();
