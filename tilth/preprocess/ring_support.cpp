#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/preprocess/ring_support.hpp>
#include <tilth/preprocess/upright_support.hpp>
#include <tilth/search/ring_layout.hpp>

namespace tilth {
namespace {

constexpr float kDeviations = 3.0f;    // of the noise
constexpr float kReachColumns = 6.0f;  // between beams that can see the same surface

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

/// Appends the slots that find no support to `alone`.
void support_along(Support& s, const Ring& ring, std::vector<std::uint32_t>& agree, std::vector<std::uint32_t>& alone) {
  constexpr std::uint32_t kLeast = 3;  // points: with fewer, a slot's neighbours are the same point
  if (ring.count >= kLeast)
    agree_with_next(s, ring, agree);
  else
    agree.assign(ring.count + 1, 0);
  const std::span<const std::uint32_t> index(&s.rings.index[ring.begin], ring.count);
  const std::span<std::uint8_t> keep(s.keep);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    const bool beside = ((agree[i] & 2) | (agree[i + 1] & 1)) != 0;
    const bool supported = beside || supported_along(s, ring.begin + i);
    keep[index[i]] = std::uint8_t(supported);
    if (!supported) alone.push_back(ring.begin + i);
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
  IsolatedPoints isolated;
  for (const Ring& ring : rings.rings) {
    support_along(support, ring, agree, isolated.slots);
    isolated.ring_begin.push_back(isolated.slots.size());
  }
  support_upright(support, isolated);
  if (2 * std::count(support.keep.begin(), support.keep.end(), 1) < std::ptrdiff_t(points)) return std::nullopt;
  return std::move(support.keep);
}

}  // namespace tilth
