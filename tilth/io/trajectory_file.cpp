#include <array>
#include <charconv>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pose_table.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth {
namespace {

constexpr double kRotationTolerance = 1e-3;  // KITTI's files carry 7 digits

Pose pose_of(const std::vector<double>& m, const std::string& where) {
  Pose pose = Pose::Identity();
  pose.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data());
  const Eigen::Matrix3d R = pose.linear();
  const bool orthonormal = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kRotationTolerance;
  if (!orthonormal || R.determinant() < 0) throw Error(where, "is no pose: its 3x3 is no rotation");
  return pose;
}

std::string stamp_text(double stamp) {
  const std::string exact = exact_text(stamp);
  const std::size_t point = exact.find('.');
  const bool plain = exact.find('e') == std::string::npos;
  if (plain && point != std::string::npos && exact.size() - point - 1 >= 9) return exact;
  std::array<char, 400> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), stamp, std::chars_format::fixed, 9);
  return {text.data(), end};
}

std::string kitti_line(const Pose& pose) {
  std::string line;
  for (int i = 0; i < 12; ++i) line.append(i ? " " : "").append(exact_text(pose.matrix()(i / 4, i % 4)));
  return line + "\n";
}

}  // namespace

std::string tum_line(const StampedPose& pose) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.T_world_lidar.linear()).normalized();
  const Eigen::Vector3d t = pose.T_world_lidar.translation();
  std::string line = stamp_text(pose.stamp);
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    line.append(" ").append(exact_text(value));
  return line + "\n";
}

Trajectory parse_tum(std::string_view text, const std::string& name) {
  return parse_pose_table(text, name, tum_columns());
}

Trajectory read_tum(const std::filesystem::path& path) {
  return parse_tum(as_text(read_file(path)), path.string());
}

void write_tum(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& pose : trajectory) text += tum_line(pose);
  write_text(path, text);
}

std::vector<Pose> parse_kitti_poses(std::string_view text, const std::string& name) {
  std::vector<Pose> poses;
  TextLines lines(text);
  while (const auto numbers = next_numbers(lines, name, 12)) poses.push_back(pose_of(*numbers, lines.where(name)));
  if (poses.empty()) throw Error(name, "holds no pose");
  return poses;
}

std::vector<Pose> read_kitti_poses(const std::filesystem::path& path) {
  return parse_kitti_poses(as_text(read_file(path)), path.string());
}

void write_kitti_poses(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& pose : trajectory) text += kitti_line(pose.T_world_lidar);
  write_text(path, text);
}

}  // namespace tilth
