#include <algorithm>

#include <tilth/core/symmetric_eigen.hpp>
#include <tilth/features/joined_shapes.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/features/joined_shapes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using Doubles = hn::Vec<D>;

constexpr std::size_t kLanes = HWY_LANES(double), kSums = 10;

/// Moments, a set a lane: as Moments::add(), and after normalize() as Moments::covariance().
struct LaneMoments {
  Doubles count, x, y, z, xx, yy, zz, xy, yz, xz;

  HWY_INLINE explicit LaneMoments(const double* sums) {
    const D d;
    Doubles* const all[kSums] = {&count, &x, &y, &z, &xx, &yy, &zz, &xy, &yz, &xz};
    HWY_UNROLL(10) for (std::size_t i = 0; i < kSums; ++i) * all[i] = hn::Load(d, sums + i * kLanes);
  }

  HWY_INLINE void add(const LaneMoments& other) {
    const Doubles total = hn::Add(count, other.count), ratio = hn::Div(other.count, total);
    const Doubles dx = hn::Sub(other.x, x), dy = hn::Sub(other.y, y), dz = hn::Sub(other.z, z);
    const Doubles weight = hn::Mul(count, ratio);
    const auto grow = [&](Doubles& sum, Doubles more, Doubles product)
                          HWY_ATTR { sum = hn::Add(sum, hn::Add(more, hn::Mul(weight, product))); };
    grow(xx, other.xx, hn::Mul(dx, dx)), grow(yy, other.yy, hn::Mul(dy, dy)), grow(zz, other.zz, hn::Mul(dz, dz));
    grow(xy, other.xy, hn::Mul(dx, dy)), grow(yz, other.yz, hn::Mul(dy, dz)), grow(xz, other.xz, hn::Mul(dz, dx));
    x = hn::Add(x, hn::Mul(dx, ratio)), y = hn::Add(y, hn::Mul(dy, ratio)), z = hn::Add(z, hn::Mul(dz, ratio));
    count = total;
  }

  /// Divides by the number of points, less one.
  HWY_INLINE void normalize() {
    const Doubles one = hn::Set(D(), 1.0), per_point = hn::Div(one, hn::Max(one, hn::Sub(count, one)));
    Doubles* const all[6] = {&xx, &yy, &zz, &xy, &yz, &xz};
    HWY_UNROLL(6) for (std::size_t i = 0; i < 6; ++i) * all[i] = hn::Mul(*all[i], per_point);
  }
};

/// The three eigenvalues of covariances, a matrix a lane: as eigenvalues() of one.
struct LaneEigenvalues {
  Doubles trace, minors, determinant;  // of the characteristic polynomial

  HWY_INLINE explicit LaneEigenvalues(const LaneMoments& c) {
    const Doubles m0 = hn::Sub(hn::Mul(c.yy, c.zz), hn::Mul(c.yz, c.yz));
    const Doubles m1 = hn::Sub(hn::Mul(c.xx, c.zz), hn::Mul(c.xz, c.xz));
    const Doubles m2 = hn::Sub(hn::Mul(c.xx, c.yy), hn::Mul(c.xy, c.xy));
    trace = hn::Add(hn::Add(c.xx, c.yy), c.zz);
    minors = hn::Add(hn::Add(m0, m1), m2);
    const Doubles second = hn::Mul(c.xy, hn::Sub(hn::Mul(c.xy, c.zz), hn::Mul(c.yz, c.xz)));
    const Doubles third = hn::Mul(c.xz, hn::Sub(hn::Mul(c.xy, c.yz), hn::Mul(c.yy, c.xz)));
    determinant = hn::Add(hn::Sub(hn::Mul(c.xx, m0), second), third);
  }

