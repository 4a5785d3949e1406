#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <tilth/registration/continuous_time_system.hpp>

namespace tilth {
namespace {

// The upper triangle of a symmetric 6 x 6 matrix, row by row, in whole SIMD packets.
using Triangle = Eigen::Array<double, 24, 1>;

// What pairs say about the pose at the middle of the scan, and, times their levers, about the velocity: a point moves
// (time - middle) times as far with that.
struct SegmentSums {
  Triangle H = Triangle::Zero(), H1 = Triangle::Zero(), H2 = Triangle::Zero();
  Vector6d b = Vector6d::Zero(), b1 = Vector6d::Zero();
  double error = 0, weight = 0, squared_range = 0;

  void add(const Triangle& h, const Vector6d& g, double lever) {
    H += h;
    H1 += lever * h;
    H2 += (lever * lever) * h;
    b += g;
    b1 += lever * g;
  }
};

/// The upper triangle of the matrix with these entries.
template <class Entry>
Triangle upper(const Entry& entry) {
  Triangle h;
  for (int i = 0, k = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) h[k++] = entry(i, j);
  }
  h.tail<3>().setZero();
  return h;
}

Vector6d jacobian_of(const FlatPair& pair) {
  Vector6d J;
  J << pair.point.cross(pair.normal), pair.normal;
  return J;
}

void add(const FlatPair& pair, const RobustKernel& kernel, SegmentSums& sums) {
  const double squared = pair.residual * pair.residual * pair.information;
  const double weight = kernel.weight(squared), w = weight * pair.information;
  const Vector6d J = jacobian_of(pair), wJ = w * J;
  sums.add(upper([&](int i, int j) { return wJ[i] * J[j]; }), pair.residual * wJ, pair.lever);
  sums.error += 0.5 * weight * squared;
  sums.weight += weight;
  sums.squared_range += pair.point.squaredNorm();
}

void add(const ShapePair& pair, const Pose& T, const RobustKernel& kernel, SegmentSums& sums) {
  const Eigen::Matrix3d information = pair.joint_in_map.inverse();
  const double squared = pair.offset_in_map.dot(information * pair.offset_in_map);
  const double weight = kernel.weight(squared);
  const Eigen::Matrix<double, 3, 6> J = point_jacobian(T, pair.point);
  const Eigen::Matrix<double, 6, 3> Jt = weight * J.transpose() * information;
  const Matrix6d H = Jt * J;
  sums.add(upper(H), Jt * pair.offset_in_map, pair.lever);
  sums.error += 0.5 * weight * squared;
  sums.weight += weight;
  sums.squared_range += pair.point.squaredNorm();
}

Matrix6d whole(const Triangle& h) {
  Matrix6d H;
  for (int i = 0, k = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) H(i, j) = H(j, i) = h[k++];
  }
  return H;
}

struct PartSums {
  SegmentSums sums;
  std::size_t matches = 0;
};

// The part of the scan in which a pair with this lever was seen.
std::size_t part_of(double lever, const MotionInScan& motion) {
  constexpr int kParts = ScanVibration::kIntervals;
  return std::size_t(std::clamp(int(motion.ratio(lever) * kParts), 0, kParts - 1));
}

ContinuousTimeSystem system_of(const PartSums& part) {
  const SegmentSums& sums = part.sums;
  ContinuousTimeSystem system;
  system.pose = {whole(sums.H), sums.b, sums.error, sums.weight, sums.squared_range, part.matches};
  const Matrix6d H1 = whole(sums.H1);
  system.H << system.pose.H, H1, H1, whole(sums.H2);
  system.b << sums.b, sums.b1;
  return system;
}

}  // namespace

SegmentSystems linearize(const PatchPairs& pairs, const MotionState& state) {
  const RobustKernel kernel{Kernel::geman_mcclure, state.kernel_width};
  std::array<PartSums, ScanVibration::kIntervals> sums;
  for (const FlatPair& pair : pairs.flat) {
    PartSums& part = sums[part_of(pair.lever, state.motion)];
    add(pair, kernel, part.sums);
    ++part.matches;
  }
  for (const ShapePair& pair : pairs.shapes) {
    PartSums& part = sums[part_of(pair.lever, state.motion)];
    add(pair, state.T_map_lidar, kernel, part.sums);
    ++part.matches;
  }
  SegmentSystems parts;
  std::transform(sums.begin(), sums.end(), parts.begin(), system_of);
  return parts;
}

ContinuousTimeSystem sum_of(const SegmentSystems& parts) {
  ContinuousTimeSystem sum;
  for (const ContinuousTimeSystem& part : parts) {
    sum.pose.H += part.pose.H;
    sum.pose.b += part.pose.b;
    sum.pose.error += part.pose.error;
    sum.pose.weight += part.pose.weight;
    sum.pose.squared_range += part.pose.squared_range;
    sum.pose.matches += part.pose.matches;
    sum.H += part.H;
    sum.b += part.b;
  }
  return sum;
}

LinearSystem unweighted(const PatchPairs& pairs, const Pose& T_map_lidar) {
  Triangle H = Triangle::Zero();
  LinearSystem system;
  for (const FlatPair& pair : pairs.flat) {
    const Vector6d J = jacobian_of(pair), wJ = pair.information * J;
    H += upper([&](int i, int j) { return wJ[i] * J[j]; });
    system.squared_range += pair.point.squaredNorm();
  }
  for (const ShapePair& pair : pairs.shapes) {
    const Eigen::Matrix<double, 3, 6> J = point_jacobian(T_map_lidar, pair.point);
    H += upper(Matrix6d(J.transpose() * pair.joint_in_map.inverse() * J));
    system.squared_range += pair.point.squaredNorm();
  }
  system.H = whole(H);
  system.matches = pairs.size();
  return system;
}

}  // namespace tilth
