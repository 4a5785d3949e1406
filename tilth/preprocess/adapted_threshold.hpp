// The threshold of statistical outlier removal that adapts to the density about a point (Fu et al. 2026, section 2.3),
// for as many points at once as the processor has lanes (Highway). Nothing is allocated. O(n).
#pragma once

#include <cstdint>
#include <span>

#include <tilth/preprocess/outlier_removal.hpp>

namespace tilth {

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;  ///< square root of the sum of squares over n - 1
};

/// Of values, of which there may be none.
Spread spread_of(std::span<const float> values);

/// rho_i = k / volume of the ball that holds the k neighbours of point i, distances multiplied by scale_i. `scale` is
/// empty (all 1) or has one a point, as has `rho`.
void densities(const NeighborTable& neighbors, std::span<const float> scale, std::span<float> rho);

/// keep_i = means_i <= mean + alpha deviation (1 + g(rho_i / mean of rho)), with the density term g of the options.
void keep_below(std::span<const float> means, const Spread& spread, std::span<const float> rho,
                const OutlierOptions& options, std::span<std::uint8_t> keep);

}  // namespace tilth
