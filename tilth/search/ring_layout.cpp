#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include <tilth/search/ring_directions.hpp>
#include <tilth/search/ring_layout.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostRings = 1024;
constexpr double kWidening = 2e-6;    // [rad] added to elevations: far above the rounding of float
constexpr float kMostOverlap = 2.0f;  // summed width of the rings' elevations over the whole width

struct Build {
  const PointCloud& cloud;
  RingLayout& out;
  std::vector<std::uint64_t> order, merged;  // pseudo angle and position
  std::vector<std::uint32_t> position;       // of the next point of each ring id
  std::vector<float> sorted;
  std::vector<std::uint32_t> sorted_index;
};

// Counts the points of each ring, gives every ring its place and fills in the points as they come.
bool place_points(Build& b) {
  const std::vector<std::uint16_t>& ids = b.cloud.rings;
  const std::size_t most = *std::max_element(ids.begin(), ids.end());
  if (most >= kMostRings) return false;
  b.position.assign(most + 1, 0);
  for (const std::uint16_t id : ids) ++b.position[id];
  std::uint32_t slot = 0;
  for (std::uint32_t& count : b.position) {
    const std::uint32_t n = count;
    count = slot + RingLayout::kPad;
    if (n > 0) {
      Ring& ring = b.out.rings.emplace_back();
      ring.begin = count;
      ring.count = n;
      slot += n + 2 * RingLayout::kPad;
    }
  }
  for (std::vector<float>* v : {&b.out.x, &b.out.y, &b.out.z, &b.out.ux, &b.out.uy, &b.out.azimuth}) v->resize(slot);
  b.out.index.resize(slot);
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    const Eigen::Vector3d& p = b.cloud.points[i];
    const std::uint32_t s = b.position[ids[i]]++;
    b.out.x[s] = float(p.x());
    b.out.y[s] = float(p.y());
    b.out.z[s] = float(p.z());
    b.out.index[s] = i;
  }
  return true;
}

// Mirrors the scan where most points lie clockwise of the point before them in their ring.
void turn_counterclockwise(RingLayout& l) {
  constexpr std::uint32_t kStride = 16;
  int votes = 0;
  for (const Ring& r : l.rings) {
    for (std::uint32_t s = r.begin; s + 1 < r.begin + r.count; s += kStride) {
      const float cross = l.x[s] * l.y[s + 1] - l.y[s] * l.x[s + 1];
      votes += (cross > 0.0f) - (cross < 0.0f);
    }
  }
  l.mirrored = votes < 0;
  if (!l.mirrored) return;
  for (float& y : l.y) y = -y;
}

Elevation elevation(double angle) {
  return {float(angle), float(std::sin(angle)), float(std::cos(angle))};
}

// Gives points on the axis, which lie in every direction, that of the point before them.
void direct_axis_points(RingLayout& l, const Ring& ring) {
  for (std::uint32_t s = ring.begin + 1; s < ring.begin + ring.count; ++s) {
    if (std::abs(l.x[s]) + std::abs(l.y[s]) > 1e-12f) continue;
    for (std::vector<float>* v : {&l.ux, &l.uy, &l.azimuth}) (*v)[s] = (*v)[s - 1];
  }
}

// Directions of the points of a ring, and the elevations between which they lie. True if it goes once round, ascending;
// its azimuths then go on past 4 after the wrap.
bool measure(RingLayout& l, Ring& ring) {
  const RingDirections d = measure_directions(l, ring);
  const bool any = d.lowest_slope <= d.highest_slope;
  ring.low = elevation(std::max((any ? std::atan(double(d.lowest_slope)) : 0.0) - kWidening, -M_PI_2));
  ring.high = elevation(std::min((any ? std::atan(double(d.highest_slope)) : 0.0) + kWidening, M_PI_2));
  if (d.on_axis > 0) direct_axis_points(l, ring);
  if (d.on_axis > 0 || d.descents > 1) return false;
  const std::span<float> azimuth(&l.azimuth[ring.begin], ring.count);
  if (d.descents == 1) {
    for (float& a : azimuth.subspan(d.last_descent)) a += RingLayout::kTurn;
  }
  return azimuth.back() <= azimuth.front() + RingLayout::kTurn;
}

