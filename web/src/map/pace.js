// When the view is drawn, and how many of the map's points: while it moves only as many as the machine draws smoothly,
// all of them when it rests.

const kFirst = 600_000; // points while moving, to begin with
const kLeast = 50_000;
const kSlow = 45; // [ms] between two frames: fewer points
const kFast = 22; // more
const kRest = 220; // [ms] without a change until all points are drawn

export class Pace {
  constructor(points, render) {
    this.points = points;
    this.render = render;
    this.budget = Math.min(kFirst, points.count);
    this.queued = false;
    this.last = 0;
  }

  /** Something moves: draw soon, thinned where that is needed. */
  moving() {
    this.request(this.budget);
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.still(), kRest);
  }

  /** Nothing moves: draw everything once. */
  still() {
    this.request(this.points.count);
  }

  request(count) {
    this.wanted = count;
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.queued = false;
    const between = now - this.last;
    if (between < 1000 && this.wanted < this.points.count) {
      if (between > kSlow) this.budget = Math.max(kLeast, Math.floor(0.7 * this.budget));
      if (between < kFast) this.budget = Math.min(this.points.count, Math.ceil(1.1 * this.budget));
    }
    this.last = now;
    this.points.draw(this.wanted);
    this.render();
  }
}
