#include <algorithm>
#include <iterator>

#include <tilth/report/run_outputs.hpp>
#include <tilth/run/change_record.hpp>
#include <tilth/run/file_sinks.hpp>
#include <tilth/run/grid_sink.hpp>
#include <tilth/run/mcap_sink.hpp>
#include <tilth/run/octomap_sink.hpp>
#include <tilth/run/tile_sink.hpp>

namespace tilth {
namespace {

using Path = std::filesystem::path;

/// A file for each format of the map that is asked for.
std::vector<RunOutput> map_outputs(const OutputOptions& options) {
  std::vector<RunOutput> all;
  const std::set<std::string> maps = map_formats(options);
  const auto open = [origin = origin_of(options)](const Path& path) { return map_sink(path, origin); };
  for (const char* format : {"pcd", "ply", "las"}) {
    if (maps.contains(format)) all.push_back({std::string("map.") + format, open});
  }
  if (maps.contains("bt")) {
    const double resolution = options.octomap_resolution;
    all.push_back({"map.bt", [resolution](const Path& path) { return octomap_sink(path, resolution); }});
  }
  if (maps.contains("tiles")) {
    const int edge = options.tile;
    all.push_back({"pointcloud_map_metadata.yaml", [edge](const Path& path) { return tile_sink(path, edge); }});
  }
  return all;
}

}  // namespace

std::vector<RunOutput> run_outputs(const OutputOptions& options, const ReportOptions& report, bool loop_closure,
                                   bool keep_moving) {
  std::vector<RunOutput> all{{"trajectory.tum", tum_sink},
                             {"trajectory_kitti.txt", kitti_sink},
                             {"scans.csv", scan_table_sink},
                             {"summary.json", summary_sink},
                             {"beams.yaml", beams_sink}};
  std::ranges::move(map_outputs(options), std::back_inserter(all));
  if (!keep_moving) {
    all.push_back({"moving.pcd", moving_sink});
    all.push_back({"changes.csv", changes_sink});
  }
  all.push_back({"report.html", [report](const Path& path) { return report_sink(path, report); }});
  if (options.grid) {
    const auto plan = std::make_shared<PlanOfRun>(options.occupancy);
    all.push_back({"map.pgm", [plan](const Path& path) { return grid_image_sink(path, plan); }});
    all.push_back({"map.yaml", [plan](const Path& path) { return grid_yaml_sink(path, plan); }});
  }
  if (options.mcap) {
    const auto open = [points = options.mcap_points](const Path& path) {
      return std::make_unique<McapSink>(path, points);
    };
    all.push_back({"run.mcap", open});
  }
  if (!loop_closure) return all;
  all.push_back({"trajectory_odometry.tum", odometry_trajectory_sink});
  all.push_back({"closures.csv", closures_sink});
  all.push_back({"pose_graph.g2o", pose_graph_sink});
  return all;
}

}  // namespace tilth