template <class T>
void permute(std::vector<T>& values, std::uint32_t begin, std::span<const std::uint64_t> order,
             std::vector<T>& buffer) {
  buffer.assign(values.begin() + begin, values.begin() + begin + std::ptrdiff_t(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) values[begin + i] = buffer[std::uint32_t(order[i])];
}

// Sorts a ring that overlaps itself (a revolution of 363 degrees) or comes in no order.
void sort_ring(Build& b, const Ring& ring) {
  RingLayout& l = b.out;
  b.order.resize(ring.count);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    float& a = l.azimuth[ring.begin + i];
    while (a >= RingLayout::kTurn) a -= RingLayout::kTurn;
    b.order[i] = std::uint64_t(std::bit_cast<std::uint32_t>(a + 1.0f)) << 32 | i;
  }
  const auto second_run = std::is_sorted_until(b.order.begin(), b.order.end());
  if (std::is_sorted(second_run, b.order.end())) {
    b.merged.resize(ring.count);
    std::merge(b.order.begin(), second_run, second_run, b.order.end(), b.merged.begin());
    b.order.swap(b.merged);
  } else {
    std::sort(b.order.begin(), b.order.end());
  }
  for (std::vector<float>* v : {&l.x, &l.y, &l.z, &l.ux, &l.uy, &l.azimuth}) permute(*v, ring.begin, b.order, b.sorted);
  permute(l.index, ring.begin, b.order, b.sorted_index);
}

// Goes on round the circle on both sides of a ring.
void pad(RingLayout& l, const Ring& ring) {
  const auto copy = [&](std::uint32_t to, std::uint32_t from, float turn) {
    for (std::vector<float>* v : {&l.x, &l.y, &l.z, &l.ux, &l.uy}) (*v)[to] = (*v)[from];
    l.azimuth[to] = l.azimuth[from] + turn;
    l.index[to] = l.index[from];
  };
  const std::uint32_t n = ring.count;
  for (std::uint32_t i = 0; i < RingLayout::kPad; ++i) {
    copy(ring.begin + n + i, ring.begin + i, RingLayout::kTurn);
    copy(ring.begin - 1 - i, ring.begin + n - 1 - i, -RingLayout::kTurn);
  }
}

// Orders the rings upwards. False if they overlap so much that a ring says little about elevation.
bool order_rings(std::vector<Ring>& rings) {
  const auto lower = [](const Elevation& a, const Elevation& b) { return a.angle < b.angle; };
  std::sort(rings.begin(), rings.end(),
            [](const Ring& a, const Ring& b) { return a.low.angle + a.high.angle < b.low.angle + b.high.angle; });
  float width = 0.0f;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    width += rings[i].high.angle - rings[i].low.angle;
    rings[i].highest_below = i == 0 ? rings[i].high : std::max(rings[i - 1].highest_below, rings[i].high, lower);
  }
  for (std::size_t i = rings.size(); i-- > 0;) {
    rings[i].lowest_above =
        i + 1 == rings.size() ? rings[i].low : std::min(rings[i + 1].lowest_above, rings[i].low, lower);
  }
  return width <= kMostOverlap * (rings.back().highest_below.angle - rings.front().lowest_above.angle);
}

}  // namespace

bool arrange(const PointCloud& cloud, RingLayout& layout) {
  layout.rings.clear();
  if (cloud.empty() || !cloud.has_rings()) return false;
  Build build{cloud, layout, {}, {}, {}, {}, {}};
  if (!place_points(build)) return false;
  turn_counterclockwise(layout);
  for (Ring& ring : layout.rings) {
    if (!measure(layout, ring)) sort_ring(build, ring);
    pad(layout, ring);
  }
  return order_rings(layout.rings);
}

}  // namespace tilth
