#include <tilth/features/curvature.hpp>
#include <tilth/features/row_scan.hpp>

namespace tilth {
namespace {

std::vector<double> of_ranges(std::span<const Eigen::Vector3d> ring) {
  std::vector<float> ranges;
  ranges.reserve(ring.size());
  for (const Eigen::Vector3d& p : ring) ranges.push_back(float(p.norm()));
  return range_curvature(ranges);
}

}  // namespace

std::vector<double> curvature(std::span<const Eigen::Vector3d> ring, Curvature formula) {
  if (formula == Curvature::lio_sam) return of_ranges(ring);
  std::vector<double> values(ring.size(), 0.0);
  for (std::size_t i = kCurvatureMargin; i + kCurvatureMargin < ring.size(); ++i) {
    Eigen::Vector3d d = -(2.0 * kCurvatureMargin + 1) * ring[i];
    for (std::size_t k = i - kCurvatureMargin; k <= i + kCurvatureMargin; ++k) d += ring[k];
    values[i] = formula == Curvature::floam ? d.squaredNorm() : d.norm() / (2.0 * kCurvatureMargin * ring[i].norm());
  }
  return values;
}

}  // namespace tilth
