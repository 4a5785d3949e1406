#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/features/ring_segments.hpp>

namespace tilth {
namespace {

constexpr float kMostSteps = 4.0f;  // columns without a return that still are one run

// [rad] 0 .. 2 pi, to 1e-5, in a few operations (Abramowitz and Stegun 4.4.49).
float azimuth_of(const Eigen::Vector3d& p) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const float x = float(p.x()), y = float(p.y()), a = std::abs(x), b = std::abs(y);
  const float t = std::min(a, b) / std::max(std::max(a, b), 1e-20f), s = t * t;
  float angle = t * (0.9998660f + s * (-0.3302995f + s * (0.1801410f + s * (-0.0851330f + s * 0.0208351f))));
  if (b > a) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? 2 * kPi - angle : angle;
}

float square(float x) {
  return x * x;
}

/// The points of a ring that are kept, as its beam saw them, counter-clockwise from the x axis on; y is mirrored like
/// that of the layout.
struct Sightings {
  std::vector<float> x, y, z;            // [m]
  std::vector<float> ux, uy;             // of the horizontal direction
  std::vector<float> time;               // [s]
  std::vector<float> range, reach;       // [m] of a point; [m^2] that it may be from the first of its run
  std::vector<std::uint8_t> after_jump;  // whether the surface ends between a point and the one before it
  std::size_t count = 0;

  void resize(std::size_t size) {
    for (std::vector<float>* v : {&x, &y, &z, &ux, &uy, &time, &range, &reach}) v->resize(size);
    after_jump.resize(size);
  }

  /// Nearly the angle [rad] between two beams less than a right angle apart.
  float angle_between(std::size_t a, std::size_t b) const { return std::abs(ux[a] * uy[b] - uy[a] * ux[b]); }
};

struct Slots {
  std::uint32_t begin, end;
};

/// Appends the points of these slots that are kept, in their order or in reverse.
void take(const PointCloud& cloud, const RingLayout& rings, const Slots& slots, std::span<const std::uint8_t> keep,
          Sightings& s) {
  const bool timed = cloud.has_times();
  const std::int64_t step = rings.mirrored ? -1 : 1;
  std::int64_t slot = rings.mirrored ? std::int64_t(slots.end) - 1 : std::int64_t(slots.begin);
  std::size_t n = s.count;
  for (std::uint32_t left = slots.end - slots.begin; left > 0; --left, slot += step) {
    const auto i = std::size_t(slot);
    const std::uint32_t index = rings.index[i];
    s.x[n] = rings.x[i];
    s.y[n] = rings.y[i];
    s.z[n] = rings.z[i];
    s.ux[n] = rings.ux[i];
    s.uy[n] = rings.uy[i];
    s.time[n] = timed ? cloud.times[index] : 0.0f;
    n += keep[index] != 0;
  }
  s.count = n;
}

void order_ring(const PointCloud& cloud, const RingLayout& rings, const Ring& ring, std::span<const std::uint8_t> keep,
                Sightings& s) {
  const auto begin = rings.azimuth.begin() + ring.begin;
  const auto wrap =
      std::uint32_t(std::lower_bound(begin, begin + ring.count, RingLayout::kTurn) - rings.azimuth.begin());
  s.resize(std::size_t(ring.count) + 1);
  s.count = 0;
  Slots first{wrap, ring.begin + ring.count}, second{ring.begin, wrap};
  if (rings.mirrored) std::swap(first, second);
  take(cloud, rings, first, keep, s);
  take(cloud, rings, second, keep, s);
}

// [rad] between two firings: the median of some of the steps.
float column_step(const Sightings& s) {
  std::vector<float> steps;
  const std::size_t stride = std::max<std::size_t>(1, s.count / 64);
  for (std::size_t i = stride; i < s.count; i += stride) steps.push_back(s.angle_between(i - 1, i));
  if (steps.empty()) return 1e-4f;
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  return std::max(steps[steps.size() / 2], 1e-4f);
}

/// What of a point depends on it and its neighbour alone, many at a time.
void measure(Sightings& s, float step, const SegmentOptions& options) {
  const float length = float(options.length), min_jump = float(options.min_jump);
  const float jump_ratio = float(options.jump_ratio), most_steps = kMostSteps * step;
  const float *x = s.x.data(), *y = s.y.data(), *z = s.z.data(), *ux = s.ux.data(), *uy = s.uy.data();
  float *range = s.range.data(), *reach = s.reach.data();
  std::uint8_t* after_jump = s.after_jump.data();
  for (std::size_t i = 0; i < s.count; ++i) {
    range[i] = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    reach[i] = square(std::max(length, 4.5f * step * range[i]));
  }
  after_jump[0] = 1;
  for (std::size_t b = 1; b < s.count; ++b) {
    const std::size_t a = b - 1;
    const float squared = square(x[a] - x[b]) + square(y[a] - y[b]) + square(z[a] - z[b]);
    const bool in_depth = std::abs(range[a] - range[b]) > std::max(min_jump, jump_ratio * range[b]);
    const bool in_space = squared > square(std::max(min_jump, 12 * range[b] * step));
    const bool in_angle = std::abs(ux[a] * uy[b] - uy[a] * ux[b]) > most_steps;
    after_jump[b] = std::uint8_t(in_depth | in_space | in_angle);
  }
}

/// Sums over a run about its first point.
struct RunSums {
  float x = 0, y = 0, z = 0, xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;
  double time = 0;

