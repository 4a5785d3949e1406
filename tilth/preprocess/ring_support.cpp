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
  using Slots = Eigen::Map<const Eigen::ArrayXf>;
  const auto size = Eigen::Index(rings.x.size());
  std::vector<float> distance(rings.x.size());
  Eigen::Map<Eigen::ArrayXf>(distance.data(), size) =
      (Slots(rings.x.data(), size).square() + Slots(rings.y.data(), size).square()).sqrt();
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

/// Whether each slot of a ring, and the one before the first, agrees with the next slot, 1 or 0, and that one with it,
/// 2 or 0: agree_along of three points and more, many at a time.
void agree_with_next(const Support& s, const Ring& ring, std::vector<std::uint32_t>& agree) {
  const std::uint32_t first = ring.begin - 1;
  const float *ux = &s.rings.ux[first], *uy = &s.rings.uy[first], *distance = &s.distance[first];
  const float pair = s.pair, slope = s.slope, reach = s.reach;
  const std::size_t count = std::size_t(ring.count) + 1;
  agree.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float sine = std::abs(ux[i] * uy[i + 1] - uy[i] * ux[i + 1]), cosine = ux[i] * ux[i + 1] + uy[i] * uy[i + 1];
    const float step = std::abs(distance[i + 1] - distance[i]);
    const std::uint32_t beside = (cosine > 0.0f) & (sine < reach);
    const std::uint32_t one = step <= pair + slope * distance[i] * sine;
    const std::uint32_t other = step <= pair + slope * distance[i + 1] * sine;
    agree[i] = beside * (one + 2 * other);
  }
}

void support_along(Support& s, const Ring& ring, std::vector<std::uint32_t>& agree) {
  constexpr std::uint32_t kLeast = 3;  // points: with fewer, a slot's neighbours are the same point
  if (ring.count >= kLeast)
    agree_with_next(s, ring, agree);
  else
    agree.assign(ring.count + 1, 0);
  const std::span<const std::uint32_t> index(&s.rings.index[ring.begin], ring.count);
  const std::span<std::uint8_t> keep(s.keep);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    const bool beside = ((agree[i] & 2) | (agree[i + 1] & 1)) != 0;
    keep[index[i]] |= std::uint8_t(beside || supported_along(s, ring.begin + i));
  }
}

/// Upright things, if only one beam wide: each of two points on neighbouring rings in one direction keeps the other.
void support_across(Support& s, const Ring& lower, const Ring& upper) {
  const std::span<const float> azimuth(s.rings.azimuth);
  const std::span<const std::uint32_t> index(s.rings.index);
  const std::span<std::uint8_t> keep(s.keep);
  const float front = azimuth[upper.begin];
  std::uint32_t next = upper.begin;
  float last = front;
  const std::uint32_t lower_end = lower.begin + lower.count, upper_end = upper.begin + upper.count;
  for (std::uint32_t slot = lower.begin; slot < lower_end; ++slot) {
    float a = azimuth[slot];
    while (a < front) a += kTurn;
    while (a >= front + kTurn) a -= kTurn;
    if (a < last) next = upper.begin;
    last = a;
    while (next < upper_end && azimuth[next] < a) ++next;
    for (const std::uint32_t other : {next - 1, next}) {
      if (keep[index[slot]] & keep[index[other]]) continue;
      if (std::abs(s.distance[slot] - s.distance[other]) > s.pair || angle_between(s, slot, other) == 1.0f) continue;
      keep[index[slot]] = keep[index[other]] = 1;
    }
  }
}

}  // namespace

std::optional<std::vector<std::uint8_t>> ring_support(const PointCloud& cloud, const RingSupportOptions& options) {
  RingLayout rings;
  arrange(cloud, rings);  // rings that overlap in elevation, as those of a deskewed scan may, are good enough here
  return ring_support(rings, cloud.size(), options);
}

std::optional<std::vector<std::uint8_t>> ring_support(const RingLayout& rings, std::size_t points,
                                                      const RingSupportOptions& options) {
  if (rings.rings.empty()) return std::nullopt;
  const float allowed = kDeviations * float(options.noise);
  Support support{rings,
                  axis_distances(rings),
                  std::vector<std::uint8_t>(points, 0),
                  allowed * std::numbers::sqrt2_v<float>,
                  allowed * std::sqrt(6.0f),
                  float(options.slope),
                  reach_of(rings)};
  std::vector<std::uint32_t> agree;
  for (const Ring& ring : rings.rings) support_along(support, ring, agree);
  for (std::size_t r = 1; r < rings.rings.size(); ++r) support_across(support, rings.rings[r - 1], rings.rings[r]);
  if (2 * std::count(support.keep.begin(), support.keep.end(), 1) < std::ptrdiff_t(points)) return std::nullopt;
  return std::move(support.keep);
}

}  // namespace tilth
