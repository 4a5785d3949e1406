#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include <tilth/core/se3.hpp>
#include <tilth/localization/place_scale.hpp>

namespace tilth {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

struct ScaledPose {
  Pose T_map_lidar;
  double log_scale = 0.0;

  Eigen::Vector3d rotated(const Eigen::Vector3d& p) const { return std::exp(log_scale) * (T_map_lidar.linear() * p); }
};

struct NormalEquations {
  Matrix7d H = Matrix7d::Zero();
  Vector7d b = Vector7d::Zero();
  std::size_t pairs = 0;
};

/// One step from coarse to fine: surfaces, their voxels [m], and the width of the kernel [sigma].
struct ScaleStep {
  const PatchMap& map;
  double voxel, width;
};

/// Of every flat patch and its surface, within one voxel: rotation and translation in the map's axes about the sensor.
NormalEquations linearize(const SurfacePatches& query, const ScaledPose& S, const ScaleStep& at,
                          const SubmapOptions& options) {
  NormalEquations sum;
  for (const SurfacePatch& patch : query) {
    if (!patch.flat || patch.mean.norm() > options.range) continue;
    const Eigen::Vector3d normal = S.T_map_lidar.linear() * patch.normal, arm = S.rotated(patch.mean);
    const Eigen::Vector3d point = arm + S.T_map_lidar.translation();
    const MapSurface* surface = at.map.find(point, normal, true);
    if (surface == nullptr || normal.dot(surface->normal) < options.min_cosine) continue;
    if ((point - surface->mean).squaredNorm() > at.voxel * at.voxel) continue;
    const double sigma = std::sqrt(double(patch.thickness) + surface->variance + options.patch_variance);
    const double residual = surface->normal.dot(point - surface->mean) / sigma;
    const double outlying = residual * residual / (at.width * at.width);
    const double weight = 1 / ((1 + outlying) * (1 + outlying));
    Vector7d J;
    J << arm.cross(surface->normal), surface->normal, surface->normal.dot(arm);
    J /= sigma;
    sum.H += weight * J * J.transpose();
    sum.b += weight * residual * J;
    ++sum.pairs;
  }
  return sum;
}

}  // namespace

double scale_in_map(const SurfacePatches& query, const Submap& map, const Pose& T_map_lidar,
                    const SubmapOptions& options) {
  constexpr int kIterations = 10;
  constexpr std::size_t kLeastPairs = 30;
  constexpr double kPrior = 1e-2;  // weight of a size that stays: it decides only where nothing else tells
  ScaledPose S{T_map_lidar};
  const auto refine = [&](const ScaleStep& at) {
    for (int i = 0; i < kIterations; ++i) {
      NormalEquations sum = linearize(query, S, at, options);
      if (sum.pairs < kLeastPairs) return false;
      sum.H.diagonal().array() += kPrior;
      const Vector7d step = -sum.H.ldlt().solve(sum.b);
      const Vector6d turn = (Vector6d() << step.head<3>(), Eigen::Vector3d::Zero()).finished();
      S.T_map_lidar.linear() = exp(turn).linear() * S.T_map_lidar.linear();
      S.T_map_lidar.translation() += step.segment<3>(3);
      S.log_scale += step[6];
    }
    return true;
  };
  const bool matched = refine({map.coarse(), options.coarse_voxel, options.first_kernel_width}) &&
                       refine({map.fine(), options.fine_voxel, options.first_kernel_width}) &&
                       refine({map.fine(), options.fine_voxel, options.kernel_width});
  return matched ? std::exp(S.log_scale) : 1.0;
}

}  // namespace tilth
