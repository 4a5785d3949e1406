#include <algorithm>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/preprocess/neighbor_distances.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/preprocess/neighbor_distances.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::ScalableTag<float>;
using Floats = hn::Vec<F>;

constexpr std::size_t kLanes = HWY_LANES(float);

/// The distances of the rows [first, first + rows), at most a lane each, row by row.
HWY_INLINE void distances_of(const NeighborTable& table, std::size_t first, std::size_t rows, float* to) {
  const F f;
  const float* const from = table.squared_distances.data() + first * table.k;
  const std::size_t count = rows * table.k;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) hn::Store(hn::Sqrt(hn::LoadU(f, from + i)), f, to + i);
  if (i < count) hn::Store(hn::Sqrt(hn::MaskedLoad(hn::FirstN(f, count - i), f, from + i)), f, to + i);
}

/// Calls visit(first row, rows, their distances) for all rows, as many at once as there are lanes.
template <class Visit>
HWY_INLINE void for_rows(const NeighborTable& table, const Visit& visit) {
  HWY_ALIGN float distances[kMostNeighbors * kLanes];
  const std::size_t n = table.size();
  for (std::size_t first = 0; first < n; first += kLanes) {
    const std::size_t rows = std::min(kLanes, n - first);
    distances_of(table, first, rows, distances);
    visit(first, rows, distances);
  }
}

// The functions below are compiled for rows of kUsual entries, and with kCount = 0 for those of any length.
constexpr std::size_t kUsual = 10;

template <std::size_t kCount>
HWY_INLINE float sum_of(const float* values, std::size_t count) {
  const std::size_t length = kCount > 0 ? kCount : count;
  float sum = 0.0f;
  HWY_UNROLL(10) for (std::size_t t = 0; t < length; ++t) sum += values[t];
  return sum;
}

template <std::size_t kCount>
void mean_rows(const NeighborTable& table, std::span<const float> scale, std::span<float> means) {
  const std::size_t k = table.k;
  for_rows(table, [&](std::size_t first, std::size_t rows, const float* distances) HWY_ATTR {
    for (std::size_t i = 0; i < rows; ++i) {
      const float mean = sum_of<kCount>(distances + i * k, k) / float(k);
      means[first + i] = scale.empty() ? mean : mean * scale[first + i];
    }
  });
}

void mean_distances_simd(const NeighborTable& table, std::span<const float> scale, std::span<float> means) {
  if (table.k == kUsual) return mean_rows<kUsual>(table, scale, means);
  mean_rows<0>(table, scale, means);
}

/// A row becomes a lane of as many vectors as it has entries.
template <std::size_t kCount>
HWY_INLINE void put_in_lane(const float* row, std::size_t count, std::size_t lane, float* columns) {
  const std::size_t length = kCount > 0 ? kCount : count;
  HWY_UNROLL(10) for (std::size_t t = 0; t < length; ++t) columns[t * kLanes + lane] = row[t];
}

/// Of each lane of `columns`, whose distances ascend.
HWY_INLINE Floats weighted_mean(const float* columns, std::size_t k, Floats unit, Floats minus_decay) {
  const F f;
  const Floats nearest = hn::Load(f, columns);  // weighs 1, so that the sum of all weights never vanishes
  const Floats factor = hn::Mul(minus_decay, unit);
  Floats weights = hn::Zero(f), sum = hn::Zero(f);
  for (std::size_t t = 0; t < k; ++t) {
    const Floats distance = hn::Load(f, columns + t * kLanes);
    const Floats weight = hn::Exp(f, hn::Mul(factor, hn::Sub(distance, nearest)));
    weights = hn::Add(weights, weight);
    sum = hn::MulAdd(weight, distance, sum);
  }
  return hn::Mul(unit, hn::Div(sum, weights));
}

template <std::size_t kCount>
void weighted_rows(const NeighborTable& table, std::span<const float> scale, float decay, std::span<float> means) {
  const F f;
  const std::size_t k = table.k;
  HWY_ALIGN float columns[kMostNeighbors * kLanes] = {}, units[kLanes] = {}, out[kLanes];
  for_rows(table, [&](std::size_t first, std::size_t rows, const float* distances) HWY_ATTR {
    for (std::size_t i = 0; i < rows; ++i) {
      put_in_lane<kCount>(distances + i * k, k, i, columns);
      units[i] = scale.empty() ? 1.0f : scale[first + i];
    }
    hn::Store(weighted_mean(columns, k, hn::Load(f, units), hn::Set(f, -decay)), f, out);
    std::copy_n(out, rows, &means[first]);
  });
}

void weighted_means_simd(const NeighborTable& table, std::span<const float> scale, float decay,
                         std::span<float> means) {
  if (table.k == kUsual) return weighted_rows<kUsual>(table, scale, decay, means);
  weighted_rows<0>(table, scale, decay, means);
}

void inverse_ranges_simd(std::span<const Eigen::Vector3d> points, std::span<float> scale) {
  const hn::ScalableTag<double> d;
  using Doubles = hn::Vec<decltype(d)>;
  const hn::Rebind<float, decltype(d)> half;
  const std::size_t lanes = hn::Lanes(d), whole = points.size() / lanes * lanes;
  const Doubles least = hn::Set(d, 1e-3);
  const auto one = hn::Set(half, 1.0f);
  for (std::size_t i = 0; i < whole; i += lanes) {
    Doubles x, y, z;
    hn::LoadInterleaved3(d, points[i].data(), x, y, z);
    const Doubles squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    hn::StoreU(hn::Div(one, hn::DemoteTo(half, hn::Max(hn::Sqrt(squared), least))), half, &scale[i]);
  }
  for (std::size_t i = whole; i < points.size(); ++i) scale[i] = 1.0f / float(std::max(points[i].norm(), 1e-3));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {
namespace {

HWY_EXPORT(mean_distances_simd);
HWY_EXPORT(weighted_means_simd);
HWY_EXPORT(inverse_ranges_simd);

void check_table(const NeighborTable& table) {
  if (table.k > kMostNeighbors)
    throw Error("neighbors", "more than " + std::to_string(kMostNeighbors) + " neighbours of a point");
}

}  // namespace

void inverse_ranges(std::span<const Eigen::Vector3d> points, std::span<float> scale) {
  HWY_DYNAMIC_DISPATCH(inverse_ranges_simd)(points, scale);
}

void mean_distances(const NeighborTable& neighbors, std::span<const float> scale, std::span<float> means) {
  check_table(neighbors);
  HWY_DYNAMIC_DISPATCH(mean_distances_simd)(neighbors, scale, means);
}

void weighted_mean_distances(const NeighborTable& neighbors, std::span<const float> scale, float decay,
                             std::span<float> means) {
  check_table(neighbors);
  HWY_DYNAMIC_DISPATCH(weighted_means_simd)(neighbors, scale, decay, means);
}

}  // namespace tilth
#endif
