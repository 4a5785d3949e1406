#include <algorithm>
#include <optional>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/io/pose_header.hpp>
#include <tilth/io/stamp_unit.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth {
namespace {

constexpr std::size_t kTumColumns = 8, kKittiColumns = 12;

struct NumberedLine {
  std::string_view text;
  std::string where;
  std::size_t number = 0;
};

/// What stands before the first row of numbers, and how many of them that has.
struct Preamble {
  std::vector<NumberedLine> comments;
  std::optional<NumberedLine> header;
  std::string first_row;    ///< where it is
  std::size_t columns = 0;  ///< of it
};

Preamble preamble_of(std::string_view text, const std::string& name) {
  Preamble preamble;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const NumberedLine here{*line, lines.where(name), lines.number()};
    if (is_blank_or_comment(*line)) {
      preamble.comments.push_back(here);
      continue;
    }
    const std::vector<std::string_view> found = cells(*line);
    const bool number = std::any_of(found.begin(), found.end(), [](auto cell) { return to_double(cell).has_value(); });
    if (number || preamble.header) {
      preamble.first_row = here.where;
      preamble.columns = found.size() - (found.back().empty() ? 1 : 0);  // a comma at the end
      return preamble;
    }
    preamble.header = here;
  }
  throw Error(name, "holds no pose");
}

/// The columns that the header names, or the last comment that names some.
std::optional<PoseColumns> named_columns(const Preamble& preamble) {
  std::optional<PoseColumns> columns;
  if (preamble.header) {
    columns = columns_of_header(preamble.header->text, preamble.header->where);
    columns->header_line = preamble.header->number;
    return columns;
  }
  for (auto comment = preamble.comments.rbegin(); comment != preamble.comments.rend() && !columns; ++comment) {
    columns = columns_of_comment(comment->text, preamble.columns, comment->where);
    if (columns) columns->header_line = comment->number;
  }
  return columns;
}

std::string columns_notice(const PoseColumns& columns, const std::string& name) {
  std::string text = name + ": columns by their names in line " + std::to_string(columns.header_line) + ":";
  for (std::size_t i = 0; i < kPoseQuantities; ++i) {
    if (!columns.of[i]) continue;
    text.append(" ").append(name_of(PoseQuantity(i))).append(" ").append(std::to_string(*columns.of[i] + 1)) += ',';
  }
  text.pop_back();
  return text;
}

bool as_tum(const PoseColumns& columns) {
  return columns.count == kTumColumns && columns.of == tum_columns().of && columns.position_unit == 1;
}

PoseFile parse_table(std::string_view text, const std::string& name, const PoseColumns& columns) {
  PoseFile file{parse_pose_table(text, name, columns), columns[PoseQuantity::stamp].has_value(), {}};
  if (columns.header_line > 0 && !as_tum(columns)) file.notices.push_back(columns_notice(columns, name));
  if (!file.has_stamps || columns.stamps_in_second > 0) return file;
  const StampUnit unit = guess_stamp_unit(file.trajectory);
  if (unit.in_second == 1) return file;
  for (StampedPose& pose : file.trajectory) pose.stamp /= unit.in_second;
  file.notices.push_back(name + ": stamps are taken to be in " + std::string(unit.name) + ", by their size");
  return file;
}

PoseFile numbered(const std::vector<Pose>& poses) {
  PoseFile file;
  for (const Pose& pose : poses) file.trajectory.push_back({double(file.trajectory.size()), pose});
  return file;
}

std::string_view without_byte_order_mark(std::string_view text, const std::string& name) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw Error(name, "is text in UTF-16; save it as UTF-8");
  }
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

}  // namespace

PoseFile parse_pose_file(std::string_view bytes, const std::string& name) {
  const std::string_view text = without_byte_order_mark(bytes, name);
  const Preamble preamble = preamble_of(text, name);
  if (const std::optional<PoseColumns> columns = named_columns(preamble)) return parse_table(text, name, *columns);
  if (preamble.columns == kKittiColumns) return numbered(parse_kitti_poses(text, name));
  if (preamble.columns != kTumColumns) {
    throw Error(preamble.first_row, "has " + std::to_string(preamble.columns) +
                                        " columns; a TUM trajectory has 8 (stamp tx ty tz qx qy qz qw), KITTI poses " +
                                        "12; others need a header that names their columns");
  }
  PoseColumns columns = tum_columns();
  columns.stamps_in_second = 0;
  return parse_table(text, name, columns);
}

PoseFile read_pose_file(const std::filesystem::path& path) {
  return parse_pose_file(as_text(read_file(path)), path.string());
}

}  // namespace tilth
