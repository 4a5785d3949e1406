// Writes a report that no run made, for tests/web: report_probe OUT POINTS NAME. A walk through a hall of POINTS
// points, with truth, keyframes and loop closures; NAME stands wherever a report holds a name.
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <random>

#include <tilth/report/html_report.hpp>
#include <tilth/report/run_report.hpp>

namespace tilth {
namespace {

constexpr int kScans = 400;
constexpr double kRadius = 20;  // [m] of the walk

/// Points on the walls and the floor of a hall, each in a voxel of its own as far as there is room.
PointCloud hall(std::mt19937& random, std::size_t points) {
  std::uniform_real_distribution<double> along(-40, 40), up(0, 8);
  PointCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double u = along(random), v = up(random);
    const Eigen::Vector3d kinds[] = {
        {u, along(random), 0.02 * v}, {u, v < 4 ? -40.0 : 40.0, v}, {v < 4 ? -40.0 : 40.0, u, v}};
    cloud.points.push_back(kinds[random() % 3]);
    cloud.intensities.push_back(float(v));
  }
  return cloud;
}

RunRecord record_of(std::size_t points, const std::string& name) {
  RunRecord record;
  record.source = record.pipeline = record.machine = record.ended = name;
  record.decisions = {name};
  record.skipped = {{1, name, name}};
  record.options = {{name, name, name, name, name}};
  record.scans.stages = {name, "other"};
  record.map = MapBuilder({.voxel = 0.001});
  std::mt19937 random(7);
  Trajectory truth;
  for (int i = 0; i < kScans; ++i) {
    const double angle = 2 * std::numbers::pi * i / kScans;
    const Pose T = Eigen::Translation3d(kRadius * std::cos(angle), kRadius * std::sin(angle), 1) *
                   Pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    record.trajectory.push_back({0.1 * i, T});
    truth.push_back({0.1 * i, T * Eigen::Translation3d(0.01 * std::sin(9 * angle), 0, 0)});
    ScanRow row;
    row.stamp = 0.1 * i;
    row.register_ms = 5 + i % 3;
    row.stage_ms = {1.0 + i % 2, 2.0};
    record.scans.rows.push_back(row);
    const std::size_t ratio = points * std::size_t(i + 1) / kScans - points * std::size_t(i) / kScans;
    record.map.add(hall(random, ratio), Pose::Identity(), 0.0, {});
  }
  record.evaluation = evaluate(truth, record.trajectory, {});
  return record;
}

}  // namespace
}  // namespace tilth

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    tilth::Report report = tilth::report_of(tilth::record_of(std::stoul(argv[2]), argv[3]), 2'000'000);
    report.map->keyframes = {0, 100, 200, 300};
    report.map->closures = {{0, 399}, {100, 300}};
    tilth::write_report(argv[1], report);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
