#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/features/ring_segments.hpp>

namespace tilth {
namespace {

constexpr float kTurn = 4.0f;       // of the layout's azimuths
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

/// A point as its beam saw it; y is mirrored like that of the layout.
struct Sighting {
  float x, y, z, range;  // [m]
  float ux, uy;          // of its direction
  float time;            // [s]
};
using Sightings = std::span<const Sighting>;

/// The points of a ring that are kept, counter-clockwise from the x axis on, whichever way the sensor turns.
void order_ring(const PointCloud& cloud, const RingLayout& rings, const Ring& ring, std::span<const std::uint8_t> keep,
                std::vector<Sighting>& sightings) {
  const auto begin = rings.azimuth.begin() + ring.begin;
  const auto wrap = std::lower_bound(begin, begin + ring.count, kTurn) - rings.azimuth.begin();
  const auto first = std::uint32_t(wrap), end = ring.begin + ring.count;
  const bool timed = cloud.has_times();
  sightings.clear();
  const auto take = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t s = from; s < to; ++s) {
      const std::uint32_t index = rings.index[s];
      if (keep[index] == 0) continue;
      const float x = rings.x[s], y = rings.y[s], z = rings.z[s];
      sightings.push_back(
          {x, y, z, std::sqrt(x * x + y * y + z * z), rings.ux[s], rings.uy[s], timed ? cloud.times[index] : 0.0f});
    }
  };
  take(first, end);
  take(ring.begin, first);
  if (rings.mirrored) std::reverse(sightings.begin(), sightings.end());
}

/// Nearly the angle [rad] between two beams less than a right angle apart.
float angle_between(const Sighting& a, const Sighting& b) {
  return std::abs(a.ux * b.uy - a.uy * b.ux);
}

// [rad] between two firings: the median of some of the steps.
float column_step(Sightings ring) {
  std::vector<float> steps;
  const std::size_t stride = std::max<std::size_t>(1, ring.size() / 64);
  for (std::size_t i = stride; i < ring.size(); i += stride) steps.push_back(angle_between(ring[i - 1], ring[i]));
  if (steps.empty()) return 1e-4f;
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  return std::max(steps[steps.size() / 2], 1e-4f);
}

float square(float x) {
  return x * x;
}

float square_distance(const Sighting& a, const Sighting& b) {
  return square(a.x - b.x) + square(a.y - b.y) + square(a.z - b.z);
}

/// The moments of a run, added up about its first point; `turn` is -1 where y is mirrored, else 1.
RingSegment segment_of(Sightings run, double turn) {
  const Sighting& first = run.front();
  float x = 0, y = 0, z = 0, xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  double time = 0;
  for (const Sighting& p : run) {
    const float dx = p.x - first.x, dy = p.y - first.y, dz = p.z - first.z;
    x += dx, y += dy, z += dz;
    xx += dx * dx, yy += dy * dy, zz += dz * dz;
    xy += dx * dy, yz += dy * dz, zx += dz * dx;
    time += double(p.time);
  }
  const auto n = double(run.size());
  const Eigen::Vector3d offset = Eigen::Vector3d(double(x), turn * double(y), double(z)) / n;
  const Eigen::Vector3d mean = Eigen::Vector3d(double(first.x), turn * double(first.y), double(first.z)) + offset;
  Eigen::Matrix3d moments = Eigen::Vector3d(double(xx), double(yy), double(zz)).asDiagonal();
  moments(0, 1) = moments(1, 0) = turn * double(xy);
  moments(1, 2) = moments(2, 1) = turn * double(yz);
  moments(2, 0) = moments(0, 2) = double(zx);
  return {.mean = mean,
          .scatter = moments - n * offset * offset.transpose(),
          .azimuth = azimuth_of(mean),
          .width = angle_between(first, run.back()),
          .time = float(time / n),
          .count = int(run.size())};
}

/// Cuts one ring.
std::vector<RingSegment> cut(Sightings ring, double turn, const SegmentOptions& options) {
  const float step = column_step(ring), length = float(options.length), min_jump = float(options.min_jump);
  const float jump_share = float(options.jump_share);
  const auto jumps = [&](const Sighting& a, const Sighting& b) {
    return std::abs(a.range - b.range) > std::max(min_jump, jump_share * b.range) ||
           square_distance(a, b) > square(std::max(min_jump, 12 * b.range * step)) ||
           angle_between(a, b) > kMostSteps * step;
  };
  std::vector<RingSegment> segments;
  bool after_jump = true;
  for (std::size_t begin = 0, end = 1; begin < ring.size(); begin = end++) {
    const Sighting& first = ring[begin];
    bool jump = true;
    for (; end < ring.size(); ++end) {
      jump = jumps(ring[end - 1], ring[end]);
      if (jump || square_distance(first, ring[end]) > square(std::max(length, 4.5f * step * ring[end].range))) break;
    }
    if (end - begin >= std::size_t(options.min_points)) {
      segments.push_back(segment_of(ring.subspan(begin, end - begin), turn));
      segments.back().free = after_jump && (jump || end == ring.size());
    }
    after_jump = jump;
  }
  return segments;
}

}  // namespace

std::vector<std::vector<RingSegment>> ring_segments(const PointCloud& cloud, const RingLayout& rings,
                                                    std::span<const std::uint8_t> keep, const SegmentOptions& options) {
  if (rings.rings.empty()) return {};
  std::vector<std::vector<RingSegment>> segments(
      std::size_t(*std::max_element(cloud.rings.begin(), cloud.rings.end())) + 1);
  std::vector<Sighting> sightings;
  for (const Ring& ring : rings.rings) {
    order_ring(cloud, rings, ring, keep, sightings);
    segments[cloud.rings[rings.index[ring.begin]]] = cut(sightings, rings.mirrored ? -1.0 : 1.0, options);
  }
  return segments;
}

}  // namespace tilth
