#include <iomanip>
#include <sstream>

#include <tilth/io/output_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/run/loop_record.hpp>

namespace tilth {
namespace {

constexpr const char* kAxes[] = {"rx", "ry", "rz", "tx", "ty", "tz"};

std::string header() {
  std::string text =
      "from,to,from_scan,to_scan,from_stamp,to_stamp,x,y,z,qx,qy,qz,qw,found_by,verdict,overlap,back_overlap,landmarks,"
      "fitness,"
      "degenerate_directions,squared_error";
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      text.append(",info_").append(kAxes[row]).append("_").append(kAxes[column]);
  return text + "\n";
}

std::string line_of(const ClosureRow& row) {
  const Constraint& c = row.constraint;
  const Eigen::Quaterniond q = Eigen::Quaterniond(c.T_from_to.linear()).normalized();
  const Eigen::Vector3d t = c.T_from_to.translation();
  std::ostringstream out;
  out << c.from << ',' << c.to << ',' << row.from_scan << ',' << row.to_scan;
  for (const double value : {row.from_stamp, row.to_stamp, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    out << ',' << exact_text(value);
  out << ',' << row.found_by << ',' << row.verdict << std::setprecision(6);
  out << ',' << row.overlap << ',' << row.back_overlap << ',' << row.landmarks << ',' << row.fitness << ','
      << row.degenerate_directions << ',' << row.squared_error << std::setprecision(9);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) out << ',' << c.information(i, j);
  out << '\n';
  return out.str();
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> accepted_scans(const LoopRecord& loops) {
  std::vector<std::pair<std::size_t, std::size_t>> scans;
  for (const ClosureRow& row : loops.closures) {
    if (row.verdict == "accepted") scans.emplace_back(row.from_scan, row.to_scan);
  }
  return scans;
}

void write_closures(const std::filesystem::path& path, const std::vector<ClosureRow>& closures) {
  std::string text = header();
  for (const ClosureRow& row : closures) text += line_of(row);
  write_text(path, text);
}

}  // namespace tilth
