#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth {
namespace {

std::size_t count_in_first_line(std::string_view text, const std::string& name) {
  TextLines lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::vector<std::string_view> found = words(*line, ",;");
    const std::size_t count = found.size();
    if (found.empty() || found.front().starts_with('#')) continue;
    if (count == 8 || count == 12) return count;
    throw Error(lines.where(name), "has " + std::to_string(count) +
                                       " columns; a TUM trajectory has 8 (stamp tx ty tz qx qy qz qw), KITTI poses 12");
  }
  throw Error(name, "holds no pose");
}

Trajectory numbered(const std::vector<Pose>& poses) {
  Trajectory trajectory;
  for (const Pose& pose : poses) trajectory.push_back({double(trajectory.size()), pose});
  return trajectory;
}

}  // namespace

PoseFile read_pose_file(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string_view text = as_text(bytes);
  if (count_in_first_line(text, path.string()) == 8) return {parse_tum(text, path.string()), true};
  return {numbered(parse_kitti_poses(text, path.string())), false};
}

}  // namespace tilth
