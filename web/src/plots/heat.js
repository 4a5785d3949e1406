// Cells coloured by a figure over two parameters, each with its number.
import * as Plot from "@observablehq/plot";
import { color } from "../theme.js";
import { numberText } from "../words.js";
import { common } from "./look.js";

const kHeat = ["rgb(255,247,200)", "rgb(233,140,120)", "rgb(165,32,40)"]; // about as tilth/plot/svg_heat.cpp

export function heat(plot, width) {
  const cells = plot.curves.flatMap((c) => Array.from(c.y, (value, k) => ({ x: plot.categories[k], y: c.name, value })));
  const known = cells.map((c) => c.value).filter(Number.isFinite);
  const dark = Math.min(...known) + 0.6 * (Math.max(...known) - Math.min(...known));
  const options = common(plot, width);
  return Plot.plot({
    ...options,
    x: { ...options.x, domain: plot.categories, padding: 0.02 },
    y: { ...options.y, domain: plot.curves.map((c) => c.name).reverse(), padding: 0.02, grid: false },
    color: { range: kHeat, interpolate: "rgb", type: "linear", unknown: color("grid") },
    marks: [
      Plot.cell(cells, { x: "x", y: "y", fill: "value" }),
      Plot.text(cells, { x: "x", y: "y", text: (c) => numberText(c.value), fill: (c) => (c.value > dark ? "#fff" : "#222"), className: "values" }),
    ],
  });
}
