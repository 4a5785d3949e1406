// What stands round the 3D view: choices above it, the slider and the player below, the scale of the colours.
import { element, numberText, quantityText } from "../words.js";
import { Player } from "./player.js";
import { gradient, modes } from "./ramps.js";

const kHint = "drag: turn · right drag: move · wheel: zoom";

function modeChoice(view) {
  const choice = element("select", { title: "What the colours mean" });
  for (const mode of modes) choice.append(element("option", { text: `colour: ${mode}`, value: mode }));
  choice.addEventListener("change", () => view.colorBy(choice.value));
  return choice;
}

/** Shows a part of the view or hides it; `swatch` names the colour that it has. */
function toggle(view, part, name, swatch, checked = true) {
  const box = element("input", { type: "checkbox", checked });
  box.addEventListener("change", () => view.toggle(part, box.checked));
  return element("label", {}, box, ...(swatch ? [element("i", { className: `swatch ${swatch}` })] : []), name);
}

/** Hides what lies above a height; all of it is there at the right end. */
function cut(view) {
  const slider = element("input", { type: "range", min: 0, max: 1, step: "any", value: 1, title: "hide what lies above" });
  slider.addEventListener("input", () => {
    const [low, high] = view.points.heights;
    const share = Number(slider.value);
    view.cutAbove(share === 1 ? Infinity : low + share * (high - low));
  });
  return element("label", { className: "cut" }, "height", slider);
}

function button(text, act) {
  const made = element("button", { text, type: "button" });
  made.addEventListener("click", act);
  return made;
}

export class Panel {
  constructor(place, map, view) {
    this.map = map;
    this.canvas = view.renderer.domElement;
    this.legend = element("div", { className: "ramp" });
    this.stage = element("div", { className: "stage" }, this.canvas, this.legend, element("div", { className: "hint", text: kHint }));
    this.readout = element("output", { className: "readout" });
    const player = new Player(view.timeline);
    place.replaceChildren(
      element("div", { className: "bar" }, ...this.choices(view)),
      this.stage,
      element("div", { className: "bar" }, ...player.elements, this.readout),
    );
  }

  choices(view) {
    const { paths, keyframes, closures } = this.map;
    const toggles = [toggle(view, "cloud", "map"), toggle(view, "ways", "trajectory", "way")];
    if (this.map.moving) toggles.push(toggle(view, "moved", "what moved", "moved", false));
    const before = paths.slice(1).find((path) => !path.truth);
    if (before) toggles.push(toggle(view, "earlier", before.name, "earlier"));
    if (paths.some((path) => path.truth)) toggles.push(toggle(view, "truths", "truth", "truth"));
    if (keyframes.length) toggles.push(toggle(view, "keyframes", "keyframes", "keyframe"));
    if (closures.length) toggles.push(toggle(view, "closures", "loop closures", "closure"));
    toggles.push(toggle(view, "grid", "grid"), cut(view));
    const shown = element("span", { className: "count", text: this.countText() });
    shown.dataset.points = this.map.count;
    return [modeChoice(view), ...toggles, button("oblique", () => view.look("oblique")), button("from above", () => view.look("top")), shown];
  }

  countText() {
    const { count, total } = this.map;
    const all = `${total.toLocaleString("en")} points`;
    return count < total ? `${count.toLocaleString("en")} of ${all}` : all;
  }

  /** The scale of the colours. */
  explain(mode, heights) {
    const last = this.map.paths[0].t.at(-1) ?? 0;
    const ends = {
      height: [`${numberText(heights[0])} m`, `${numberText(heights[1])} m`],
      intensity: ["0", quantityText(this.map.max_intensity, { unit: "" })],
      time: ["0 s", `${numberText(last)} s`],
      scan: ["one colour", "a scan"],
    }[mode];
    const strip = element("i");
    strip.style.background = gradient(mode);
    this.legend.replaceChildren(element("b", { text: mode }), element("span", { text: ends[0] }), strip, element("span", { text: ends[1] }));
  }

  /** Says where the robot is at `time`: pose number `i`. */
  say(time, i) {
    const { x, y, z } = this.map.paths[0];
    const at = [x, y, z].map((axis) => axis[i].toFixed(2).replace("-", "−"));
    this.readout.textContent = `${time.toFixed(1)} s   x ${at[0]}   y ${at[1]}   z ${at[2]} m`;
  }
}
