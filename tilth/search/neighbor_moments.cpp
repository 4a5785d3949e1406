#include <algorithm>

#include <tilth/core/error.hpp>
#include <tilth/search/neighbor_moments.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/search/neighbor_moments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TILTH_SEARCH_MOMENT_INPUT
#define TILTH_SEARCH_MOMENT_INPUT
namespace tilth {
/// Points as float, padded with a copy of the last so that a whole vector may be read anywhere; weights are 1 (kept) or
/// 0.
struct MomentInput {
  std::vector<float> x, y, z, weight;
};
}  // namespace tilth
#endif

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

/// Sums of weights, offsets from the point and their products, for a vector of points.
struct Sums {
  V n, x, y, z, xx, xy, xz, yy, yz, zz;

  HWY_INLINE Sums() { n = x = y = z = xx = xy = xz = yy = yz = zz = hn::Zero(D()); }

  HWY_INLINE void add(V w, V dx, V dy, V dz) {
    const V wx = hn::Mul(w, dx), wy = hn::Mul(w, dy), wz = hn::Mul(w, dz);
    n = hn::Add(n, w);
    x = hn::Add(x, wx);
    y = hn::Add(y, wy);
    z = hn::Add(z, wz);
    xx = hn::Add(xx, hn::Mul(wx, dx));
    xy = hn::Add(xy, hn::Mul(wx, dy));
    xz = hn::Add(xz, hn::Mul(wx, dz));
    yy = hn::Add(yy, hn::Mul(wy, dy));
    yz = hn::Add(yz, hn::Mul(wy, dz));
    zz = hn::Add(zz, hn::Mul(wz, dz));
  }
};

// Writes the covariances of `lanes` points from point i on.
HWY_INLINE void finish(const Sums& s, std::size_t i, std::size_t lanes, LocalCovariances& out) {
  const D d;
  const V one = hn::Set(d, 1.0f);
  const V mean = hn::Div(one, hn::Max(s.n, one));
  const V scale = hn::IfThenElseZero(hn::Gt(s.n, one), hn::Div(one, hn::Max(hn::Sub(s.n, one), one)));
  const auto write = [&](V product, V a, V b, float* to) HWY_ATTR {
    HWY_ALIGN float values[HWY_LANES(float)];
    hn::Store(hn::Mul(scale, hn::Sub(product, hn::Mul(hn::Mul(a, b), mean))), d, values);
    std::copy_n(values, lanes, to + i);
  };
  write(s.xx, s.x, s.x, out.xx.data());
  write(s.xy, s.x, s.y, out.xy.data());
  write(s.xz, s.x, s.z, out.xz.data());
  write(s.yy, s.y, s.y, out.yy.data());
  write(s.yz, s.y, s.z, out.yz.data());
  write(s.zz, s.z, s.z, out.zz.data());
  HWY_ALIGN float counts[HWY_LANES(float)];
  hn::Store(s.n, d, counts);
  for (std::size_t lane = 0; lane < lanes; ++lane) out.counts[i + lane] = std::uint8_t(counts[lane]);
}

void moments_simd(const MomentInput& in, const NeighborTable& table, LocalCovariances& out) {
  const D d;
  const hn::RebindToSigned<D> di;
  constexpr std::size_t kLanes = HWY_LANES(float);
  const std::size_t n = table.size();
  const auto* const indices = reinterpret_cast<const std::int32_t*>(table.indices.data());
  HWY_ALIGN std::int32_t rows[kLanes];
  for (std::size_t i = 0; i < n; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) rows[lane] = std::int32_t(std::min(lane, n - 1 - i) * table.k);
    const auto row = hn::Load(di, rows);
    const V x = hn::LoadU(d, &in.x[i]), y = hn::LoadU(d, &in.y[i]), z = hn::LoadU(d, &in.z[i]);
    Sums sums;
    for (std::size_t j = 0; j < table.k; ++j) {
      const auto q = hn::GatherIndex(di, indices + i * table.k + j, row);
      const V dx = hn::Sub(hn::GatherIndex(d, in.x.data(), q), x), dy = hn::Sub(hn::GatherIndex(d, in.y.data(), q), y);
      const V dz = hn::Sub(hn::GatherIndex(d, in.z.data(), q), z);
      sums.add(hn::GatherIndex(d, in.weight.data(), q), dx, dy, dz);
    }
    finish(sums, i, std::min(kLanes, n - i), out);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {
namespace {

HWY_EXPORT(moments_simd);

constexpr std::size_t kWidestVector = 64;  // lanes of any instruction set

MomentInput moment_input(const PointCloud& cloud, std::span<const std::uint8_t> keep) {
  MomentInput in;
  for (std::vector<float>* v : {&in.x, &in.y, &in.z, &in.weight}) v->resize(cloud.size() + kWidestVector);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    in.x[i] = float(cloud.points[i].x());
    in.y[i] = float(cloud.points[i].y());
    in.z[i] = float(cloud.points[i].z());
    in.weight[i] = keep.empty() || keep[i] != 0 ? 1.0f : 0.0f;
  }
  return in;
}

}  // namespace

LocalCovariances local_covariances(const PointCloud& cloud, const NeighborTable& neighbors,
                                   std::span<const std::uint8_t> keep) {
  if (neighbors.k > 0 && neighbors.size() != cloud.size()) throw Error("neighbors", "is not the table of this cloud");
  if (!keep.empty() && keep.size() != cloud.size())
    throw Error("keep", "must be empty or have an entry for each point");
  if (neighbors.k > 255) throw Error("neighbors", "more than 255 neighbours of a point");
  LocalCovariances out;
  for (std::vector<float>* v : {&out.xx, &out.xy, &out.xz, &out.yy, &out.yz, &out.zz}) v->resize(cloud.size());
  out.counts.resize(cloud.size());
  if (neighbors.k > 0) HWY_DYNAMIC_DISPATCH(moments_simd)(moment_input(cloud, keep), neighbors, out);
  return out;
}

}  // namespace tilth
#endif
