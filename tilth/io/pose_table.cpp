#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/io/pose_table.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

constexpr double kUnitTolerance = 0.05;  // of a quaternion's length: two digits are enough, other columns are not

/// The numbers of one row by quantity; those without a column are 0.
using Row = std::array<double, kPoseQuantities>;

std::vector<std::string_view> row_cells(std::string_view line, const PoseColumns& columns, const std::string& where) {
  std::vector<std::string_view> found = cells(line);
  if (found.size() == columns.count + 1 && found.back().empty()) found.pop_back();  // a comma at the end
  if (found.size() == columns.count) return found;
  std::string expected = ", expected " + std::to_string(columns.count);
  if (columns.header_line > 0) expected += ", as line " + std::to_string(columns.header_line) + " names";
  throw Error(where, "has " + std::to_string(found.size()) + " values" + expected);
}

std::string field_of(const std::string& where, const PoseColumns& columns, PoseQuantity quantity) {
  return where + ", field " + std::to_string(*columns[quantity] + 1) + " (" + std::string(name_of(quantity)) + ")";
}

Row row_of(std::string_view line, const PoseColumns& columns, const std::string& where) {
  const std::vector<std::string_view> found = row_cells(line, columns, where);
  Row row{};
  for (std::size_t i = 0; i < kPoseQuantities; ++i) {
    if (!columns.of[i]) continue;
    const std::string_view cell = found[*columns.of[i]];
    const std::optional<double> number = to_double(cell);
    if (!number || !std::isfinite(*number)) {
      throw Error(field_of(where, columns, PoseQuantity(i)),
                  "'" + std::string(cell.substr(0, 40)) + "' is not a finite number");
    }
    row[i] = *number;
  }
  return row;
}

double stamp_of(const Row& row, const PoseColumns& columns, const std::string& where) {
  const double whole = columns.stamps_in_second > 0 ? row[0] / columns.stamps_in_second : row[0];
  if (!columns[PoseQuantity::nanoseconds]) return whole;
  const double part = row[std::size_t(PoseQuantity::nanoseconds)];
  if (part >= 0 && part < 1e9) return whole + 1e-9 * part;
  throw Error(field_of(where, columns, PoseQuantity::nanoseconds), exact_text(part) + " ns is no part of a second");
}

Pose pose_of(const Row& row, const PoseColumns& columns, const std::string& where) {
  const double* const q = row.data() + std::size_t(PoseQuantity::qx);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (!(rotation.norm() > 1e-6)) throw Error(where, "has a quaternion of length zero");
  if (std::abs(rotation.norm() - 1) > kUnitTolerance) {
    throw Error(where, "has a quaternion of length " + exact_text(std::round(1e3 * rotation.norm()) / 1e3) +
                           ", not 1: its columns are others; a header that names them is read");
  }
  Pose pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() =
      columns.position_unit * Eigen::Map<const Eigen::Vector3d>(row.data() + std::size_t(PoseQuantity::x));
  return pose;
}

}  // namespace

PoseColumns tum_columns() {
  PoseColumns columns;
  columns.count = 8;
  columns.stamps_in_second = 1.0;
  columns.of = {0, std::nullopt, 1, 2, 3, 4, 5, 6, 7};
  return columns;
}

bool is_blank_or_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r\v\f");
  if (first == std::string_view::npos) return true;
  return line[first] == '#' || line[first] == '%' || line.substr(first).starts_with("//");
}

Trajectory parse_pose_table(std::string_view text, const std::string& name, const PoseColumns& columns) {
  Trajectory trajectory;
  TextLines lines(text);
  const bool stamps = columns[PoseQuantity::stamp].has_value();
  while (const auto line = lines.next()) {
    if (lines.number() == columns.header_line || is_blank_or_comment(*line)) continue;
    const std::string where = lines.where(name);
    const Row row = row_of(*line, columns, where);
    const double stamp = stamps ? stamp_of(row, columns, where) : double(trajectory.size());
    if (!trajectory.empty() && !(stamp > trajectory.back().stamp)) {
      throw Error(where, "has stamp " + exact_text(stamp) + ", which is not after the line before");
    }
    trajectory.push_back({stamp, pose_of(row, columns, where)});
  }
  if (trajectory.empty()) throw Error(name, "holds no pose");
  return trajectory;
}

}  // namespace tilth
