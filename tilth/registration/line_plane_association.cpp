#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <tilth/registration/line_plane_association.hpp>

namespace tilth {
namespace {

constexpr double kWeightSlope = 0.9;  // [1/m]
constexpr double kLeastWeight = 0.1;

Eigen::Vector3d mean_of(const FitPoints& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / double(kFitPoints);
}

// 1 - 0.9 distance, in (0.1, 1]; none below.
std::optional<double> weight_at(double distance, PairWeight weight) {
  if (weight == PairWeight::equal) return 1.0;
  const double w = 1 - kWeightSlope * distance;
  return w > kLeastWeight ? std::optional(w) : std::nullopt;
}

}  // namespace

std::optional<FittedLine> fit_line(const FitPoints& points, double ratio) {
  const Eigen::Vector3d mean = mean_of(points);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  if (!(eigen.eigenvalues()[2] > ratio * eigen.eigenvalues()[1])) return std::nullopt;
  return FittedLine{mean, eigen.eigenvectors().col(2)};
}

std::optional<FittedPlane> fit_plane(const FitPoints& points, const Eigen::Vector3d& origin, double max_distance) {
  Eigen::Matrix<double, kFitPoints, 3> A;
  for (std::size_t k = 0; k < kFitPoints; ++k) A.row(Eigen::Index(k)) = points[k] - origin;
  const Eigen::Vector3d n = A.colPivHouseholderQr().solve(-Eigen::Matrix<double, kFitPoints, 1>::Ones());
  const double norm = n.norm();
  const double farthest = ((A * n).array() + 1).abs().maxCoeff() / norm;
  if (!(farthest <= max_distance)) return std::nullopt;
  return FittedPlane{origin - n / (norm * norm), n / norm};
}

std::optional<PointToLine> weighed(const Eigen::Vector3d& source, const FittedLine& line, const Pose& T,
                                   PairWeight weight) {
  PointToLine pair{source, line.point, line.direction};
  const std::optional<double> w = weight_at(pair.residual(T).norm(), weight);
  if (!w) return std::nullopt;
  pair.direction *= *w;
  return pair;
}

std::optional<PointToPlane> weighed(const Eigen::Vector3d& source, const FittedPlane& plane, const Pose& T,
                                    PairWeight weight) {
  PointToPlane pair{source, plane.point, plane.normal};
  const double distance = std::abs(pair.residual(T)[0]);
  const std::optional<double> w = weight_at(distance / std::sqrt(source.norm()), weight);
  if (!w) return std::nullopt;
  pair.normal *= *w;
  return pair;
}

}  // namespace tilth
