// When the view is drawn, and how many of the map's points at a time: as many as the machine draws smoothly. While the view
// moves that is the whole picture; when it rests the other points are added to it, frame by frame, so that not even a
// slow machine is held up by all of them at once.

const kFirst = 150_000; // points at a time, to begin with
const kLeast = 50_000;
const kSlow = 45; // [ms] between two frames: fewer points
const kFast = 22; // more
const kLessen = 0.7;
const kMore = 1.3;
const kPause = 1000; // [ms] between two frames that have nothing to do with each other
const kRest = 220; // [ms] without a change until the other points are added

export class Pace {
  /** `render(anew, drawn)` draws the points chosen by points.draw() anew or into the picture that stands, which then has `drawn`. */
  constructor(points, render) {
    this.points = points;
    this.render = render;
    this.budget = kFirst;
    this.drawn = 0;
    this.anew = true;
    this.queued = false;
    this.last = -Infinity;
  }

  /** Something moves: draw soon, add to it when it rests. */
  moving() {
    this.fills = false;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.fill(), kRest);
    this.anew = true;
    this.request();
  }

  /** Something changed, and nothing moves: draw anew, and add to it at once. */
  still() {
    this.anew = true;
    this.fill();
  }

  /** There are more points than before. */
  more() {
    if (this.fills) this.request();
  }

  fill() {
    this.fills = true;
    this.request();
  }

  request() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.queued = false;
    this.adapt(now - this.last);
    this.last = now;
    const from = this.anew ? 0 : this.drawn;
    const count = Math.min(this.budget, this.points.count - from);
    if (!this.anew && count === 0) return;
    this.points.draw(from, count);
    this.drawn = from + count;
    this.render(this.anew, this.drawn);
    this.anew = false;
    if (this.fills && this.drawn < this.points.count) this.request();
  }

  adapt(between) {
    if (between > kPause) return;
    if (between > kSlow) this.budget = Math.max(kLeast, Math.floor(kLessen * this.budget));
    if (between < kFast) this.budget = Math.min(Math.max(this.points.count, kFirst), Math.ceil(kMore * this.budget));
  }
}
