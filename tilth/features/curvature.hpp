// How much a ring bends at each of its points, by the formulas of the LOAM family. O(points).
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace tilth {

/// With d = sum of (p_k - p) over the five points p_k before and the five after p, and r the range of each:
/// floam: |d|^2 [m^2]; loam: |d| / (10 |p|) [-] (Zhang and Singh 2014, equation 1); lio_sam: (sum of (r_k - r))^2
/// [m^2], LeGO-LOAM's too.
enum class Curvature { floam, loam, lio_sam };
inline std::span<const std::string_view> names_of(Curvature) {
  static constexpr std::array<std::string_view, 3> names{"floam", "loam", "lio_sam"};
  return names;
}

/// Neighbours on either side.
constexpr std::size_t kCurvatureMargin = 5;

/// The curvature at each point of a ring, given in the order of firing; 0 for the first and last five.
std::vector<double> curvature(std::span<const Eigen::Vector3d> ring, Curvature formula);

}  // namespace tilth
