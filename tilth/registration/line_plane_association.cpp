#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <tilth/registration/line_plane_association.hpp>

namespace tilth {
namespace {

constexpr double kLeastWeight = 0.1;

Eigen::Vector3d mean_of(const FitPoints& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / double(kFitPoints);
}

// `pair`, its residual scaled by 1 - slope distance; none where that is too little.
template <class Pair>
std::optional<Pair> scaled(Pair pair, Eigen::Vector3d Pair::*axis, const Pose& T, double slope) {
  if (slope == 0) return pair;
  const double weight = 1 - slope * pair.residual(T).norm();
  if (!(weight > kLeastWeight)) return std::nullopt;
  pair.*axis *= weight;
  return pair;
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

std::optional<PointToLine> weighed(const Eigen::Vector3d& source, const FittedLine& line, const Pose& T, double slope) {
  return scaled(PointToLine{source, line.point, line.direction}, &PointToLine::direction, T, slope);
}

std::optional<PointToPlane> weighed(const Eigen::Vector3d& source, const FittedPlane& plane, const Pose& T,
                                    double slope) {
  return scaled(PointToPlane{source, plane.point, plane.normal}, &PointToPlane::normal, T, slope);
}

}  // namespace tilth
