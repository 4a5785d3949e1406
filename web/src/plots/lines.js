// Curves over time or another axis, by uPlot: values under the mouse, a stretch zoomed by dragging, all plots over time
// moving together; a click moves the robot of the map there.
import uPlot from "uplot";
import { color, curveColor } from "../theme.js";
import { axisText, element, numberText, quantityText } from "../words.js";

const kHeight = 236; // [px] without the legend
const kMarkDashes = [[], [6, 4], [2, 3], [8, 3, 2, 3]];
const kMarkColors = ["s1", "s2", "ink", "s3"];

/** Curves with the x of their own, put on one common x. */
function joined(curves) {
  const tables = curves.map((c) => [Array.from(c.x), Array.from(c.y)]);
  const first = curves[0]?.x;
  if (curves.every((c) => c.x === first)) return [tables[0]?.[0] ?? [], ...tables.map((t) => t[1])];
  return uPlot.join(tables);
}

function constants(value, length) {
  return new Array(length).fill(value);
}

/** Data and series of the marks and the band: constants that the legend can switch off. */
function addLevels(plot, data, series, bands) {
  const length = data[0].length;
  plot.marks.forEach((mark, i) => {
    data.push(constants(mark.value, length));
    const stroke = color(kMarkColors[i % 4]);
    series.push({ label: mark.name, stroke, width: 1.3, dash: kMarkDashes[i % 4], value: () => "", points: { show: false } });
  });
  if (!plot.band) return;
  for (const [edge, style] of [[plot.band.high, "band"], [plot.band.low, "edge"]]) {
    data.push(constants(edge, length));
    series.push({ label: plot.band.name, stroke: color("band"), width: 0, value: () => "", points: { show: false }, class: style });
  }
  bands.push({ series: [series.length - 2, series.length - 1], fill: color("band") });
}

function curveSeries(plot) {
  return plot.curves.map((curve) => ({
    label: curve.name,
    stroke: curve.stroke,
    width: curve.truth ? 3.5 : 1.4,
    spanGaps: true,
    points: { show: false },
    value: (_, v) => (v === null || v === undefined ? "–" : quantityText(v, plot.y)),
  }));
}

function axes(plot) {
  const look = { stroke: color("faint"), grid: { stroke: color("grid"), width: 1 }, ticks: { stroke: color("grid"), width: 1 }, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", labelSize: 22 };
  const values = (_, splits) => splits.map((v) => (v === null ? "" : numberText(v)));
  return [
    { ...look, label: axisText(plot.x), size: 34, values },
    { ...look, label: axisText(plot.y), size: 58, values },
  ];
}

/** A vertical line at the moment that the map shows. */
function nowLine(chart, timeline) {
  if (timeline.time >= timeline.duration) return;
  const x = chart.valToPos(timeline.time, "x", true);
  const { left, top, width, height } = chart.bbox;
  if (x < left || x > left + width) return;
  chart.ctx.save();
  chart.ctx.strokeStyle = color("accent");
  chart.ctx.lineWidth = 1.5 * devicePixelRatio;
  chart.ctx.beginPath();
  chart.ctx.moveTo(x, top);
  chart.ctx.lineTo(x, top + height);
  chart.ctx.stroke();
  chart.ctx.restore();
}

/** Strips in which the curves are not to be believed, as wide as a pixel at least. */
function alarmStrips(chart, alarm) {
  const { left, top, width, height } = chart.bbox;
  const at = (x) => Math.min(Math.max(chart.valToPos(x, "x", true), left), left + width);
  chart.ctx.save();
  chart.ctx.fillStyle = color("lost");
  for (const [from, to] of alarm.spans) {
    const [a, b] = [at(from), at(to)];
    if (b > left && a < left + width) chart.ctx.fillRect(a - 0.5, top, b - a + 1, height);
  }
  chart.ctx.restore();
}

/** The curves in the order of drawing, each in the colour of its place: the truth lies below what is held against it. */
function inDrawingOrder(plot) {
  const rank = (curve) => (curve.truth ? 0 : curve.behind ? 1 : 2);
  const curves = plot.curves.map((c, i) => ({ name: c.name, x: c.x, y: c.y, truth: c.truth, behind: c.behind, stroke: curveColor(plot.curves, i) }));
  return { ...plot, curves: curves.sort((a, b) => rank(a) - rank(b)) };
}

export function linePlot(given, { timeline, width }) {
  const plot = inDrawingOrder(given);
  const data = joined(plot.curves);
  const series = [{ label: plot.x.label, value: (_, v) => (v === null ? "–" : quantityText(v, plot.x)) }, ...curveSeries(plot)];
  const bands = [];
  addLevels(plot, data, series, bands);
  const place = element("div", { className: "lines" });
  const options = {
    width,
    height: kHeight,
    scales: { x: { time: false }, y: { range: yRange } },
    series,
    bands,
    axes: axes(plot),
    cursor: { sync: plot.over_time ? { key: "time", setSeries: false } : undefined, points: { size: 6 }, drag: { x: true, y: false } },
    hooks: { drawAxes: plot.alarm ? [(chart) => alarmStrips(chart, plot.alarm)] : [], draw: plot.over_time ? [(chart) => nowLine(chart, timeline)] : [] },
  };
  const chart = new uPlot(options, data, place);
  const redraw = () => chart.redraw(false, false);
  if (plot.over_time) {
    timeline.addEventListener("time", redraw);
    chart.over.addEventListener("click", () => timeline.set(chart.posToVal(chart.cursor.left, "x")));
  }
  return {
    element: place,
    chart,
    resize: (w) => chart.setSize({ width: w, height: kHeight }),
    remove: () => {
      timeline.removeEventListener("time", redraw);
      chart.destroy();
    },
  };
}

/** From zero where all is above it, with a little room; a single value gets a range of its own. */
function yRange(_, low, high) {
  if (low === null || high === null) return [0, 1];
  if (low === high) return low === 0 ? [0, 1] : [low - 0.5 * Math.abs(low), high + 0.5 * Math.abs(high)];
  const more = 0.06 * (high - low);
  return [low >= 0 ? Math.max(0, low - more) : low - more, high + more];
}
