#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/run/base_frame.hpp>

namespace tilth {
namespace {

constexpr std::array kAngles{"x", "y", "z", "roll", "pitch", "yaw"};
constexpr std::array kQuaternion{"x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr const char* kShape = "expected x,y,z,roll,pitch,yaw [m, deg] or x,y,z,qx,qy,qz,qw";

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw Error("base_from_lidar " + text, why + ": " + kShape);
}

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::vector<double> numbers_of(const std::string& text) {
  const std::vector<std::string> parts = parts_of(text);
  if (parts.size() < kAngles.size()) refuse(text, std::string(kAngles[parts.size()]) + " is missing");
  if (parts.size() > kQuaternion.size()) refuse(text, "has " + std::to_string(parts.size()) + " numbers");
  std::vector<double> numbers(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), numbers[i]);
    const char* name = parts.size() == kAngles.size() ? kAngles[i] : kQuaternion[i];
    if (error != std::errc{} || end != part.data() + part.size() || !std::isfinite(numbers[i]))
      refuse(text, std::string(name) + " is \"" + part + "\", which is no number");
  }
  return numbers;
}

Eigen::Quaterniond turned(double roll, double pitch, double yaw) {
  constexpr double kDegree = std::numbers::pi / 180;
  return Eigen::AngleAxisd(yaw * kDegree, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch * kDegree, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll * kDegree, Eigen::Vector3d::UnitX());
}

}  // namespace

Pose parse_mount(const std::string& text) {
  constexpr double kUnitTolerance = 1e-3;
  constexpr double kFarthest = 100.0;  // [m] from the base of any robot; millimetres are beyond
  const std::vector<double> n = numbers_of(text);
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(n[i]) > kFarthest) refuse(text, std::string(kAngles[i]) + " is more than 100 m");
  Eigen::Quaterniond q;
  if (n.size() == kAngles.size()) {
    q = turned(n[3], n[4], n[5]);
  } else {
    q = Eigen::Quaterniond(n[6], n[3], n[4], n[5]);
    if (!(std::abs(q.norm() - 1) < kUnitTolerance)) refuse(text, "qx,qy,qz,qw has not the length 1");
  }
  return Eigen::Translation3d(n[0], n[1], n[2]) * q.normalized();
}

std::vector<double> mount_numbers(const Pose& T_base_lidar) {
  const Eigen::Vector3d t = T_base_lidar.translation();
  const Eigen::Quaterniond q(T_base_lidar.linear());
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

std::vector<OptionInfo> describe_mount(const std::string& base_from_lidar, bool level) {
  return {{"base_from_lidar", base_from_lidar, "m, deg",
           "x,y,z,roll,pitch,yaw of the LiDAR on the robot, whose frame base_link the poses are then of", "text"},
          {"level", level ? "true" : "false", "-", "the floor below the first seconds made level", "true | false"}};
}

Pose pose_of_base(const Pose& T_world_lidar, const std::optional<Pose>& T_base_lidar) {
  return T_base_lidar ? Pose(T_world_lidar * T_base_lidar->inverse()) : T_world_lidar;
}

Trajectory poses_of_base(Trajectory poses, const std::optional<Pose>& T_base_lidar) {
  for (StampedPose& pose : poses) pose.T_world_lidar = pose_of_base(pose.T_world_lidar, T_base_lidar);
  return poses;
}

Trajectory poses_of_lidar(Trajectory poses, const std::optional<Pose>& T_base_lidar) {
  if (!T_base_lidar) return poses;
  return poses_of_base(std::move(poses), T_base_lidar->inverse());
}

Matrix6d covariance_of_base(const Matrix6d& of_lidar, const std::optional<Pose>& T_base_lidar) {
  if (!T_base_lidar) return of_lidar;
  const Matrix6d to_base = adjoint(*T_base_lidar);
  return to_base * of_lidar * to_base.transpose();
}

std::string body_of(const std::optional<Pose>& T_base_lidar) {
  return T_base_lidar ? "base_link" : "lidar";
}

}  // namespace tilth
