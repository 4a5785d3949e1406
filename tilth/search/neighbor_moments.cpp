#include <algorithm>

#include <tilth/core/error.hpp>
#include <tilth/search/neighbor_moments.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/search/neighbor_moments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using Floats = hn::Vec<D>;

constexpr std::size_t kLanes = HWY_LANES(float);

/// Sums over the kept neighbours of as many points as there are lanes, four floats a point.
struct Sums {
  alignas(64) float offsets[4 * kLanes];   // x, y, z and their number
  alignas(64) float squares[4 * kLanes];   // xx, yy, zz
  alignas(64) float products[4 * kLanes];  // xy, yz, xz
};

#if HWY_TARGET == HWY_SCALAR
template <bool kAllKept>
void sum_products(const float* points, std::size_t center, std::span<const std::uint32_t> neighbors, std::size_t,
                  Sums& sums) {
  sums = {};
  for (const std::uint32_t n : neighbors) {
    const float *const p = points + 4 * center, *const q = points + 4 * std::size_t(n), kept = q[3];
    const float offset[3] = {(q[0] - p[0]) * kept, (q[1] - p[1]) * kept, (q[2] - p[2]) * kept};
    for (std::size_t i = 0; i < 3; ++i) {
      sums.offsets[i] += offset[i];
      sums.squares[i] += offset[i] * offset[i];
      sums.products[i] += offset[i] * offset[(i + 1) % 3];
    }
    sums.offsets[3] += kept;
  }
}
#else
template <bool kAllKept>
HWY_INLINE void sum_products(const float* points, std::size_t center, std::span<const std::uint32_t> neighbors,
                             std::size_t lane, Sums& sums) {
  const hn::FixedTag<float, 4> d;
  alignas(16) static constexpr std::int32_t kNextAxis[4] = {1, 2, 0, 3};
  const auto next_axis = hn::SetTableIndices(d, kNextAxis);
  const auto p = hn::IfThenElseZero(hn::FirstN(d, 3), hn::Load(d, points + 4 * center));
  auto offsets = hn::Zero(d), squares = hn::Zero(d), products = hn::Zero(d);
  for (const std::uint32_t n : neighbors) {
    auto offset = hn::Sub(hn::Load(d, points + 4 * std::size_t(n)), p);
    if constexpr (!kAllKept) offset = hn::Mul(offset, hn::Broadcast<3>(offset));
    offsets = hn::Add(offsets, offset);
    squares = hn::Add(squares, hn::Mul(offset, offset));
    products = hn::Add(products, hn::Mul(offset, hn::TableLookupLanes(offset, next_axis)));
  }
  hn::Store(offsets, d, sums.offsets + 4 * lane);
  hn::Store(squares, d, sums.squares + 4 * lane);
  hn::Store(products, d, sums.products + 4 * lane);
}
#endif

HWY_INLINE void write_counts(const Sums& sums, std::size_t first, std::size_t count, LocalCovariances& out) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    out.counts[first + lane] = std::uint8_t(std::int32_t(sums.offsets[4 * lane + 3]));
  }
}

HWY_INLINE void write_covariances(const Sums& sums, std::size_t first, std::size_t count, LocalCovariances& out) {
  const D d;
  Floats x, y, z, n, xx, yy, zz, xy, yz, xz, unused;
  hn::LoadInterleaved4(d, sums.offsets, x, y, z, n);
  hn::LoadInterleaved4(d, sums.squares, xx, yy, zz, unused);
  hn::LoadInterleaved4(d, sums.products, xy, yz, xz, unused);
  const Floats one = hn::Set(d, 1.0f), per_point = hn::Div(one, hn::Max(n, one));
  const Floats scale = hn::IfThenElseZero(hn::Gt(n, one), hn::Div(one, hn::Max(hn::Sub(n, one), one)));
  const Floats mean_x = hn::Mul(x, per_point), mean_y = hn::Mul(y, per_point), mean_z = hn::Mul(z, per_point);
  const auto valid = hn::FirstN(d, count);
  const auto write = [&](Floats sum, Floats a, Floats mean_b, std::vector<float>& to) HWY_ATTR {
    hn::BlendedStore(hn::Mul(scale, hn::Sub(sum, hn::Mul(a, mean_b))), valid, d, &to[first]);
  };
  write(xx, x, mean_x, out.xx);
  write(yy, y, mean_y, out.yy);
  write(zz, z, mean_z, out.zz);
  write(xy, x, mean_y, out.xy);
  write(yz, y, mean_z, out.yz);
  write(xz, x, mean_z, out.xz);
}

template <bool kAllKept>
void sum_rows(const float* points, const NeighborTable& neighbors, LocalCovariances& out) {
  Sums sums{};
  for (std::size_t first = 0; first < out.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, out.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
      sum_products<kAllKept>(points, first + lane, neighbors.neighbors(first + lane), lane, sums);
    }
    write_covariances(sums, first, count, out);
    write_counts(sums, first, count, out);
  }
}

void covariances_simd(const float* points, bool all_kept, const NeighborTable& neighbors, LocalCovariances& out) {
  if (all_kept) return sum_rows<true>(points, neighbors, out);
  sum_rows<false>(points, neighbors, out);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(covariances_simd);

const LocalCovariances& NeighborMoments::compute(const PointCloud& cloud, const NeighborTable& neighbors,
                                                 std::span<const std::uint8_t> keep) {
  if (neighbors.k > 0 && neighbors.size() != cloud.size()) throw Error("neighbors", "is not the table of this cloud");
  if (!keep.empty() && keep.size() != cloud.size())
    throw Error("keep", "must be empty or have an entry for each point");
  if (neighbors.k > 255) throw Error("neighbors", "more than 255 neighbours of a point");
  LocalCovariances& out = covariances_;
  for (std::vector<float>* v : {&out.xx, &out.yy, &out.zz, &out.xy, &out.yz, &out.xz}) v->resize(cloud.size());
  out.counts.resize(cloud.size());
  points_.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    const float kept = keep.empty() || keep[i] != 0 ? 1.0f : 0.0f;
    points_[i] = Eigen::Array4f(float(p.x()), float(p.y()), float(p.z()), kept);
  }
  const float* const points = points_.empty() ? nullptr : points_.front().data();
  HWY_DYNAMIC_DISPATCH(covariances_simd)(points, keep.empty(), neighbors, out);
  return out;
}

LocalCovariances local_covariances(const PointCloud& cloud, const NeighborTable& neighbors,
                                   std::span<const std::uint8_t> keep) {
  NeighborMoments moments;
  return moments.compute(cloud, neighbors, keep);
}

}  // namespace tilth
#endif
