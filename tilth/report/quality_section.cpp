#include <cmath>
#include <cstdio>

#include <tilth/assessment/map_assessment.hpp>
#include <tilth/report/run_sections.hpp>
#include <tilth/run/grid_sink.hpp>

namespace tilth {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

MapAssessment assessment_of(const RunRecord& record) {
  std::vector<ScannedPoint> points;
  points.reserve(record.map.points().size());
  for (const MapPoint& p : record.map.points()) {
    if (p.scan >= record.trajectory.size()) continue;
    const Eigen::Vector3d from = record.trajectory[p.scan].T_world_lidar.translation();
    points.push_back({{p.x, p.y, p.z}, from.cast<float>(), p.scan});
  }
  std::vector<AssessedScan> scans;
  for (const ScanRow& row : record.scans.rows) scans.push_back({row.stamp, row.track.state});
  return assess_map(points, scans);
}

/// Root mean square of what the graph leaves of accepted closures [sigma].
double loop_residual(const LoopRecord& loops) {
  double sum = 0, count = 0;
  for (const ClosureRow& row : loops.closures) {
    if (row.verdict != "accepted") continue;
    sum += row.squared_error;
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace

Section quality_section(const RunRecord& record) {
  if (is_resumed(record)) {
    return {"quality",
            "Quality of the map",
            "Not judged: the run was resumed, and its old map does not say when it was seen.",
            {},
            {}};
  }
  const MapAssessment found = assessment_of(record);
  Table table{"What is measured", {"figure", "value"}, {}, false};
  const MapQuality& quality = found.quality;
  table.rows = {
      {"thickness of surfaces, median", number("%.1f mm", 1e3 * quality.thickness_median)},
      {"thickness of surfaces, 90th percentile", number("%.1f mm", 1e3 * quality.thickness_p90)},
      {"mean plane variance", number("%.1f mm2", 1e6 * quality.plane_variance)},
      {"mean map entropy", number("%.3f", quality.entropy)},
      {"doubled walls, share of surfaces",
       number("%.2f %%",
              found.doubled.planes == 0 ? 0.0 : 100.0 * double(found.doubled.doubled) / double(found.doubled.planes))},
      {"scans that were not tracked", std::to_string(found.not_tracked) + " of " + std::to_string(found.scans)}};
  if (record.loops)
    table.rows.push_back({"residual of loop closures, RMS", number("%.2f sigma", loop_residual(*record.loops))});
  if (!record.scans.rows.empty()) {
    const Vector6d variances = record.scans.rows.back().covariance.diagonal();
    table.rows.push_back(
        {"expected error of the last position", number("%.3f m", std::sqrt(std::max(0.0, variances.tail<3>().sum())))});
  }
  return {"quality", "Quality of the map", "Without truth: " + found.verdict() + ".", {std::move(table)}, {}};
}

}  // namespace tilth
