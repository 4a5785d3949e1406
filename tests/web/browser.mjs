// A page in Chromium, without a network: what it says on its console and what it asks for is remembered. Where Chromium,
// playwright-core or the page's script is missing, the test is skipped by name; where CI=true that is a failure.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath, pathToFileURL } from "node:url";

const kSkipped = 77;
const kPatience = 400_000; // [ms] on a machine with much other work; a page that is broken complains at once
const kChromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"];
const kArguments = [
  "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic", "--no-first-run",
];

export function skip(what) {
  console.log(`SKIPPED: needs ${what}`);
  process.exit(process.env.CI === "true" ? 1 : kSkipped);
}

async function playwright() {
  const web = fileURLToPath(new URL("../../web/", import.meta.url));
  try {
    return createRequire(web)("playwright-core");
  } catch {
    return skip("playwright-core from npm (scripts/setup)");
  }
}

/** Chromium, or the end of the test. */
export async function openBrowser() {
  const executablePath = kChromium.find(existsSync);
  if (!executablePath) skip("the Debian package chromium");
  const { chromium } = await playwright();
  return chromium.launch({ executablePath, args: kArguments, timeout: kPatience });
}

/** The page of `file`, ready; `page.complaints` and `page.requests` tell what it said and asked for. */
export async function openPage(browser, file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1300, height: 900 }, ...options });
  page.setDefaultTimeout(kPatience);
  page.complaints = [];
  page.requests = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && page.complaints.push(message.text()));
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  page.on("dialog", (dialog) => page.complaints.push(`dialog ${dialog.message()}`) && dialog.dismiss());
  page.on("request", (request) => page.requests.push(request.url()));
  await page.goto(pathToFileURL(file).href);
  if (options.javaScriptEnabled === false) return page;
  if (!(await page.$("script#report"))) skip("the page's script: its libraries come from npm (scripts/setup, then build)");
  await page.waitForFunction(() => document.documentElement.dataset.ready === "yes");
  return page;
}

/** Waits until the 3D view holds all points of the map. */
export async function mapDrawn(page) {
  const frame = () => new Promise((resume) => requestAnimationFrame(() => requestAnimationFrame(resume)));
  await page.evaluate(frame); // what was changed last is asked for
  await page.waitForFunction(() => {
    const [stage, count] = ["#map .stage", "#map .count"].map((place) => document.querySelector(place));
    return Number(stage.dataset.drawn) >= Number(count.dataset.points);
  });
}

/** Colours of the 3D view and how many of its pixels have each. */
export async function canvasColors(page) {
  await mapDrawn(page);
  const picture = (await page.locator("#map canvas").screenshot({ timeout: kPatience })).toString("base64");
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const brush = canvas.getContext("2d");
    brush.drawImage(image, 0, 0);
    const { data } = brush.getImageData(0, 0, image.width, image.height);
    const counts = {};
    for (let i = 0; i < data.length; i += 4) {
      const color = `${data[i] >> 4},${data[i + 1] >> 4},${data[i + 2] >> 4}`;
      counts[color] = (counts[color] ?? 0) + 1;
    }
    return counts;
  }, picture);
}

/** Makes the plot `id` live and returns it: its data, and the figure's width. */
export async function livePlot(page, id) {
  const figure = page.locator(`figure[data-plot="${id}"]`);
  await figure.scrollIntoViewIfNeeded();
  await page.waitForSelector(`figure[data-plot="${id}"][data-live]`);
  return figure.evaluate((f) => ({
    data: f.live.chart?.data.map((column) => Array.from(column)),
    width: f.querySelector("canvas, svg").getBoundingClientRect().width,
    place: f.querySelector(".drawing").clientWidth,
  }));
}
