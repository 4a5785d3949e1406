#include <cmath>
#include <iomanip>
#include <sstream>

#include <tilth/core/median.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/localization_record.hpp>

namespace tilth {
namespace {

std::string pose_cells(const Pose& T_map_body) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T_map_body.linear()).normalized();
  const Eigen::Vector3d t = T_map_body.translation();
  std::string text;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) text += ',' + exact_text(value);
  return text;
}

}  // namespace

std::vector<MapStateInterval> state_intervals(const LocalizationRecord& record) {
  std::vector<MapStateInterval> intervals;
  for (const LocalizationRow& row : record.rows) {
    if (intervals.empty() || intervals.back().state != row.state)
      intervals.push_back({row.state, row.stamp, row.stamp, 0});
    intervals.back().to = row.stamp;
    ++intervals.back().scans;
  }
  return intervals;
}

std::vector<double> times_to_answer(const LocalizationRecord& record) {
  std::vector<double> times;
  std::optional<double> since;
  for (const LocalizationRow& row : record.rows) {
    if (row.begun || row.state == MapState::lost) since = row.stamp;
    if (!since || !is_known(row.state)) continue;
    times.push_back(row.stamp - *since);
    since.reset();
  }
  return times;
}

std::optional<std::string> reason_of_failure(const LocalizationRecord& record, double max_scale_error) {
  std::vector<double> scales;
  std::size_t searches = 0;
  for (const LocalizationRow& row : record.rows) {
    if (is_known(row.state)) return std::nullopt;
    if (row.hypotheses.empty()) continue;
    ++searches;
    const std::optional<double> scale = row.hypotheses.front().scale;
    if (scale && std::abs(*scale - 1) > max_scale_error) scales.push_back(*scale);
  }
  if (scales.empty()) return std::nullopt;
  constexpr double kAlike = 0.02;
  const double middle = median(scales);
  std::erase_if(scales, [&](double scale) { return std::abs(scale - middle) > kAlike; });
  if (2 * scales.size() < searches) return std::nullopt;
  std::ostringstream text;
  text << std::setprecision(3) << "nothing is believed: where the scans fit best, the map is " << middle
       << " times as large as they are. Are units or ranges right, or is it another building?";
  return text.str();
}

std::string localization_header() {
  std::string header = "stamp,state,begun,x,y,z,qx,qy,qz,qw,overlap,through,hypotheses,ms";
  constexpr const char* kAxes[] = {"rx", "ry", "rz", "tx", "ty", "tz"};
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) header.append(",cov_").append(kAxes[i]).append("_").append(kAxes[j]);
  return header + "\n";
}

std::string localization_line(const LocalizationRow& row, const std::optional<Pose>& T_base_lidar) {
  std::ostringstream out;
  out << std::setprecision(9);
  out << exact_text(row.stamp) << ',' << names_of(row.state)[std::size_t(row.state)] << ',' << row.begun;
  out << (row.T_map_lidar ? pose_cells(pose_of_base(*row.T_map_lidar, T_base_lidar)) : ",,,,,,,");
  out << ',' << row.overlap << ',' << row.through << ',' << row.hypotheses.size() << ',' << row.milliseconds;
  const Matrix6d covariance = covariance_of_base(row.covariance, T_base_lidar);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) {
      out << ',';
      if (row.T_map_lidar) out << covariance(i, j);
    }
  out << '\n';
  return out.str();
}

void write_hypotheses(const std::filesystem::path& path, const LocalizationRecord& record,
                      const std::optional<Pose>& T_base_lidar) {
  std::ostringstream out;
  out << "stamp,state,rank,x,y,z,qx,qy,qz,qw,likeness,against,in_favour,overlap,landmarks,fitness,through,"
         "degenerate_directions,scale\n"
      << std::setprecision(6);
  for (const LocalizationRow& row : record.rows) {
    for (std::size_t i = 0; i < row.hypotheses.size(); ++i) {
      const HypothesisRow& h = row.hypotheses[i];
      out << exact_text(row.stamp) << ',' << names_of(row.state)[std::size_t(row.state)] << ',' << i
          << pose_cells(pose_of_base(h.T_map_lidar, T_base_lidar)) << ',' << h.likeness << ',' << h.against << ','
          << h.in_favour << ',' << h.overlap << ',' << h.landmarks << ',' << h.fitness << ',' << h.through << ','
          << h.degenerate_directions << ',';
      if (h.scale) out << *h.scale;
      out << '\n';
    }
  }
  write_text(path, out.str());
}

}  // namespace tilth