  /// Moments about the mean of `count` points, the first at `first`; `turn` is -1 where y is mirrored, else 1.
  Moments moments(const Eigen::Vector3d& first, std::size_t count, double turn) const {
    const auto n = double(count);
    const Eigen::Vector3d offset = Eigen::Vector3d(double(x), turn * double(y), double(z)) / n;
    const Symmetric3d sum{{double(xx), double(yy), double(zz), turn * double(xy), turn * double(yz), double(xz)}};
    return {n, first + offset, sum - n * Symmetric3d::product(offset, offset)};
  }
};

/// Cuts the ring, and adds its segments.
void cut(const Sightings& s, double turn, const SegmentOptions& options, std::vector<RingSegment>& segments) {
  for (std::size_t begin = 0, end = 0; begin < s.count; begin = end) {
    const float x = s.x[begin], y = s.y[begin], z = s.z[begin];
    RunSums sums{.time = double(s.time[begin])};
    for (end = begin + 1; end < s.count && s.after_jump[end] == 0; ++end) {
      const float dx = s.x[end] - x, dy = s.y[end] - y, dz = s.z[end] - z;
      const float xx = dx * dx, yy = dy * dy, zz = dz * dz;
      if (xx + yy + zz > s.reach[end]) break;
      sums.x += dx, sums.y += dy, sums.z += dz;
      sums.xx += xx, sums.yy += yy, sums.zz += zz;
      sums.xy += dx * dy, sums.yz += dy * dz, sums.xz += dz * dx;
      sums.time += double(s.time[end]);
    }
    const std::size_t count = end - begin;
    if (count < std::size_t(options.min_points)) continue;
    const Moments moments = sums.moments({double(x), turn * double(y), double(z)}, count, turn);
    const bool free = s.after_jump[begin] != 0 && (end == s.count || s.after_jump[end] != 0);
    segments.push_back({.moments = moments,
                        .azimuth = azimuth_of(moments.mean),
                        .width = s.angle_between(begin, end - 1),
                        .time = float(sums.time / double(count)),
                        .free = free});
  }
}

}  // namespace

RingSegments ring_segments(const PointCloud& cloud, const RingLayout& rings, std::span<const std::uint8_t> keep,
                           const SegmentOptions& options) {
  RingSegments result;
  if (rings.rings.empty()) return result;
  const std::size_t ids = std::size_t(*std::max_element(cloud.rings.begin(), cloud.rings.end())) + 1;
  std::vector<const Ring*> by_id(ids, nullptr);
  for (const Ring& ring : rings.rings) by_id[cloud.rings[rings.index[ring.begin]]] = &ring;
  result.segments.reserve(cloud.size() / 4);
  result.ring_begin.assign(1, 0);
  Sightings sightings;
  for (const Ring* ring : by_id) {
    if (ring == nullptr) continue;
    order_ring(cloud, rings, *ring, keep, sightings);
    measure(sightings, column_step(sightings), options);
    cut(sightings, rings.mirrored ? -1.0 : 1.0, options, result.segments);
    result.ring_begin.push_back(std::uint32_t(result.segments.size()));
  }
  return result;
}

}  // namespace tilth
