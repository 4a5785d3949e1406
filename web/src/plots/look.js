// What the plots of Observable Plot have in common.
import { color } from "../theme.js";
import { axisText } from "../words.js";

const kHeight = 270; // [px] of all but ways

export const tipLook = () => ({ fill: color("card"), stroke: color("grid") });

export function common(plot, width) {
  return {
    width,
    height: kHeight,
    marginLeft: 62,
    marginBottom: 40,
    style: { background: "none", color: color("faint"), fontSize: "12px", fontFamily: "inherit", overflow: "visible" },
    x: { label: axisText(plot.x), labelAnchor: "center", labelArrow: "none" },
    y: { label: axisText(plot.y), labelAnchor: "center", labelArrow: "none", grid: true },
  };
}

/** Options of an axis of names: turned where they would meet. */
export function nameAxis(names, width) {
  const crowded = names.some((name) => (name.length + 1) * 6.6 > (width - 80) / names.length);
  return crowded ? { tickRotate: -28 } : {};
}

/** [px] below the frame that such an axis takes. */
export function nameMargin(names, width) {
  const { tickRotate } = nameAxis(names, width);
  return tickRotate ? 24 + Math.min(90, 3.4 * Math.max(...names.map((name) => name.length))) : 40;
}
