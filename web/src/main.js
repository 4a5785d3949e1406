// Makes the page answer: the 3D view of the map, and the plots that stand in it as drawings.
import "uplot/dist/uPlot.min.css";
import { readReport } from "./data.js";
import { MapView } from "./map/view.js";
import { drawnPlot } from "./plots/drawn.js";
import { linePlot } from "./plots/lines.js";
import { onThemeChange } from "./theme.js";
import { Timeline } from "./timeline.js";

const kMargin = "400px"; // plots are made live this far before they come into view

function duration(report) {
  const times = report.map?.paths[0]?.t;
  return times?.length ? times[times.length - 1] : 0;
}

/** Replaces the drawing of a figure by a live plot, and again when the colours change. */
function enliven(figure, plot, report, timeline) {
  const drawing = figure.querySelector(".drawing");
  const make = plot.kind === "lines" ? linePlot : drawnPlot;
  const show = () => {
    figure.live?.remove();
    figure.live = make(plot, { timeline, report, width: drawing.clientWidth });
    drawing.replaceChildren(figure.live.element);
    figure.dataset.live = "yes";
  };
  show();
  onThemeChange(show);
  let width = drawing.clientWidth;
  new ResizeObserver(() => {
    if (drawing.clientWidth === width || drawing.clientWidth === 0) return;
    width = drawing.clientWidth;
    if (figure.live.resize) figure.live.resize(width);
    else show();
  }).observe(drawing);
}

function watchPlots(report, timeline) {
  const near = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting) continue;
        near.unobserve(entry.target);
        enliven(entry.target, report.plots[entry.target.dataset.plot], report, timeline);
      }
    },
    { rootMargin: kMargin },
  );
  for (const figure of document.querySelectorAll("figure[data-plot]")) {
    if (report.plots[figure.dataset.plot]) near.observe(figure);
  }
}

/** Resolves after the next frame. */
function painted() {
  return new Promise((resume) => requestAnimationFrame(() => setTimeout(resume)));
}

/** Resolves when all of the page has been read. */
function pageRead() {
  if (document.readyState !== "loading") return Promise.resolve();
  return new Promise((resume) => document.addEventListener("DOMContentLoaded", resume));
}

/** The rest of the map, one layer after the other; the page answers in between. */
async function addLayers(view) {
  await pageRead();
  for (const layer of document.querySelectorAll("script.layer")) {
    await painted();
    await view.add(JSON.parse(layer.textContent));
  }
}

async function main() {
  const report = readReport();
  const timeline = new Timeline(duration(report));
  watchPlots(report, timeline);
  await painted(); // the page can be read while WebGL starts
  const place = document.getElementById("map");
  const view = place && report.map && (await MapView.open(place, report.map, timeline));
  document.documentElement.dataset.opened = performance.now().toFixed(0); // [ms]
  document.documentElement.dataset.ready = "yes";
  if (view) await addLayers(view);
}

main();
