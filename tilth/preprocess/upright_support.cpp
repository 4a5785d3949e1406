#include <algorithm>

#include <tilth/preprocess/upright_support.hpp>

namespace tilth {
namespace {

/// Finds azimuths of another ring in this one; quickly where they ascend from call to call.
class Locator {
 public:
  Locator(const RingLayout& rings, const Ring& ring)
      : azimuth_(rings.azimuth), begin_(ring.begin), end_(ring.begin + ring.count), next_(ring.begin) {}

  /// The first slot whose azimuth is not below `azimuth`; the end if there is none.
  std::uint32_t locate(float azimuth) {
    const float front = azimuth_[begin_];
    while (azimuth < front) azimuth += RingLayout::kTurn;
    while (azimuth >= front + RingLayout::kTurn) azimuth -= RingLayout::kTurn;
    if (azimuth < last_) next_ = begin_;
    last_ = azimuth;
    while (next_ < end_ && azimuth_[next_] < azimuth) ++next_;
    return next_;
  }

 private:
  std::span<const float> azimuth_;
  std::uint32_t begin_, end_, next_;
  float last_ = 0.0f;
};

bool agree_across(const Support& s, std::uint32_t a, std::uint32_t b) {
  return std::abs(s.distance[a] - s.distance[b]) <= s.pair && angle_between(s, a, b) < 1.0f;
}

void keep_both(Support& s, std::uint32_t a, std::uint32_t b) {
  s.keep[s.rings.index[a]] = s.keep[s.rings.index[b]] = 1;
}

/// Each of `slots` with the two of the ring above between which it lies.
void support_from_above(Support& s, std::span<const std::uint32_t> slots, const Ring& upper) {
  Locator locator(s.rings, upper);
  for (const std::uint32_t slot : slots) {
    const std::uint32_t next = locator.locate(s.rings.azimuth[slot]);
    for (const std::uint32_t other : {next - 1, next}) {
      if (agree_across(s, slot, other)) keep_both(s, slot, other);
    }
  }
}

/// Each of `slots` of the ring above with those of the lower one that lie between it and the slots beside it.
void support_from_below(Support& s, std::span<const std::uint32_t> slots, const Ring& lower, const Ring& upper) {
  constexpr std::uint32_t kMore = 3;  // on account of rounding
  const RingLayout& l = s.rings;
  const std::uint32_t n = lower.count;
  Locator first_locator(l, lower), last_locator(l, lower), upper_locator(l, upper);
  for (const std::uint32_t slot : slots) {
    const std::uint32_t first = first_locator.locate(l.azimuth[slot - 1]) - lower.begin + n - 1;
    const std::uint32_t last = last_locator.locate(l.azimuth[slot + 1]) - lower.begin + n - 1;
    const bool far_apart = l.azimuth[slot + 1] - l.azimuth[slot - 1] > RingLayout::kTurn / 2;
    const std::uint32_t count = far_apart ? n : std::min(n, (last + n - first) % n + kMore);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t other = lower.begin + (first + i) % n;
      if (!agree_across(s, other, slot)) continue;
      const std::uint32_t next = upper_locator.locate(l.azimuth[other]);
      if (l.index[next] == l.index[slot] || l.index[next - 1] == l.index[slot]) keep_both(s, slot, other);
    }
  }
}

}  // namespace

void support_upright(Support& support, const IsolatedPoints& isolated) {
  const std::vector<Ring>& rings = support.rings.rings;
  for (std::size_t r = 1; r < rings.size(); ++r) {
    support_from_above(support, isolated.ring(r - 1), rings[r]);
    support_from_below(support, isolated.ring(r), rings[r - 1], rings[r]);
  }
}

}  // namespace tilth
