#include <algorithm>
#include <limits>

#include <tilth/search/ring_directions.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/search/ring_directions.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Azimuth as an angle of the square |x| + |y| = 1: monotone, in [0, 4].
template <class D>
HWY_INLINE hn::Vec<D> pseudo_angle(D d, hn::Vec<D> ux, hn::Vec<D> uy) {
  const auto t = hn::Div(ux, hn::Add(hn::Abs(ux), hn::Abs(uy)));
  const auto upper = hn::Sub(hn::Set(d, 1.0f), t), lower = hn::Add(hn::Set(d, 3.0f), t);
  return hn::IfThenElse(hn::Ge(uy, hn::Zero(d)), upper, lower);
}

void count_descents(const float* azimuth, std::uint32_t count, RingDirections& result) {
  const hn::ScalableTag<float> d;
  const std::uint32_t lanes = std::uint32_t(hn::Lanes(d));
  for (std::uint32_t i = 1; i < count; i += lanes) {
    const auto falls = hn::Lt(hn::LoadU(d, azimuth + i), hn::LoadU(d, azimuth + i - 1));
    if (hn::AllFalse(d, hn::And(falls, hn::FirstN(d, count - i)))) continue;
    for (std::uint32_t j = i; j < std::min(count, i + lanes); ++j) {
      if (azimuth[j] < azimuth[j - 1]) ++result.descents, result.last_descent = j;
    }
  }
}

RingDirections measure_simd(RingLayout& l, const Ring& ring) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const V one = hn::Set(d, 1.0f), zero = hn::Zero(d), infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  const V smallest = hn::Set(d, 1e-12f);  // [m] nearer to the axis there is no azimuth
  V low = infinity, high = hn::Neg(infinity);
  RingDirections result;
  for (std::uint32_t i = 0; i < ring.count; i += std::uint32_t(hn::Lanes(d))) {
    const std::uint32_t s = ring.begin + i;
    const V x = hn::LoadU(d, &l.x[s]), y = hn::LoadU(d, &l.y[s]), z = hn::LoadU(d, &l.z[s]);
    const V rho = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const auto valid = hn::FirstN(d, ring.count - i), axis = hn::Lt(rho, smallest);
    const V inverse = hn::Div(one, hn::Max(rho, smallest));
    const V ux = hn::IfThenElse(axis, one, hn::Mul(x, inverse)),
            uy = hn::IfThenElseZero(hn::Not(axis), hn::Mul(y, inverse));
    hn::StoreU(ux, d, &l.ux[s]);
    hn::StoreU(uy, d, &l.uy[s]);
    hn::StoreU(pseudo_angle(d, ux, uy), d, &l.azimuth[s]);
    result.on_axis += std::uint32_t(hn::CountTrue(d, hn::And(axis, valid)));
    const V slope = hn::Mul(z, inverse);
    const auto seen = hn::AndNot(hn::And(axis, hn::Eq(z, zero)), valid);
    low = hn::Min(low, hn::IfThenElse(seen, slope, infinity));
    high = hn::Max(high, hn::IfThenElse(seen, slope, hn::Neg(infinity)));
  }
  result.lowest_slope = hn::GetLane(hn::MinOfLanes(d, low));
  result.highest_slope = hn::GetLane(hn::MaxOfLanes(d, high));
  count_descents(&l.azimuth[ring.begin], ring.count, result);
  return result;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(measure_simd);

RingDirections measure_directions(RingLayout& layout, const Ring& ring) {
  return HWY_DYNAMIC_DISPATCH(measure_simd)(layout, ring);
}

}  // namespace tilth
#endif