  HWY_INLINE Doubles laguerre_step(Doubles x) const {
    const auto times = [](double factor, Doubles v) HWY_ATTR { return hn::Mul(hn::Set(D(), factor), v); };
    const Doubles zero = hn::Zero(D());
    const Doubles value = hn::Sub(hn::Mul(hn::Add(hn::Mul(hn::Sub(x, trace), x), minors), x), determinant);
    const Doubles slope = hn::Add(hn::Mul(hn::Sub(times(3, x), times(2, trace)), x), minors);
    const Doubles curve = hn::Sub(times(6, x), times(2, trace));
    const Doubles square = hn::Sub(hn::Mul(times(4, slope), slope), hn::Mul(times(6, value), curve));
    const Doubles divisor = hn::Add(slope, hn::Sqrt(hn::Max(square, zero)));
    return hn::IfThenElseZero(hn::Gt(divisor, zero), hn::Div(times(-3, value), divisor));
  }

  HWY_INLINE Doubles least() const {
    const Doubles still = hn::Set(D(), kEigenvalueTolerance);
    Doubles x = hn::Zero(D());
    auto open = hn::Eq(x, x);
    for (int i = 0; i < kMostEigenvalueSteps && !hn::AllFalse(D(), open); ++i) {
      const Doubles step = hn::IfThenElseZero(open, laguerre_step(x));
      x = hn::Add(x, step);
      open = hn::AndNot(hn::Le(hn::Abs(step), hn::Mul(still, x)), open);
    }
    return x;
  }

  HWY_INLINE void store(double* variances) const {
    const Doubles first = least(), half_sum = hn::Mul(hn::Set(D(), 0.5), hn::Sub(trace, first));
    const Doubles product = hn::Sub(minors, hn::Mul(hn::Mul(hn::Set(D(), 2.0), first), half_sum));
    const Doubles half_difference = hn::Sqrt(hn::Max(hn::Zero(D()), hn::Sub(hn::Mul(half_sum, half_sum), product)));
    hn::Store(first, D(), variances);
    hn::Store(hn::Sub(half_sum, half_difference), D(), variances + kLanes);
    hn::Store(hn::Add(half_sum, half_difference), D(), variances + 2 * kLanes);
  }
};

HWY_INLINE void put_in_lane(const Moments& m, std::size_t lane, double* sums) {
  sums[lane] = m.count;
  for (std::size_t i = 0; i < 3; ++i) sums[(1 + i) * kLanes + lane] = m.mean[Eigen::Index(i)];
  for (std::size_t i = 0; i < 6; ++i) sums[(4 + i) * kLanes + lane] = m.scatter.entries[Eigen::Index(i)];
}

/// The first `count` lanes.
void write(const LaneMoments& c, const LaneEigenvalues& eigenvalues, std::size_t count, PlaneShape* shapes) {
  const D d;
  HWY_ALIGN double entries[6 * kLanes], variances[3 * kLanes];
  const Doubles* const all[6] = {&c.xx, &c.yy, &c.zz, &c.xy, &c.yz, &c.xz};
  HWY_UNROLL(6) for (std::size_t i = 0; i < 6; ++i) hn::Store(*all[i], d, entries + i * kLanes);
  eigenvalues.store(variances);
  for (std::size_t lane = 0; lane < count; ++lane) {
    for (std::size_t i = 0; i < 6; ++i) shapes[lane].covariance.entries[Eigen::Index(i)] = entries[i * kLanes + lane];
    for (std::size_t i = 0; i < 3; ++i) shapes[lane].variances[Eigen::Index(i)] = variances[i * kLanes + lane];
  }
}

void join_simd(std::span<const RunSet> sets, PlaneShape* shapes) {
  const Moments none;  // adds nothing
  HWY_ALIGN double sums[3][kSums * kLanes];
  for (std::size_t first = 0; first < sets.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, sets.size() - first);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const RunSet& set = sets[first + std::min(lane, count - 1)];
      for (std::size_t i = 0; i < set.size(); ++i) put_in_lane(set[i] ? *set[i] : none, lane, sums[i]);
    }
    LaneMoments joined(sums[0]);
    joined.add(LaneMoments(sums[1]));
    joined.add(LaneMoments(sums[2]));
    joined.normalize();
    write(joined, LaneEigenvalues(joined), count, shapes + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(join_simd);

void join_runs(std::span<const RunSet> sets, std::span<PlaneShape> shapes) {
  HWY_DYNAMIC_DISPATCH(join_simd)(sets, shapes.data());
}

}  // namespace tilth
#endif
