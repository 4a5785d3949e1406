#include <algorithm>
#include <numeric>

#include <tilth/preprocess/neighbor_distances.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/preprocess/neighbor_distances.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilth::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Weighted means of the rows [first, first + lanes); rows past the end repeat the last one and are not stored.
void mean_distances(const NeighborTable& table, const float* scale, float decay, float* means) {
  const hn::ScalableTag<float> f;
  const hn::RebindToSigned<decltype(f)> s;
  const std::size_t n = table.size(), lanes = hn::Lanes(f);
  HWY_ALIGN float out[HWY_MAX_BYTES / sizeof(float)];
  const auto minus_decay = hn::Set(f, -decay);
  for (std::size_t first = 0; first < n; first += lanes) {
    const auto row = hn::Min(hn::Iota(s, 0), hn::Set(s, std::int32_t(n - 1 - first)));
    const auto offset = hn::Mul(row, hn::Set(s, std::int32_t(table.k)));
    const auto unit = hn::GatherIndex(f, scale + first, row);
    const auto distance_to = [&](std::size_t t) {
      return hn::Mul(hn::Sqrt(hn::GatherIndex(f, table.squared_distances.data() + first * table.k + t, offset)), unit);
    };
    const auto nearest = distance_to(0);  // weighs 1, so that the sum of all weights never vanishes
    auto weights = hn::Zero(f), sum = hn::Zero(f);
    for (std::size_t t = 0; t < table.k; ++t) {
      const auto distance = distance_to(t);
      const auto weight = decay == 0 ? hn::Set(f, 1.0f) : hn::Exp(f, hn::Mul(minus_decay, hn::Sub(distance, nearest)));
      weights = hn::Add(weights, weight);
      sum = hn::MulAdd(weight, distance, sum);
    }
    hn::Store(hn::Div(sum, weights), f, out);
    std::copy_n(out, std::min(lanes, n - first), means + first);
  }
}

}  // namespace tilth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(mean_distances);

std::vector<float> mean_distances(const NeighborTable& neighbors, std::span<const float> scale, float decay) {
  std::vector<float> means(neighbors.size());
  HWY_DYNAMIC_DISPATCH(mean_distances)(neighbors, scale.data(), decay, means.data());
  return means;
}

double mean_distance(const NeighborTable& neighbors, std::span<const float> scale) {
  const std::vector<float> means = mean_distances(neighbors, scale, 0.0f);
  return means.empty() ? 0.0 : std::accumulate(means.begin(), means.end(), 0.0) / double(means.size());
}

}  // namespace tilth
#endif
