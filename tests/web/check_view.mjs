// A run that is watched while it goes on, by Foxglove's own client and in a real browser: check_view.mjs TILTH [PICTURE.png]
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { openBrowser, skip } from "./browser.mjs";

const kTopics = ["/diagnostics", "/map", "/odometry", "/path", "/scan", "/tf"];
const [tilth, picture] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "tilth-view-"));

function foxglove() {
  try {
    const require = createRequire(fileURLToPath(new URL("../../web/", import.meta.url)));
    return { ...require("@foxglove/ws-protocol"), WebSocket: require("ws") };
  } catch {
    return skip("@foxglove/ws-protocol and ws from npm (scripts/setup)");
  }
}

/** A run of `seconds`, and where it can be watched. */
async function watchedRun(name, seconds) {
  const run = spawn(tilth, ["run", `sim://plaza?seed=5&duration=${seconds}`, "--out", join(folder, name), "--view", "0"]);
  const ended = new Promise((resume) => run.on("exit", resume));
  let said = "";
  const address = await new Promise((resume, refuse) => {
    run.stdout.on("data", (text) => {
      said += text;
      const found = said.match(/watch it at (http:\/\/127\.0\.0\.1:\d+\/), in Foxglove at (ws:\S+)/);
      if (found) resume({ page: found[1], socket: found[2] });
    });
    ended.then((code) => refuse(new Error(`ended with ${code}: ${said}`)));
  });
  return { ...address, ended, interrupt: () => run.kill("SIGINT") };
}

/** What Foxglove's client gets of a run: how many messages of each topic, and the names of their types. */
async function followed(run, protocol, { FoxgloveClient, WebSocket }) {
  const client = new FoxgloveClient({ ws: new WebSocket(run.socket, [protocol]) });
  const [topics, counts, types] = [new Map(), {}, {}];
  client.on("error", (error) => assert.fail(error));
  client.on("advertise", (channels) => {
    for (const { id, topic, schemaName, encoding, schemaEncoding, schema } of channels) {
      assert.equal(`${encoding} ${schemaEncoding}`, "cdr ros2msg");
      assert.ok(schema.includes("stamp"), topic);
      types[topic] = schemaName;
      topics.set(client.subscribe(id), topic);
    }
  });
  client.on("message", ({ subscriptionId, timestamp, data }) => {
    assert.ok(timestamp > 0n && data.byteLength > 4);
    const topic = topics.get(subscriptionId);
    counts[topic] = (counts[topic] ?? 0) + 1;
  });
  await new Promise((resume) => client.on("close", resume));
  return { counts, types };
}

async function foxgloveFollows(client) {
  for (const protocol of [client.FoxgloveClient.SUPPORTED_SUBPROTOCOL, "foxglove.sdk.v1"]) {
    const run = await watchedRun(protocol, 6);
    const { counts, types } = await followed(run, protocol, client);
    assert.equal(await run.ended, 0);
    assert.deepEqual(Object.keys(counts).sort(), kTopics);
    assert.equal(types["/scan"], "sensor_msgs/msg/PointCloud2");
    const poses = readFileSync(join(folder, protocol, "trajectory.tum"), "utf8").trim().split("\n").length;
    assert.ok(poses > 50);
    for (const topic of ["/odometry", "/tf", "/diagnostics"]) assert.ok(counts[topic] > poses - 30 && counts[topic] <= poses, `${topic}: ${counts[topic]} of ${poses}`);
  }
}

/** Share of the picture that is not of its commonest colour. */
async function drawnShare(page) {
  const png = (await page.locator("#stage canvas").screenshot()).toString("base64");
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const brush = new OffscreenCanvas(image.width, image.height).getContext("2d");
    brush.drawImage(image, 0, 0);
    const pixels = new Uint32Array(brush.getImageData(0, 0, image.width, image.height).data.buffer);
    const counts = new Map();
    for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
    return 1 - Math.max(...counts.values()) / pixels.length;
  }, png);
}

async function thePageShowsIt(browser) {
  const run = await watchedRun("page", 600); // far longer than a browser needs to open it
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  page.setDefaultTimeout(120_000);
  const [complaints, requests] = [[], []];
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(run.page);
  const grown = (points, scans) => page.waitForFunction(([p, s]) => Number(document.body.dataset.points) > p && Number(document.body.dataset.scans) > s, [points, scans]);
  await grown(1000, 10);
  const before = await page.evaluate(() => Number(document.body.dataset.points));
  assert.equal(await page.locator(".track").textContent(), "tracking");
  assert.match(await page.locator("h1").textContent(), /^Tilth: sim:\/\/plaza/);
  await grown(before, 60);
  if (picture) await page.screenshot({ path: picture });
  assert.ok((await drawnShare(page)) > 0.03, "the map is drawn");
  const values = await page.locator("aside dd").allTextContents();
  assert.ok(values.every((value) => value !== "–"), values.join(" | "));
  const whileItRan = complaints.filter((text) => !text.includes("ERR_CONNECTION_REFUSED")); // the page asks for the next run
  assert.deepEqual(whileItRan, []);
  assert.deepEqual([...new Set(requests)].filter((url) => !url.startsWith("data:")), [run.page], "nothing is fetched but the page");
  run.interrupt();
  assert.ok([0, 128 + 2].includes(await run.ended), "over by itself, or interrupted");
  await page.waitForFunction(() => document.querySelector(".link-state").textContent.includes("ended"));
  await page.close();
}

const client = foxglove();
const browser = await openBrowser();
try {
  await foxgloveFollows(client);
  await thePageShowsIt(browser);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
console.log("Foxglove's client and the page follow a run");
