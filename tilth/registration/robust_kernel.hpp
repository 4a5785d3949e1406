// Robust kernels: the weight of a pair by its squared residual, so that wrong pairs lose their say.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace tilth {

enum class Kernel { none, huber, cauchy, geman_mcclure };
inline std::span<const std::string_view> names_of(Kernel) {
  static constexpr std::array<std::string_view, 4> names{"none", "huber", "cauchy", "geman_mcclure"};
  return names;
}

struct RobustKernel {
  Kernel kind = Kernel::none;
  double width = 1.0;  ///< in units of the residual

  /// Factor on the pair's normal equations (iteratively re-weighted least squares), in (0, 1]; Geman-McClure's:
  /// docs/method.md, 7.
  double weight(double squared_residual) const {
    const double s = squared_residual / (width * width);
    switch (kind) {
      case Kernel::none: return 1.0;
      case Kernel::huber: return s <= 1 ? 1.0 : 1.0 / std::sqrt(s);
      case Kernel::cauchy: return 1.0 / (1.0 + s);
      case Kernel::geman_mcclure: return 1.0 / ((1.0 + s) * (1.0 + s));
    }
    return 1.0;
  }
};

}  // namespace tilth
