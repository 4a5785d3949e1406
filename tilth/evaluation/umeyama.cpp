#include <cassert>
#include <string>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/umeyama.hpp>

namespace tilth {
namespace {

constexpr double kLeastSpread =
    1e-12;  // second singular value of the covariance to the first: the square of a millionth

Eigen::Vector3d mean_of(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / double(points.size());
}

}  // namespace

Similarity umeyama(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to, bool with_scale) {
  assert(from.size() == to.size());
  if (from.size() < 3) {
    throw Error("alignment", "needs at least 3 matching poses, not " + std::to_string(from.size()));
  }
  const Eigen::Vector3d mean_from = mean_of(from), mean_to = mean_of(to);  // (34), (35)
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();                    // (38), times n
  double variance = 0;                                                     // (36), times n
  for (std::size_t i = 0; i < from.size(); ++i) {
    covariance += (to[i] - mean_to) * (from[i] - mean_from).transpose();
    variance += (from[i] - mean_from).squaredNorm();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d d = svd.singularValues();
  if (!(d[1] > kLeastSpread * d[0])) {
    throw Error("alignment",
                "the positions lie in one place or on one line, which leaves the rotation open; align origin or none");
  }
  Eigen::Vector3d s = Eigen::Vector3d::Ones();  // (39), (43): a rotation, never a reflection
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) s.z() = -1;

  Similarity result;
  result.rotation = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();  // (40)
  if (with_scale) result.scale = d.dot(s) / variance;                            // (42)
  result.translation = mean_to - result.scale * result.rotation * mean_from;     // (41)
  return result;
}

}  // namespace tilth
