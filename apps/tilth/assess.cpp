// tilth assess: how good the map of a run is, without truth.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include <tilth/assessment/map_assessment.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/run/scan_columns.hpp>
#include <tilth/search/kdtree.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr int kFindingsExit = 3;  // as of a run whose track was lost

std::vector<AssessedScan> scans_of(const fs::path& folder, const Trajectory& way) {
  const fs::path table = folder / "scans.csv";
  const std::vector<TrackState> states = read_track_states(table);
  if (states.size() != way.size()) {
    throw Error(table.string(), "has " + std::to_string(states.size()) + " rows, but the trajectory " +
                                    std::to_string(way.size()) + " poses");
  }
  std::vector<AssessedScan> scans;
  for (std::size_t i = 0; i < way.size(); ++i) scans.push_back({way[i].stamp, states[i]});
  return scans;
}

/// The points of the map, each as if it had been seen from the nearest pose: the file does not tell from which.
std::vector<ScannedPoint> points_of(const fs::path& path, const Trajectory& way) {
  std::vector<Eigen::Vector3d> places;
  for (const StampedPose& pose : way) places.push_back(pose.T_world_lidar.translation());
  const KdTree tree(places);
  std::vector<ScannedPoint> points;
  for (const Eigen::Vector3d& p : positions_of(read_pcd(path), path.string())) {
    if (!p.allFinite()) continue;
    const std::uint32_t nearest = tree.nearest(p)->index;
    points.push_back({p.cast<float>(), places[nearest].cast<float>(), nearest});
  }
  return points;
}

MapAssessment assess_run(const fs::path& folder) {
  const Trajectory way = read_tum(folder / "trajectory.tum");
  if (way.empty()) throw Error((folder / "trajectory.tum").string(), "has no pose");
  return assess_map(points_of(folder / "map.pcd", way), scans_of(folder, way));
}

void print(const std::string& folder, const MapAssessment& found) {
  const MapQuality& q = found.quality;
  std::printf("%s\n  thickness of surfaces   %.1f mm median, %.1f mm 90th percentile, of %zu\n", folder.c_str(),
              1e3 * q.thickness_median, 1e3 * q.thickness_p90, q.planes);
  std::printf("  mean plane variance     %.1f mm2\n  mean map entropy        %.3f over %zu cells\n",
              1e6 * q.plane_variance, q.entropy, q.cells);
  std::printf("  doubled walls           %zu of %zu surfaces\n  not tracked             %zu of %zu scans\n",
              found.doubled.doubled, found.doubled.planes, found.not_tracked, found.scans);
  std::printf("  verdict                 %s\n", found.verdict().c_str());
}

int assess(const std::vector<std::string>& folders) {
  std::vector<MapAssessment> all;
  for (const std::string& folder : folders) {
    all.push_back(assess_run(folder));
    print(folder, all.back());
  }
  const auto sharpest = std::min_element(all.begin(), all.end(), [](const MapAssessment& a, const MapAssessment& b) {
    return a.quality.entropy < b.quality.entropy;
  });
  if (all.size() > 1) std::printf("sharpest, by entropy: %s\n", folders[std::size_t(sharpest - all.begin())].c_str());
  const bool good = std::all_of(all.begin(), all.end(), [](const MapAssessment& a) { return a.findings.empty(); });
  return good ? 0 : kFindingsExit;
}

}  // namespace

void add_assess(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("assess", "Judge the maps of runs without truth; runs of one recording");
  const auto folders = std::make_shared<std::vector<std::string>>();
  command->add_option("RUN", *folders, "folders that `tilth run` wrote, with map.pcd")->required();
  command->footer("Exit code 0: all are good; 3: something is to be looked at. Figures: docs/assess.md.");
  command->callback([folders, &exit_code] { exit_code = assess(*folders); });
}

}  // namespace tilth::app
