// Ways from above, boxes, bars and histograms, by Observable Plot: values under the mouse.
import * as Plot from "@observablehq/plot";
import { lastNotAbove } from "../data.js";
import { color, curveColor } from "../theme.js";
import { axisText, element, quantityText } from "../words.js";
import { heat } from "./heat.js";
import { common, nameAxis, nameMargin, tipLook } from "./look.js";

const kWayHeights = [300, 560]; // [px] least and most
const kShades = ["#2560a8", "#34a8a0", "#f0b43c", "#cd322d"]; // as tilth/plot/svg_content.cpp
const kMostHovered = 4000; // points of a way that the mouse finds

function rowsOf(curve) {
  const step = Math.max(1, Math.ceil(curve.y.length / kMostHovered));
  const rows = [];
  for (let i = 0; i < curve.y.length; i += step) {
    rows.push({ x: curve.x[i], y: curve.y[i], shade: curve.shade?.[i], name: curve.name });
  }
  return rows;
}

function wayTitle(plot, row) {
  const at = `x ${quantityText(row.x, plot.x)}\ny ${quantityText(row.y, plot.y)}`;
  return row.shade === undefined ? `${row.name}\n${at}` : `${plot.shade.label} ${quantityText(row.shade, plot.shade)}\n${at}`;
}

/** Height that gives a metre the same length on both axes, within bounds; the ranges that go with it. */
function wayFrame(plot, width) {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const curve of plot.curves) {
    for (let i = 0; i < curve.y.length; ++i) {
      [x0, x1] = [Math.min(x0, curve.x[i]), Math.max(x1, curve.x[i])];
      [y0, y1] = [Math.min(y0, curve.y[i]), Math.max(y1, curve.y[i])];
    }
  }
  const wide = width - 62 - 20;
  const span = Math.max(x1 - x0, y1 - y0, 1) * 0.04;
  [x0, x1, y0, y1] = [x0 - span, x1 + span, y0 - span, y1 + span];
  const high = Math.min(Math.max((wide * (y1 - y0)) / (x1 - x0), kWayHeights[0]), kWayHeights[1]);
  const scale = Math.min(wide / (x1 - x0), high / (y1 - y0));
  const [mx, my] = [(x0 + x1) / 2, (y0 + y1) / 2];
  return { height: high + 60, x: [mx - wide / 2 / scale, mx + wide / 2 / scale], y: [my - high / 2 / scale, my + high / 2 / scale] };
}

/** Loop closures as lines, keyframes as dots. */
function landmarksOf(plot) {
  const marks = [];
  if (plot.links) {
    const ends = rowsOfPlaces(plot.links);
    const pairs = ends.filter((_, i) => i % 2 === 0).map((from, i) => ({ from, to: ends[2 * i + 1] }));
    marks.push(Plot.link(pairs, { x1: (p) => p.from.x, y1: (p) => p.from.y, x2: (p) => p.to.x, y2: (p) => p.to.y, stroke: color("closure"), strokeWidth: 1.4, className: "links" }));
  }
  if (plot.dots) marks.push(Plot.dot(rowsOfPlaces(plot.dots), { x: "x", y: "y", r: 2, fill: color("keyframe"), className: "dots" }));
  return marks;
}

function rowsOfPlaces(places) {
  return Array.from(places.x, (x, i) => ({ x, y: places.y[i] }));
}

function way(plot, width) {
  const frame = wayFrame(plot, width);
  const shaded = plot.curves.find((c) => c.shade);
  const rows = plot.curves.map(rowsOf);
  const options = common(plot, width);
  const lines = rows.map((r, i) =>
    shaded
      ? Plot.line(r, { x: "x", y: "y", z: null, stroke: "shade", strokeWidth: 4, strokeLinecap: "round" })
      : Plot.line(r, { x: "x", y: "y", stroke: curveColor(plot.curves, i), strokeWidth: plot.curves[i].truth ? 5 : 1.8 }),
  );
  lines.reverse(); // the truth, given last, lies below
  const landmarks = landmarksOf(plot);
  return Plot.plot({
    ...options,
    height: frame.height,
    marginTop: 20,
    marginRight: 20,
    x: { ...options.x, domain: frame.x, grid: true },
    y: { ...options.y, domain: frame.y },
    color: shaded ? { range: kShades, interpolate: "rgb", legend: false, type: "linear" } : undefined,
    marks: [
      ...lines,
      ...landmarks,
      Plot.dot(rows[0].slice(0, 1), { x: "x", y: "y", r: 4, fill: color("ink") }),
      Plot.tip(rows.flat(), Plot.pointer({ x: "x", y: "y", title: (r) => wayTitle(plot, r), ...tipLook() })),
    ],
  });
}

