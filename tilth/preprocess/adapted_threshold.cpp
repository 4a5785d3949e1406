#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/preprocess/adapted_threshold.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/preprocess/adapted_threshold.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using Doubles = hn::Vec<D>;
using F = hn::Rebind<float, D>;  // as many

/// The sum of visit(value) over all values, in as many parts as there are lanes.
template <class Visit>
HWY_INLINE double sum_over(std::span<const float> values, const Visit& visit) {
  const D d;
  const hn::Rebind<float, D> half;
  const std::size_t lanes = hn::Lanes(d), whole = values.size() / lanes * lanes;
  Doubles sums = hn::Zero(d);
  for (std::size_t i = 0; i < whole; i += lanes)
    sums = hn::Add(sums, visit(hn::PromoteTo(d, hn::LoadU(half, values.data() + i))));
  if (whole < values.size()) {
    const auto rest = hn::FirstN(half, values.size() - whole);
    const Doubles last = visit(hn::PromoteTo(d, hn::MaskedLoad(rest, half, values.data() + whole)));
    sums = hn::Add(sums, hn::IfThenElseZero(hn::FirstN(d, values.size() - whole), last));
  }
  return hn::GetLane(hn::SumOfLanes(d, sums));
}

Spread spread_simd(std::span<const float> values) {
  if (values.empty()) return {};
  const D d;
  const double n = double(values.size());
  const double mean = sum_over(values, [](Doubles v) HWY_ATTR { return v; }) / n;
  const Doubles means = hn::Set(d, mean);
  const double squares = sum_over(values, [&](Doubles v) HWY_ATTR {
    const Doubles off = hn::Sub(v, means);
    return hn::Mul(off, off);
  });
  return {mean, std::sqrt(squares / std::max(1.0, n - 1))};
}

void densities_simd(const NeighborTable& table, std::span<const float> scale, std::span<float> rho) {
  const hn::ScalableTag<float> f;
  const std::size_t n = table.size(), lanes = hn::Lanes(f);
  for (std::size_t i = 0; i < n; ++i) rho[i] = table.squared_distances[i * table.k + table.k - 1];
  const auto k_over_unit_ball = hn::Set(f, float(double(table.k) / (4.0 / 3.0 * std::numbers::pi)));
  const auto least = hn::Set(f, 1e-6f), one = hn::Set(f, 1.0f);
  for (std::size_t i = 0; i < n; i += lanes) {
    const auto valid = hn::FirstN(f, n - i);
    const auto squared = hn::MaskedLoad(valid, f, &rho[i]);
    const auto unit = scale.empty() ? one : hn::MaskedLoad(valid, f, &scale[i]);
    const auto radius = hn::Max(hn::Mul(hn::Sqrt(squared), unit), least);
    hn::BlendedStore(hn::Div(k_over_unit_ball, hn::Mul(hn::Mul(radius, radius), radius)), valid, f, &rho[i]);
  }
}

HWY_INLINE Doubles density_term(Doubles x, const OutlierOptions& options) {
  const D d;
  const Doubles one = hn::Set(d, 1.0);
  const Doubles g = options.density == DensityTerm::inverse ? hn::Div(one, x) : hn::Sub(one, x);
  return hn::Min(hn::Max(g, hn::Set(d, options.density_min)), hn::Set(d, options.density_max));
}

void keep_simd(std::span<const float> means, const Spread& spread, std::span<const float> rho,
               const OutlierOptions& options, std::span<std::uint8_t> keep) {
  const D d;
  const F f;
  const hn::Rebind<std::int32_t, F> s;
  const hn::Rebind<std::uint8_t, F> bytes;
  const Doubles mean = hn::Set(d, spread.mean), width = hn::Set(d, options.alpha * spread.deviation);
  const Doubles rho_mean = hn::Set(d, spread_simd(rho).mean), one = hn::Set(d, 1.0);
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < means.size(); i += lanes) {
    const std::size_t count = std::min(lanes, means.size() - i);
    const auto valid = hn::FirstN(f, count);
    const Doubles density = hn::PromoteTo(d, hn::MaskedLoad(valid, f, &rho[i]));
    const Doubles term = density_term(hn::Div(density, rho_mean), options);
    const Doubles threshold = hn::Add(mean, hn::Mul(width, hn::Add(one, term)));
    const Doubles room = hn::Sub(threshold, hn::PromoteTo(d, hn::MaskedLoad(valid, f, &means[i])));
    const auto kept = hn::RebindMask(s, hn::Ge(hn::DemoteTo(f, room), hn::Zero(f)));
    std::uint8_t out[HWY_MAX_BYTES];
    hn::StoreU(hn::DemoteTo(bytes, hn::IfThenElseZero(kept, hn::Set(s, 1))), bytes, out);
    std::copy_n(out, count, &keep[i]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(spread_simd);
HWY_EXPORT(densities_simd);
HWY_EXPORT(keep_simd);

Spread spread_of(std::span<const float> values) {
  return HWY_DYNAMIC_DISPATCH(spread_simd)(values);
}

void densities(const NeighborTable& neighbors, std::span<const float> scale, std::span<float> rho) {
  HWY_DYNAMIC_DISPATCH(densities_simd)(neighbors, scale, rho);
}

void keep_below(std::span<const float> means, const Spread& spread, std::span<const float> rho,
                const OutlierOptions& options, std::span<std::uint8_t> keep) {
  HWY_DYNAMIC_DISPATCH(keep_simd)(means, spread, rho, options, keep);
}

}  // namespace tilth
#endif
