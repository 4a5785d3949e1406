// tilth run --loop-closure: its files, and loops of real and simulated recordings closed behind every pipeline.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numbers>
#include <thread>

#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"
#include <tilth/io/g2o.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/slam/slam.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

// A keyframe a scan or two and no way to go between passes: the room's scans are held against one another.
std::vector<std::string> run_in_room(const TemporaryFolder& folder) {
  return {"run",
          (folder / "room").string(),
          "--out",
          (folder / "out").string(),
          "--loop-closure",
          "--set",
          "loop.keyframe.distance=0.1",
          "--set",
          "loop.detect.min_path=0.5",
          "--set",
          "loop.submap_from=1"};
}

TEST(LoopClosureRun, WritesWhatItFound) {
  const TemporaryFolder folder;
  write_room(folder / "room", 30);
  const Outcome outcome = tilth(run_in_room(folder));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::filesystem::path out = folder / "out";
  const Trajectory before = read_tum(out / "trajectory_odometry.tum"), after = read_tum(out / "trajectory.tum");
  ASSERT_EQ(before.size(), 30U);
  ASSERT_EQ(after.size(), 30U);
  const PoseGraph graph = read_g2o(out / "pose_graph.g2o");
  EXPECT_GE(graph.poses.size(), 10U);
  const std::string closures = text_of(out / "closures.csv");
  const auto in_graph = std::size_t(
      std::count_if(graph.constraints.begin(), graph.constraints.end(), [](const Constraint& c) { return c.closure; }));
  std::size_t accepted = 0;
  for (std::size_t at = 0; (at = closures.find(",accepted,", at)) != std::string::npos; ++at) ++accepted;
  EXPECT_GT(accepted, 0U);
  EXPECT_EQ(accepted, in_graph);
  const std::size_t columns = std::size_t(std::count(closures.begin(), closures.begin() + closures.find('\n'), ','));
  EXPECT_EQ(std::size_t(std::count(closures.begin(), closures.end(), ',')), columns * lines_in(closures));
  const std::string summary = text_of(out / "summary.json");
  for (const char* key :
       {"\"loop_closure\"", "\"accepted\"", "\"loop.detect.min_path\"", "\"verification_ms\"", "\"longest_wait_ms\""})
    EXPECT_NE(summary.find(key), std::string::npos) << key;
}

TEST(LoopClosureRun, NamesAnOptionThatIsNone) {
  const TemporaryFolder folder;
  write_room(folder / "room", 2);
  const Outcome outcome =
      tilth({"run", (folder / "room").string(), "--out", (folder / "out").string(), "--set", "loop.detect.no_such=1"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("loop.detect.no_such"), std::string::npos) << outcome.err;
}

TEST(LoopClosureRun, WritesEverythingWhenInterrupted) {
  const TemporaryFolder folder;
  write_room(folder / "room", 400);
  const Program program(run_in_room(folder));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << outcome.err;
  const std::filesystem::path out = folder / "out";
  EXPECT_EQ(lines_in(text_of(out / "trajectory.tum")), lines_in(text_of(out / "trajectory_odometry.tum")));
  EXPECT_GT(read_g2o(out / "pose_graph.g2o").poses.size(), 0U);
  EXPECT_NE(text_of(out / "summary.json").find("\"loop_closure\""), std::string::npos);
}

}  // namespace
}  // namespace tilth::app