function boxes(plot, width) {
  const rows = plot.curves.map((c, i) => ({ ...c.box, name: c.name, color: curveColor(plot.curves, i) }));
  const title = (r) => `${r.name}\nmedian ${quantityText(r.median, plot.y)}\nmean ${quantityText(r.mean, plot.y)}\nquartiles ${quantityText(r.q1, plot.y)}, ${quantityText(r.q3, plot.y)}\n1 % and 99 % ${quantityText(r.p01, plot.y)}, ${quantityText(r.p99, plot.y)}`;
  const options = common(plot, width);
  return Plot.plot({
    ...options,
    marginBottom: nameMargin(rows.map((r) => r.name), width),
    x: { domain: rows.map((r) => r.name), label: null, padding: 0.4, ...nameAxis(rows.map((r) => r.name), width) },
    marks: [
      Plot.ruleX(rows, { x: "name", y1: "p01", y2: "p99", stroke: color("faint") }),
      Plot.barY(rows, { x: "name", y1: "q1", y2: "q3", fill: "color", fillOpacity: 0.45, stroke: "color" }),
      Plot.tickY(rows, { x: "name", y: "median", stroke: color("ink"), strokeWidth: 2 }),
      Plot.dot(rows, { x: "name", y: "mean", r: 3, fill: color("card"), stroke: color("ink") }),
      Plot.tip(rows, Plot.pointerX({ x: "name", y: "q3", title, ...tipLook() })),
    ],
  });
}

function bars(plot, width) {
  const rows = plot.curves.flatMap((c, i) => Array.from(c.y, (y, k) => ({ name: c.name, category: plot.categories[k], y, color: curveColor(plot.curves, i) })));
  const options = common(plot, width);
  return Plot.plot({
    ...options,
    marginTop: 30,
    marginBottom: nameMargin(plot.categories, width),
    fx: { domain: plot.categories, label: null, padding: 0.15, axis: "bottom", ...nameAxis(plot.categories, width) },
    x: { domain: plot.curves.map((c) => c.name), axis: null, padding: 0.05 },
    marks: [
      Plot.barY(rows, { fx: "category", x: "name", y: "y", fill: "color", fillOpacity: 0.85 }),
      Plot.ruleY([0], { stroke: color("faint") }),
      Plot.tip(rows, Plot.pointerX({ fx: "category", x: "name", y: "y", title: (r) => `${r.category}\n${r.name} ${quantityText(r.y, plot.y)}`, ...tipLook() })),
    ],
  });
}

function histogram(plot, width) {
  const curve = plot.curves[0];
  const rows = Array.from(curve.y, (y, i) => ({ x1: curve.x[i], x2: curve.x[i + 1], y }));
  const title = (r) => `${r.y} ${plot.y.label}\n${quantityText(r.x1, plot.x)} to ${quantityText(r.x2, plot.x)}`;
  return Plot.plot({
    ...common(plot, width),
    marks: [
      Plot.rectY(rows, { x1: "x1", x2: "x2", y: "y", fill: curveColor(plot.curves, 0), fillOpacity: 0.8, inset: 0.5 }),
      Plot.ruleY([0], { stroke: color("faint") }),
      Plot.tip(rows, Plot.pointerX({ x: (r) => (r.x1 + r.x2) / 2, y: "y", title, ...tipLook() })),
    ],
  });
}

/** A dot that follows the moment shown by the map along the way. */
function follow(chart, report, timeline) {
  const way = report.map?.paths[0];
  if (!way?.t.length) return () => {};
  const dot = document.createElementNS("http://www.w3.org/2000/svg", "circle");
  dot.setAttribute("r", 6);
  dot.setAttribute("class", "robot");
  chart.append(dot);
  const [x, y] = [chart.scale("x"), chart.scale("y")];
  const move = () => {
    const i = lastNotAbove(way.t, timeline.time);
    dot.setAttribute("cx", x.apply(way.x[i]));
    dot.setAttribute("cy", y.apply(way.y[i]));
    dot.style.display = timeline.time < timeline.duration ? "" : "none";
  };
  move();
  timeline.addEventListener("time", move);
  return () => timeline.removeEventListener("time", move);
}

/** Names and colours of the curves, or the strip of colours of a shaded way. */
function legend(plot, chart) {
  if (plot.shade) return Plot.legend({ color: chart.scale("color"), label: axisText(plot.shade), width: 240, style: { background: "none" } });
  const named = plot.kind !== "boxes" && plot.kind !== "heat" && plot.curves.length > 1 ? plot.curves : [];
  const entries = named.map((c, i) => [c.name, curveColor(plot.curves, i)]);
  if (plot.dots?.x.length) entries.push([plot.dots.name, color("keyframe")]);
  if (plot.links?.x.length) entries.push([plot.links.name, color("closure")]);
  return element("div", { className: "names" }, ...entries.map(([name, background]) => {
    const swatch = element("i");
    swatch.style.background = background;
    return element("span", {}, swatch, name);
  }));
}

export function drawnPlot(plot, { timeline, report, width }) {
  const chart = { path: way, boxes, bars, histogram, heat }[plot.kind](plot, width);
  const leave = plot.kind === "path" ? follow(chart, report, timeline) : () => {};
  return { element: element("div", { className: "drawn" }, legend(plot, chart), chart), remove: leave };
}
