#include <array>
#include <charconv>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
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
  Trajectory trajectory;
  TextLines lines(text);
  while (const auto v = next_numbers(lines, name, 8)) {
    const Eigen::Quaterniond q((*v)[7], (*v)[4], (*v)[5], (*v)[6]);
    if (!(q.norm() > 1e-6)) throw Error(lines.where(name), "has a quaternion of length zero");
    if (!trajectory.empty() && !((*v)[0] > trajectory.back().stamp)) {
      throw Error(lines.where(name), "has stamp " + stamp_text((*v)[0]) + ", which is not after the line before");
    }
    StampedPose pose{(*v)[0], Pose::Identity()};
    pose.T_world_lidar.linear() = q.normalized().toRotationMatrix();
    pose.T_world_lidar.translation() = Eigen::Vector3d((*v)[1], (*v)[2], (*v)[3]);
    trajectory.push_back(pose);
  }
  if (trajectory.empty()) throw Error(name, "holds no pose");
  return trajectory;
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

Pose parse_kitti_calibration(std::string_view text, const std::string& name) {
  TextLines lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::size_t colon = line->find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view key = line->substr(0, colon);
    if (key != "Tr" && key != "Tr_velo_to_cam" && key != "Tr_velo_cam") continue;
    TextLines entry(line->substr(colon + 1));
    const auto numbers = next_numbers(entry, lines.where(name), 12);
    if (!numbers) throw Error(lines.where(name), "has no numbers after " + std::string(key));
    return pose_of(*numbers, lines.where(name));
  }
  throw Error(name, "has no entry Tr: (LiDAR to camera 0)");
}

Pose read_kitti_calibration(const std::filesystem::path& path) {
  return parse_kitti_calibration(as_text(read_file(path)), path.string());
}

}  // namespace tilth
