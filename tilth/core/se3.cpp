#include <cmath>

#include <tilth/core/se3.hpp>

namespace tilth {
namespace {

constexpr double kSmallAngle = 1e-5;  // [rad]; below it the series are exact to double precision

struct RotationTerms {
  double a, b, c;  // sin(t)/t, (1 - cos t)/t^2, (t - sin t)/t^3
};

RotationTerms terms_of(double t) {
  if (t < kSmallAngle) return {1 - t * t / 6, 0.5 - t * t / 24, 1.0 / 6 - t * t / 120};
  return {std::sin(t) / t, (1 - std::cos(t)) / (t * t), (t - std::sin(t)) / (t * t * t)};
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double n = q.vec().norm();
  if (n < kSmallAngle) return 2 * q.vec() / q.w();
  return 2 * std::atan2(n, q.w()) / n * q.vec();
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

Pose exp(const Vector6d& xi) {
  const Eigen::Matrix3d W = skew(xi.head<3>());
  const RotationTerms k = terms_of(xi.head<3>().norm());
  Pose T = Pose::Identity();
  T.linear() += k.a * W + k.b * W * W;
  T.translation() = xi.tail<3>() + k.b * W * xi.tail<3>() + k.c * W * (W * xi.tail<3>());
  return T;
}

Vector6d log(const Pose& T) {
  const Eigen::Vector3d w = rotation_log(T.linear());
  const double t = w.norm();
  const Eigen::Matrix3d W = skew(w);
  const RotationTerms k = terms_of(t);
  const double d = t < 1e-3 ? 1.0 / 12 + t * t / 720 : (1 - k.a / (2 * k.b)) / (t * t);
  Vector6d xi;
  xi << w, T.translation() - 0.5 * W * T.translation() + d * W * (W * T.translation());
  return xi;
}

Matrix6d adjoint(const Pose& T) {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = T.linear();
  A.bottomLeftCorner<3, 3>() = skew(T.translation()) * T.linear();
  return A;
}

Pose normalized(const Pose& T) {
  Pose N = T;
  N.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return N;
}

Pose retract(const Pose& T, const Vector6d& xi) {
  return normalized(T * exp(xi));
}

double angle_of(const Pose& T) {
  return rotation_log(T.linear()).norm();
}

Pose interpolate(const Pose& a, const Pose& b, double s) {
  return normalized(a * exp(s * log(a.inverse(Eigen::Isometry) * b)));
}

}  // namespace tilth
