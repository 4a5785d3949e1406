// How far away a scan point must be, seen from p, by its direction alone. In the vertical plane at azimuth D from p the
// foot of p is at height z and horizontal range rho cos D; so a ray of elevation e in it passes p at the distance
//   sqrt((rho sin D)^2 + (rho cos D sin e - z cos e)^2)       and nothing beyond 90 degrees is nearer than rho.
// Over all e >= low (or all e <= high) it is least at low (high), or where it vanishes; it grows with D.
#if defined(TILTH_SEARCH_DIRECTION_BOUND_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_DIRECTION_BOUND_INL
#undef TILTH_SEARCH_DIRECTION_BOUND_INL
#else
#define TILTH_SEARCH_DIRECTION_BOUND_INL
#endif

#include <hwy/highway.h>

#include <tilth/search/ring_layout.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr Elevation kZenith{1.5707964f, 1.0f, 0.0f}, kNadir{-1.5707964f, -1.0f, 0.0f};

/// Points of a scan, a lane each, with what their bounds need.
template <class D>
struct Queries {
  using Floats = hn::Vec<D>;
  static constexpr float kAngleSlack = 4e-6f;  // [rad] far above rounding, far below the step between two points

  Floats x, y, z, rho, slack, rho_squared;

  HWY_INLINE Queries(D d, const RingLayout& l, std::uint32_t slot)
      : x(hn::LoadU(d, &l.x[slot])), y(hn::LoadU(d, &l.y[slot])), z(hn::LoadU(d, &l.z[slot])) {
    const Floats squared = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    rho = hn::Sqrt(squared);
    slack = hn::Mul(rho, hn::Set(d, kAngleSlack));
    rho_squared = hn::Mul(squared, hn::Set(d, 0.9999f));
  }
};

/// Squared distance from each query to the points of `slot` (a lane each), rounded as everywhere in this room.
template <class D>
HWY_INLINE hn::Vec<D> squared_distance(D d, const Queries<D>& q, const RingLayout& l, std::uint32_t slot) {
  const auto dx = hn::Sub(hn::LoadU(d, &l.x[slot]), q.x);
  const auto dy = hn::Sub(hn::LoadU(d, &l.y[slot]), q.y);
  const auto dz = hn::Sub(hn::LoadU(d, &l.z[slot]), q.z);
  return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
}

/// How far p's foot at horizontal range `along` lies below `low` or above `high`; zero between them.
template <class D>
HWY_INLINE hn::Vec<D> off_elevation(D d, const Queries<D>& q, hn::Vec<D> along, const Elevation& low,
                                    const Elevation& high) {
  const auto below = hn::Sub(hn::Mul(along, hn::Set(d, low.sin)), hn::Mul(q.z, hn::Set(d, low.cos)));
  const auto above = hn::Sub(hn::Mul(q.z, hn::Set(d, high.cos)), hn::Mul(along, hn::Set(d, high.sin)));
  return hn::Max(hn::Max(below, above), hn::Zero(d));
}

/// Least squared distance to anything in the direction of `slot` (a lane each) or further round on that side, to 90
/// degrees and beyond; zero where that direction is not yet on that side. kSide 1: counterclockwise, -1: clockwise.
template <int kSide, class D>
HWY_INLINE hn::Vec<D> side_bound(D d, const Queries<D>& q, const RingLayout& l, std::uint32_t slot, const Ring* other) {
  const auto ux = hn::LoadU(d, &l.ux[slot]);
  const auto uy = hn::LoadU(d, &l.uy[slot]);
  const auto turned = hn::Sub(hn::Mul(q.x, uy), hn::Mul(q.y, ux));
  const auto across = hn::Sub(kSide > 0 ? turned : hn::Neg(turned), q.slack);
  const auto along = hn::Add(hn::Mul(q.x, ux), hn::Mul(q.y, uy));
  auto squared = hn::Mul(across, across);
  if (other != nullptr) {
    const auto off = off_elevation(d, q, along, other->low, other->high);
    squared = hn::Add(squared, hn::Mul(off, off));
  }
  const auto bound = hn::IfThenElse(hn::Gt(along, hn::Zero(d)), squared, q.rho_squared);
  return hn::IfThenElseZero(hn::Gt(across, hn::Zero(d)), bound);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
