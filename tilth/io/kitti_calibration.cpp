#include <map>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/kitti_calibration.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr double kRotationTolerance = 1e-3;  // KITTI's files carry 7 digits
constexpr const char* kRaw = "calib_velo_to_cam.txt";

struct Entry {
  std::string_view numbers;
  std::string where;
};

/// "key: numbers" lines by their keys.
using Entries = std::map<std::string, Entry, std::less<>>;

Entries entries_of(std::string_view text, const std::string& name) {
  Entries entries;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const std::size_t colon = line->find(':');
    if (colon == std::string_view::npos) continue;
    const std::vector<std::string_view> key = words(line->substr(0, colon));
    if (key.size() != 1) continue;
    const std::string where = lines.where(name) + ", entry " + std::string(key[0]);
    entries.emplace(key[0], Entry{line->substr(colon + 1), where});
  }
  return entries;
}

std::vector<double> numbers_of(const Entry& entry, std::size_t count) {
  TextLines line(entry.numbers);
  const auto numbers = next_numbers(line, entry.where, count);
  if (!numbers) throw Error(entry.where, "has no numbers");
  return *numbers;
}

/// The rotation nearest to the 3x3 of `rows`.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& R, const std::string& where) {
  const bool orthonormal = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kRotationTolerance;
  if (!orthonormal || R.determinant() < 0) throw Error(where, "is no pose: its 3x3 is no rotation");
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

Eigen::Matrix3d rotation_entry(const Entry& entry) {
  const std::vector<double> numbers = numbers_of(entry, 9);
  return rotation_of(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data()), entry.where);
}

Pose pose_entry(const Entry& entry) {
  const std::vector<double> numbers = numbers_of(entry, 12);
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(numbers.data());
  Pose pose = Pose::Identity();
  pose.linear() = rotation_of(rows.leftCols<3>(), entry.where);
  pose.translation() = rows.col(3);
  return pose;
}

Pose raw_pose(const Entry& R, const Entry& T) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation_entry(R);
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(numbers_of(T, 3).data());
  return pose;
}

/// The rotation of `entry` before `pose`; `pose` itself where there is no such entry.
Pose rectified(const Pose& pose, const Entries& entries, const char* entry) {
  const auto found = entries.find(entry);
  return found == entries.end() ? pose : Pose(rotation_entry(found->second)) * pose;
}

}  // namespace

Pose parse_kitti_calibration(std::string_view text, const std::string& name) {
  const Entries entries = entries_of(text, name);
  for (const char* key : {"Tr", "Tr_velo_to_cam", "Tr_velo_cam"}) {
    const auto entry = entries.find(key);
    if (entry != entries.end()) return rectified(pose_entry(entry->second), entries, "R0_rect");
  }
  const auto R = entries.find("R"), T = entries.find("T");
  if (R != entries.end() && T != entries.end()) return raw_pose(R->second, T->second);
  throw Error(name, "has no entry Tr: (LiDAR to camera 0), and not both R: and T: in its place");
}

Pose read_kitti_calibration(const fs::path& path) {
  const Pose T_camera_lidar = parse_kitti_calibration(as_text(read_file(path)), path.string());
  const fs::path cameras = path.parent_path() / "calib_cam_to_cam.txt";
  if (path.filename() != kRaw || !fs::is_regular_file(cameras)) return T_camera_lidar;
  const std::vector<std::byte> bytes = read_file(cameras);
  return rectified(T_camera_lidar, entries_of(as_text(bytes), cameras.string()), "R_rect_00");
}

std::optional<fs::path> find_kitti_calibration(const fs::path& poses) {
  const fs::path folder = fs::absolute(poses).lexically_normal().parent_path();
  std::vector<fs::path> candidates{folder.parent_path() / "sequences" / poses.stem() / "calib.txt"};
  for (const fs::path& place : {folder, folder.parent_path(), folder.parent_path().parent_path()}) {
    candidates.push_back(place / "calib.txt");
    candidates.push_back(place / kRaw);
  }
  for (const fs::path& candidate : candidates) {
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  return std::nullopt;
}

}  // namespace tilth
