// A tunnel with 40 m of bare walls, through which a sensor that sees 8 m far drives: the axis must be reported
// degenerate, and crossed at the velocity seen before.
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

/// The column `name` of scans.csv, a value a scan.
std::vector<double> column(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::string line, cell;
  std::getline(lines, line);
  std::istringstream head(line);
  std::size_t at = 0;
  while (std::getline(head, cell, ',') && cell != name) ++at;
  std::vector<double> values;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    for (std::size_t i = 0; i <= at; ++i) std::getline(row, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

TEST(Tunnel, IsCrossedByTheMotionBeforeItAndReported) {
  const TemporaryFolder folder;
  const std::filesystem::path drive = folder / "drive", out = folder / "out";
  const std::string world = std::string(TILTH_SOURCE_DIR) + "/examples/worlds/tunnel.sdf";
  const Outcome made = tilth({"simulate", world, "--waypoints", "-14,0;54,0", "--cruise", "2", "--seed", "3", "--out",
                              drive.string(), "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome outcome = tilth({"run", drive.string(), "--out", out.string(), "--set", "max_range=8", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

  constexpr double kBlind = 24;  // [m] with no pilaster in sight
  const Trajectory truth = read_tum(drive / "truth.tum"), estimate = read_tum(out / "trajectory.tum");
  const std::vector<double> degenerate = column(text_of(out / "scans.csv"), "degenerate_directions");
  ASSERT_EQ(degenerate.size(), estimate.size());
  EXPECT_GE(std::count(degenerate.begin(), degenerate.end(), 1.0), std::ptrdiff_t(kBlind / 2 / 0.1));
  EXPECT_LE(*std::max_element(degenerate.begin(), degenerate.end()), 1);
  const Pose T_truth_world = interpolate(truth, estimate.front().stamp) * estimate.front().T_world_lidar.inverse();
  for (const StampedPose& pose : estimate) {
    const Pose error = interpolate(truth, pose.stamp).inverse() * T_truth_world * pose.T_world_lidar;
    ASSERT_LT(std::abs(error.translation().x()), 0.05 * kBlind) << pose.stamp;
    ASSERT_LT(std::abs(error.translation().y()), 0.01) << pose.stamp;
    ASSERT_LT(std::abs(error.translation().z()), 0.02) << pose.stamp;
    ASSERT_LT(angle_of(error), 0.1 * M_PI / 180) << pose.stamp;
  }
}

}  // namespace
}  // namespace tilth::app
