// The slider and the button that play the run.
import { element } from "../words.js";

const kPlayTime = 25; // [s] that a run takes to play

export class Player {
  constructor(timeline) {
    this.timeline = timeline;
    this.slider = element("input", { type: "range", min: 0, max: timeline.duration, step: "any", title: "moment of the run" });
    this.slider.value = timeline.time;
    this.button = element("button", { text: "▶", type: "button", title: "play", className: "play" });
    this.button.setAttribute("aria-label", "play");
    this.playing = false;
    this.slider.addEventListener("input", () => timeline.set(Number(this.slider.value)));
    this.button.addEventListener("click", () => (this.playing ? this.stop() : this.play()));
    timeline.onTime((time) => (this.slider.value = time));
    this.elements = [this.button, this.slider];
  }

  play() {
    this.playing = true;
    this.button.textContent = "❚❚";
    if (this.timeline.time >= this.timeline.duration) this.timeline.set(0);
    this.last = performance.now();
    requestAnimationFrame((now) => this.advance(now));
  }

  stop() {
    this.playing = false;
    this.button.textContent = "▶";
  }

  advance(now) {
    if (!this.playing) return;
    const passed = Math.min(Math.max(now - this.last, 0), 250) / 1000;
    this.last = now;
    this.timeline.set(this.timeline.time + (passed * this.timeline.duration) / kPlayTime);
    if (this.timeline.time >= this.timeline.duration) this.stop();
    else requestAnimationFrame((next) => this.advance(next));
  }
}
