// The moment of the run that the page shows: set by the slider, by playing, or by a click on a curve.

export class Timeline extends EventTarget {
  constructor(duration) {
    super();
    this.duration = duration; // [s]
    this.time = duration; // [s] since the first pose
  }

  set(time) {
    const bounded = Math.min(Math.max(time, 0), this.duration);
    if (bounded === this.time) return;
    this.time = bounded;
    this.dispatchEvent(new Event("time"));
  }

  onTime(listener) {
    this.addEventListener("time", () => listener(this.time));
  }
}
