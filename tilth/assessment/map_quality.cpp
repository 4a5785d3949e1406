#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include <tilth/assessment/map_quality.hpp>
#include <tilth/assessment/point_moments.hpp>
#include <tilth/core/voxel_table.hpp>

namespace tilth {
namespace {

constexpr double kCell = 0.4;      // [m]
constexpr double kFewest = 8;      // points of a cell
constexpr double kFlat = 0.1;      // least eigenvalue over the middle one, below which a cell holds a plane
constexpr double kLeast = 1e-8;    // [m^2] of an eigenvalue: a tenth of a millimetre squared
constexpr double kFarthest = 1e5;  // [m]

std::vector<PointMoments> moments_of(std::span<const Eigen::Vector3f> points) {
  VoxelTable table;
  std::vector<PointMoments> cells;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d p = point.cast<double>();
    if (!(p.cwiseAbs().maxCoeff() < kFarthest)) continue;
    const Eigen::Vector3i cell = voxel_of(p / kCell);
    const std::uint32_t number = table.insert(voxel_key(cell, 0));
    if (number == cells.size()) cells.emplace_back();
    cells[number].add(p - kCell * cell.cast<double>());
  }
  return cells;
}

double at_share(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

MapQuality quality_of(std::span<const Eigen::Vector3f> points) {
  MapQuality quality;
  std::vector<double> thickness;
  const double log_circle = std::log(2 * std::numbers::pi * std::numbers::e);
  for (const PointMoments& cell : moments_of(points)) {
    if (cell.count < kFewest) continue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(cell.covariance(), Eigen::EigenvaluesOnly);
    const Eigen::Vector3d spread = solver.eigenvalues().cwiseMax(kLeast);
    ++quality.cells;
    quality.entropy += 0.5 * (3 * log_circle + spread.array().log().sum());
    if (spread[0] > kFlat * spread[1]) continue;
    quality.plane_variance += spread[0];
    thickness.push_back(std::sqrt(spread[0]));
  }
  quality.planes = thickness.size();
  if (quality.cells > 0) quality.entropy /= double(quality.cells);
  if (thickness.empty()) return quality;
  quality.plane_variance /= double(thickness.size());
  quality.thickness_median = at_share(thickness, 0.5);
  quality.thickness_p90 = at_share(thickness, 0.9);
  return quality;
}

}  // namespace tilth
