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
