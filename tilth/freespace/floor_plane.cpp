#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>

#include <tilth/freespace/floor_plane.hpp>

namespace tilth {
namespace {

constexpr int kSamples = 500;
constexpr int kRefinements = 5;
constexpr double kReach = 15;         // [m] from the sensor: farther off the ground need not be that plane
constexpr double kLeastDepth = 0.05;  // [m] below the sensor
constexpr double kNear = 0.05;        // [m] from the plane: a point lies in it
constexpr double kBelow = 0.2;        // [m] below the plane: a point lies under it
constexpr double kMostBelow = 0.1;    // of the points in the plane: more under it, and it is no floor
constexpr std::size_t kLeastPoints = 200;
constexpr double kLeastSpread = 0.4;  // [m] standard deviation in either direction
const double kMostTilt = std::cos(std::numbers::pi / 4);

using Points = std::vector<Eigen::Vector3d>;

/// normal . p = offset
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;
  double above(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

Points around(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& sensor) {
  Points near;
  std::copy_if(points.begin(), points.end(), std::back_inserter(near),
               [&](const Eigen::Vector3d& p) { return (p - sensor).norm() < kReach; });
  return near;
}

std::optional<Plane> upwards(Eigen::Vector3d normal, const Eigen::Vector3d& through, const Eigen::Vector3d& sensor) {
  if (!(normal.norm() > 1e-6)) return std::nullopt;
  normal.normalize();
  if (normal.z() < 0) normal = -normal;
  const Plane plane{normal, normal.dot(through)};
  if (normal.z() < kMostTilt || plane.above(sensor) < kLeastDepth) return std::nullopt;
  return plane;
}

Points in_plane(const Points& points, const Plane& plane) {
  Points in;
  std::copy_if(points.begin(), points.end(), std::back_inserter(in),
               [&](const Eigen::Vector3d& p) { return std::abs(plane.above(p)) < kNear; });
  return in;
}

std::optional<Plane> widest(const Points& points, const Eigen::Vector3d& sensor) {
  std::uint64_t random = 1;  // a linear congruential generator, with the constants of Knuth's MMIX
  const auto any = [&]() -> const Eigen::Vector3d& {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    return points[(random >> 33) % points.size()];
  };
  std::optional<Plane> best;
  std::ptrdiff_t most = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d &a = any(), &b = any(), &c = any();
    const std::optional<Plane> plane = upwards((b - a).cross(c - a), a, sensor);
    if (!plane) continue;
    const std::ptrdiff_t in = std::count_if(
        points.begin(), points.end(), [&](const Eigen::Vector3d& p) { return std::abs(plane->above(p)) < kNear; });
    if (in > most) best = plane, most = in;
  }
  return best;
}

/// Mean, and eigenvalues [m^2] with eigenvectors of the spread.
struct PlaneSpread {
  explicit PlaneSpread(const Points& points) {
    for (const Eigen::Vector3d& p : points) mean += p / double(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : points) covariance += (p - mean) * (p - mean).transpose() / double(points.size());
    axes.compute(covariance);
  }
  double deviation(int axis) const { return std::sqrt(std::max(0.0, axes.eigenvalues()[axis])); }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
};

}  // namespace

std::optional<FloorPlane> find_floor(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& sensor) {
  const Points near = around(points, sensor);
  if (near.size() < kLeastPoints) return std::nullopt;
  std::optional<Plane> plane = widest(near, sensor);
  FloorPlane floor;
  for (int i = 0; plane && i < kRefinements; ++i) {
    const Points in = in_plane(near, *plane);
    if (in.size() < kLeastPoints) return std::nullopt;
    const PlaneSpread spread(in);
    if (spread.deviation(1) < kLeastSpread) return std::nullopt;
    plane = upwards(spread.axes.eigenvectors().col(0), spread.mean, sensor);
    if (plane) floor = {plane->normal, plane->above(sensor), spread.deviation(0), in.size()};
  }
  if (!plane) return std::nullopt;
  const auto under =
      std::count_if(near.begin(), near.end(), [&](const Eigen::Vector3d& p) { return plane->above(p) < -kBelow; });
  if (double(under) > kMostBelow * double(floor.points)) return std::nullopt;
  return floor;
}

Pose levelling(const FloorPlane& floor) {
  return Pose(Eigen::Quaterniond::FromTwoVectors(floor.normal, Eigen::Vector3d::UnitZ()));
}

double tilt_of(const FloorPlane& floor) {
  return std::atan2(floor.normal.head<2>().norm(), floor.normal.z());
}

}  // namespace tilth
