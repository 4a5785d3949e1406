#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/preprocess/ring_support.hpp>
#include <tilth/search/ring_layout.hpp>

namespace tilth {
namespace {

constexpr float kDeviations = 3.0f;    // of the noise
constexpr float kReachColumns = 6.0f;  // between beams that can see the same surface
constexpr float kTurn = 4.0f;          // of the layout's azimuths

/// What the tests of single points need, slot by slot.
struct Support {
  const RingLayout& rings;
  std::vector<float> distance;     // [m] from the sensor's axis
  std::vector<std::uint8_t> keep;  // by point
  float pair, line;                // [m] allowed between two distances; to the line through two others
  float slope;
  float reach;  // [rad] nearly: sine of the angle
};

std::vector<float> axis_distances(const RingLayout& rings) {
  std::vector<float> distance(rings.x.size());
  for (std::size_t s = 0; s < distance.size(); ++s) {
    distance[s] = std::sqrt(rings.x[s] * rings.x[s] + rings.y[s] * rings.y[s]);
  }
  return distance;
}

float reach_of(const RingLayout& rings) {
  std::uint32_t most = 1;
  for (const Ring& ring : rings.rings) most = std::max(most, ring.count);
  return std::min(0.5f, kReachColumns * 2.0f * std::numbers::pi_v<float> / float(most));
}

/// The angle between two beams, nearly; 1 where they are one, or too far apart.
float angle_between(const Support& s, std::uint32_t a, std::uint32_t b) {
  const RingLayout& l = s.rings;
  const float sine = std::abs(l.ux[a] * l.uy[b] - l.uy[a] * l.ux[b]);
  const bool ahead = l.ux[a] * l.ux[b] + l.uy[a] * l.uy[b] > 0.0f;
  return ahead && sine < s.reach && l.index[a] != l.index[b] ? sine : 1.0f;
}

bool agree_along(const Support& s, std::uint32_t a, std::uint32_t b) {
  const float angle = angle_between(s, a, b);
  return angle < 1.0f && std::abs(s.distance[b] - s.distance[a]) <= s.pair + s.slope * s.distance[a] * angle;
}

/// Whether `slot` continues the flat surface through its neighbours `step` and twice `step` places on: their inverse
/// distances are evenly spaced then.
bool continues(const Support& s, std::uint32_t slot, int step) {
  const std::uint32_t near = slot + std::uint32_t(step), far = near + std::uint32_t(step);
  if (angle_between(s, slot, near) == 1.0f || angle_between(s, slot, far) == 1.0f) return false;
  const float d = s.distance[slot];
  const float off = 2.0f / s.distance[near] - 1.0f / s.distance[far] - 1.0f / d;
  return std::abs(off) * d * d <= s.line;
}

bool supported_along(const Support& s, std::uint32_t slot) {
  for (const std::uint32_t other : {slot - 1, slot + 1, slot - 2, slot + 2}) {
    if (agree_along(s, slot, other)) return true;
  }
  return continues(s, slot, -1) || continues(s, slot, 1);
}

void support_along(Support& s, const Ring& ring) {
  for (std::uint32_t slot = ring.begin; slot < ring.begin + ring.count; ++slot) {
    s.keep[s.rings.index[slot]] |= std::uint8_t(supported_along(s, slot));
  }
}

/// Upright things, if only one beam wide: each of two points on neighbouring rings in one direction keeps the other.
void support_across(Support& s, const Ring& lower, const Ring& upper) {
  const std::vector<float>& azimuth = s.rings.azimuth;
  const float front = azimuth[upper.begin];
  std::uint32_t next = upper.begin;
  float last = front;
  for (std::uint32_t slot = lower.begin; slot < lower.begin + lower.count; ++slot) {
    const float a = azimuth[slot] - kTurn * std::floor((azimuth[slot] - front) / kTurn);
    if (a < last) next = upper.begin;
    last = a;
    while (next < upper.begin + upper.count && azimuth[next] < a) ++next;
    for (const std::uint32_t other : {next - 1, next}) {
      if (std::abs(s.distance[slot] - s.distance[other]) > s.pair || angle_between(s, slot, other) == 1.0f) continue;
      s.keep[s.rings.index[slot]] = s.keep[s.rings.index[other]] = 1;
    }
  }
}

}  // namespace

std::optional<std::vector<std::uint8_t>> ring_support(const PointCloud& cloud, const RingSupportOptions& options) {
  RingLayout rings;
  arrange(cloud, rings);  // rings that overlap in elevation, as those of a deskewed scan may, are good enough here
  if (rings.rings.empty()) return std::nullopt;
  const float allowed = kDeviations * float(options.noise);
  Support support{rings,
                  axis_distances(rings),
                  std::vector<std::uint8_t>(cloud.size(), 0),
                  allowed * std::numbers::sqrt2_v<float>,
                  allowed * std::sqrt(6.0f),
                  float(options.slope),
                  reach_of(rings)};
  for (const Ring& ring : rings.rings) support_along(support, ring);
  for (std::size_t r = 1; r < rings.rings.size(); ++r) support_across(support, rings.rings[r - 1], rings.rings[r]);
  if (2 * std::count(support.keep.begin(), support.keep.end(), 1) < std::ptrdiff_t(cloud.size())) return std::nullopt;
  return std::move(support.keep);
}

}  // namespace tilth
