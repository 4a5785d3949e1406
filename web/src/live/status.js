// What is known beside the picture: whether anything comes, the state of the track, and how long a scan takes.
import { element, numberText } from "../words.js";

const kRecent = 100; // scans that the curve shows
const kLongest = 60; // [s] behind its sensor that a run is; else its stamps are of another day
const kWidth = 220, kHeight = 44; // of the curve

function fact(name) {
  const value = element("dd", { text: "–" });
  return { value, elements: [element("dt", { text: name }), value] };
}

/** Of a value that a run in a saved map does not have. */
function millisecondsText(value) {
  return value === undefined ? "–" : `${numberText(Number(value))} ms`;
}

export class Status {
  constructor(place) {
    this.name = element("h1", { text: "Tilth" });
    this.link = element("p", { className: "link-state", text: "connecting …" });
    this.track = element("p", { className: "track", text: "no scan yet" });
    this.facts = Object.fromEntries(["scans", "distance", "behind", "a scan takes", "waited for it", "into the map", "matched", "scans come"].map((n) => [n, fact(n)]));
    this.curve = element("canvas", { width: kWidth * 2, height: kHeight * 2, title: "milliseconds that each scan took" });
    this.notes = element("ul", { className: "notes" });
    place.append(this.name, this.link, this.track, element("dl", {}, ...Object.values(this.facts).flatMap((f) => f.elements)),
      element("div", { className: "curve-box" }, this.curve, this.curveText = element("span", { text: "" })), this.notes);
    this.clear();
  }

  clear() {
    Object.assign(this, { scans: 0, distance: 0, last: undefined, times: [], arrivals: [] });
    this.notes.replaceChildren();
  }

  connected(name) {
    this.name.textContent = name;
    this.link.textContent = "connected";
    this.link.dataset.state = "open";
  }

  lost() {
    this.link.textContent = this.scans ? "the run has ended, or the connection is lost" : "waiting for a run";
    this.link.dataset.state = "lost";
  }

  note(text) {
    this.notes.prepend(element("li", { text }));
    while (this.notes.children.length > 5) this.notes.lastChild.remove();
  }

  say(name, text) {
    this.facts[name].value.textContent = text;
  }

  takePose({ position }) {
    if (this.last) this.distance += Math.hypot(...position.map((v, i) => v - this.last[i]));
    this.last = position;
    this.say("distance", `${this.distance.toFixed(1)} m`);
  }

  takeDiagnostics({ stamp, level, message, values }) {
    ++this.scans;
    this.track.textContent = message;
    this.track.dataset.level = level;
    this.say("scans", String(this.scans));
    const behind = 1e-3 * Date.now() - stamp;
    this.say("behind", Math.abs(behind) < kLongest ? `${behind.toFixed(2)} s` : "recorded");
    const ms = Number(values.register_ms);
    this.times = [...this.times.slice(1 - kRecent), ms];
    this.arrivals = [...this.arrivals.slice(1 - kRecent), performance.now()];
    this.say("a scan takes", `${numberText(ms)} ms`);
    this.say("waited for it", millisecondsText(values.read_ms));
    this.say("into the map", millisecondsText(values.build_map_ms));
    const inSavedMap = "overlap" in values;
    this.say("matched", inSavedMap ? `${(100 * Number(values.overlap)).toFixed(0)} % on the map` : `${values.matches} of ${values.candidates}`);
    const seconds = 1e-3 * (this.arrivals.at(-1) - this.arrivals[0]);
    if (seconds > 0) this.say("scans come", `${numberText((this.arrivals.length - 1) / seconds)} a second`);
    this.draw();
  }

  draw() {
    const most = Math.max(...this.times, 1);
    const brush = this.curve.getContext("2d");
    const style = getComputedStyle(this.curve);
    brush.clearRect(0, 0, this.curve.width, this.curve.height);
    brush.strokeStyle = style.color;
    brush.lineWidth = 3;
    brush.beginPath();
    this.times.forEach((ms, i) => brush.lineTo((i / (kRecent - 1)) * this.curve.width, this.curve.height * (1 - 0.92 * (ms / most)) - 2));
    brush.stroke();
    this.curveText.textContent = `up to ${numberText(most)} ms in the last ${this.times.length} scans`;
  }
}
