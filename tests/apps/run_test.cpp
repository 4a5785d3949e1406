// tilth run on recordings that are fine: its files, its options, its threads, its interruption.
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

class Run : public testing::Test {
 protected:
  Outcome run(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", scans_.string(), "--out", (folder_ / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tilth(arguments);
  }
  std::string result(const std::string& out, const std::string& file) const { return text_of(folder_ / out / file); }

  TemporaryFolder folder_;
  std::filesystem::path scans_ = folder_ / "room";
};

TEST_F(Run, WritesEveryFileForEveryScan) {
  write_room(scans_, 12);
  const Outcome outcome = run("out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("error"), std::string::npos) << outcome.err;
  EXPECT_EQ(lines_in(result("out", "trajectory.tum")), 12U);
  EXPECT_EQ(lines_in(result("out", "trajectory_kitti.txt")), 12U);
  EXPECT_EQ(lines_in(result("out", "scans.csv")), 13U);
  EXPECT_NE(result("out", "summary.json").find("\"scans\": 12"), std::string::npos);
  const PointRecords map = read_pcd(folder_ / "out" / "map.pcd");
  EXPECT_GT(map.count, 1000U);
  for (const char* field : {"x", "y", "z", "intensity"}) EXPECT_NE(map.find(field), nullptr) << field;
}

TEST_F(Run, FollowsTheSensorThroughTheRoom) {
  write_room(scans_, 12);
  ASSERT_EQ(run("out").exit_code, 0);
  const Trajectory trajectory = read_tum(folder_ / "out" / "trajectory.tum");
  ASSERT_EQ(trajectory.size(), 12U);
  EXPECT_EQ(trajectory.front().T_world_lidar.matrix(), Pose::Identity().matrix());
  EXPECT_NEAR((trajectory.back().T_world_lidar.translation() - Eigen::Vector3d(11 * kStep, 0, 0)).norm(), 0.0, 0.05);
}

TEST_F(Run, HasTheSameBytesWithAnyNumberOfThreads) {
  write_room(scans_, 12);
  for (const char* threads : {"1", "2", "8"}) ASSERT_EQ(run(threads, {"--threads", threads}).exit_code, 0);
  for (const char* file : {"trajectory.tum", "map.pcd"}) {
    EXPECT_EQ(result("1", file), result("2", file)) << file;
    EXPECT_EQ(result("1", file), result("8", file)) << file;
  }
}

TEST_F(Run, StopsAfterAsManyScansAsAskedFor) {
  write_room(scans_, 12);
  ASSERT_EQ(run("out", {"--max-scans", "5", "--quiet"}).exit_code, 0);
  EXPECT_EQ(lines_in(result("out", "trajectory.tum")), 5U);
}

TEST_F(Run, SaysNothingWhenQuiet) {
  write_room(scans_, 3);
  const Outcome outcome = run("out", {"--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(Run, KeepsFewerPointsInLargerVoxels) {
  write_room(scans_, 3);
  ASSERT_EQ(run("fine").exit_code, 0);
  ASSERT_EQ(run("coarse", {"--map-voxel", "0.5"}).exit_code, 0);
  EXPECT_LT(2 * read_pcd(folder_ / "coarse" / "map.pcd").count, read_pcd(folder_ / "fine" / "map.pcd").count);
}

TEST_F(Run, TakesOptionsFromAFileAndThenFromTheCommandLine) {
  write_room(scans_, 3);
  std::ofstream(folder_ / "my.yaml") << "min_range: 1.5\nmax_range: 50\n";
  ASSERT_EQ(run("out", {"--config", (folder_ / "my.yaml").string(), "--set", "max_range=40"}).exit_code, 0);
  const std::string summary = result("out", "summary.json");
  EXPECT_NE(summary.find("\"min_range\": \"1.5\""), std::string::npos) << summary;
  EXPECT_NE(summary.find("\"max_range\": \"40\""), std::string::npos) << summary;
}

TEST_F(Run, TakesTheFileThatConfigPrints) {
  write_room(scans_, 3);
  std::ofstream(folder_ / "all.yaml") << tilth({"config", "--yaml"}).out;
  ASSERT_EQ(run("default").exit_code, 0);
  const Outcome outcome = run("all", {"--config", (folder_ / "all.yaml").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(result("default", "trajectory.tum"), result("all", "trajectory.tum"));
}

TEST_F(Run, JudgesItselfByTheTruth) {
  write_room(scans_, 12);
  Trajectory truth;
  for (int i = 0; i < 12; ++i) truth.push_back({0.1 * i, Pose(Eigen::Translation3d(3, kStep * i, 1))});
  write_tum(folder_ / "truth.tum", truth);
  const Outcome outcome = run("out", {"--truth", (folder_ / "truth.tum").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(result("out", "summary.json").find("\"evaluation\""), std::string::npos);
}

TEST_F(Run, JudgesItselfByPosesWithoutStamps) {
  write_room(scans_, 12);
  Trajectory truth;
  for (int i = 0; i < 12; ++i) truth.push_back({0, Pose(Eigen::Translation3d(3, kStep * i, 1))});
  write_kitti_poses(folder_ / "truth.txt", truth);
  const Outcome outcome = run("out", {"--truth", (folder_ / "truth.txt").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(result("out", "summary.json").find("\"matches\": 12"), std::string::npos);
  const Outcome info = tilth({"info", scans_.string(), "--truth", (folder_ / "truth.txt").string()});
  EXPECT_NE(info.out.find("12 poses without stamps"), std::string::npos) << info.out << info.err;
}

TEST_F(Run, WarnsOfWhatInfoWarnsOf) {
  write_room(scans_, 12);
  for (int i = 0; i < 12; ++i) {
    const std::string name = std::to_string(0.1 * i + (i < 6 ? 0.0 : 0.7)) + ".pcd";
    std::filesystem::rename(scans_ / scan_name(i), scans_ / name);
  }
  const Outcome outcome = run("out");
  const Outcome info = tilth({"info", scans_.string()});
  for (const char* warning : {"no times of their own", "0.80 s pass after scan 5"}) {
    EXPECT_NE(info.out.find(warning), std::string::npos) << info.out;
    EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
    EXPECT_NE(result("out", "summary.json").find(warning), std::string::npos);
  }
}

TEST_F(Run, WritesWhatItHasWhenInterrupted) {
  write_room(scans_, 400);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Program program({"run", scans_.string(), "--out", (folder_ / "out").string()});
    while (program.running() && program.out_so_far().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.signal(signal);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 128 + signal) << outcome.err;
    EXPECT_NE(outcome.out.find("interrupted"), std::string::npos) << outcome.out;
    const std::size_t poses = lines_in(result("out", "trajectory.tum"));
    EXPECT_GT(poses, 0U);
    EXPECT_LT(poses, 400U);
    EXPECT_EQ(lines_in(result("out", "scans.csv")), poses + 1);
  }
}

TEST_F(Run, GoesOnAfterAHangupThatIsIgnored) {
  write_room(scans_, 40);
  struct sigaction before {
  }, ignored{};
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGHUP, &ignored, &before);  // as nohup does
  const Program program({"run", scans_.string(), "--out", (folder_ / "out").string()});
  sigaction(SIGHUP, &before, nullptr);
  while (program.running() && program.out_so_far().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.signal(SIGHUP);
  EXPECT_EQ(program.wait().exit_code, 0);
  EXPECT_EQ(lines_in(result("out", "trajectory.tum")), 40U);
}

}  // namespace
}  // namespace tilth::app
