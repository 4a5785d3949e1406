#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include <tilth/core/error.hpp>
#include <tilth/recording/flat_cloud.hpp>
#include <tilth/recording/record_edit.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSample = 512, kFewestPoints = 10;
constexpr double kFlat = 1e-4;     ///< thickness beside the extent of the points: float32 has 1e-7
constexpr double kLevel = 1e-6;    ///< how far the normal of a level plane is from z
constexpr double kThrough = 1e-3;  ///< distance of the plane from (0, 0, 0) beside the extent

/// Whether all points lie in a plane that beams of one elevation draw: level, or through the sensor.
bool is_flat(const PointRecords& records) {
  const std::vector<Eigen::Vector3d> points = measured_sample(records, kSample);
  if (points.size() < kFewestPoints) return false;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / double(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose() / double(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const double extent = std::sqrt(solver.eigenvalues()[2]);
  if (std::sqrt(std::max(0.0, solver.eigenvalues()[0])) > kFlat * extent) return false;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return 1.0 - std::abs(normal.z()) < kLevel || std::abs(normal.dot(mean)) < kThrough * extent;
}

}  // namespace

void refuse_flat_clouds(std::span<const PointRecords> scans) {
  if (scans.empty() || !std::all_of(scans.begin(), scans.end(), is_flat)) return;
  throw Error("points",
              "of every scan lie in one plane, as those of a 2D laser scanner or of a flattened cloud. Tilth needs the "
              "3D cloud of a sensor with several beams: record that topic instead");
}

}  // namespace tilth
