// Bad input and bad output: a clear error and a non-zero exit, or one scan passed over and said so.
#include <limits>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"

namespace tilth::app {
namespace {

constexpr int kScans = 6;

class BadInput : public testing::Test {
 protected:
  Outcome run(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", scans_.string(), "--out", (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tilth(arguments);
  }
  std::size_t poses() const {
    const std::string text = text_of(folder_ / "out" / "trajectory.tum");
    return lines_in(text);
  }
  void replace(int index, const std::string& text) const { std::ofstream(scans_ / scan_name(index)) << text; }

  /// The run fails at once and names `words`.
  void expect_refused(const Outcome& outcome, const std::vector<std::string>& words) const {
    EXPECT_NE(outcome.exit_code, 0);
    for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }
  /// One scan is passed over by name; with --strict the run fails, but keeps what it had.
  void expect_passed_over(int index) const {
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(scan_name(index)), std::string::npos) << outcome.err;
    EXPECT_EQ(poses(), std::size_t(kScans - 1));
    EXPECT_NE(text_of(folder_ / "out" / "summary.json").find(scan_name(index)), std::string::npos);
    EXPECT_EQ(run({"--strict"}).exit_code, 1);
    EXPECT_EQ(poses(), std::size_t(index));
  }
  /// Every scan has a finite pose.
  void expect_all_registered() const {
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(poses(), std::size_t(kScans));
    EXPECT_EQ(text_of(folder_ / "out" / "trajectory.tum").find("nan"), std::string::npos);
  }
  void write_times(const std::string& times) const { std::ofstream(scans_ / "times.txt") << times; }

  TemporaryFolder folder_;
  std::filesystem::path scans_ = folder_ / "room";
};

TEST_F(BadInput, MissingPath) {
  expect_refused(run(), {scans_.string(), "no such"});
}

TEST_F(BadInput, EmptyFolder) {
  std::filesystem::create_directories(scans_);
  expect_refused(run(), {scans_.string(), "empty"});
}

TEST_F(BadInput, NothingButZeroBytes) {
  std::filesystem::create_directories(scans_);
  replace(0, "");
  expect_refused(run(), {scan_name(0)});
}

TEST_F(BadInput, ZeroByteScan) {
  write_room(scans_, kScans);
  replace(3, "");
  expect_passed_over(3);
}

TEST_F(BadInput, TruncatedScan) {
  write_room(scans_, kScans);
  std::filesystem::resize_file(scans_ / scan_name(3), std::filesystem::file_size(scans_ / scan_name(3)) / 2);
  expect_passed_over(3);
}

TEST_F(BadInput, CorruptHeader) {
  write_room(scans_, kScans);
  replace(3, "VERSION .7\nFIELDS x y\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 10\nDATA binary\n");
  expect_passed_over(3);
}

TEST_F(BadInput, NoPointCloudAtAll) {
  write_room(scans_, kScans);
  replace(3, std::string(5000, '\xa7'));
  expect_passed_over(3);
}

TEST_F(BadInput, TruncatedBag) {
  scans_ = folder_ / "recording.bag";
  std::ofstream(scans_) << "#ROSBAG V2.0\n\x45";
  expect_refused(run(), {scans_.string()});
}

TEST_F(BadInput, UnknownKindOfFile) {
  scans_ = folder_ / "recording.txt";
  std::ofstream(scans_) << "nothing";
  expect_refused(run(), {scans_.string()});
}

TEST_F(BadInput, NanAndInfinitePoints) {
  write_room(scans_, kScans);
  PointCloud cloud = room_scan(3);
  for (std::size_t i = 0; i < cloud.size(); i += 7) cloud.points[i].x() = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 3; i < cloud.size(); i += 7) cloud.points[i].z() = std::numeric_limits<double>::infinity();
  write_scan(scans_, 3, cloud);
  expect_all_registered();
}

TEST_F(BadInput, AllPointsZero) {
  write_room(scans_, kScans);
  PointCloud cloud = room_scan(3);
  for (Eigen::Vector3d& p : cloud.points) p.setZero();
  write_scan(scans_, 3, cloud);
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GE(poses(), std::size_t(kScans - 1));
}

TEST_F(BadInput, OnePointScan) {
  write_room(scans_, kScans);
  write_scan(scans_, 3, select(room_scan(3), std::array{std::uint32_t(17)}));
  expect_all_registered();
}

TEST_F(BadInput, AScanFarAway) {
  write_room(scans_, kScans);
  PointCloud cloud = room_scan(3);
  for (Eigen::Vector3d& p : cloud.points) p += Eigen::Vector3d(100, 0, 0);
  write_scan(scans_, 3, cloud);
  expect_all_registered();
}

TEST_F(BadInput, TimesRunningBackwards) {
  write_room(scans_, kScans);
  write_times("0.0\n0.1\n0.2\n0.15\n0.4\n0.5\n");
  expect_all_registered();
}

TEST_F(BadInput, DuplicateTimes) {
  write_room(scans_, kScans);
  write_times("0.0\n0.1\n0.2\n0.2\n0.4\n0.5\n");
  expect_all_registered();
}

TEST_F(BadInput, FewerTimesThanScans) {
  write_room(scans_, kScans);
  write_times("0.0\n0.1\n");
  expect_refused(run(), {"times.txt", "2", std::to_string(kScans)});
}

TEST_F(BadInput, Options) {
  write_room(scans_, kScans);
  expect_refused(run({"--set", "no_such_option=3"}), {"no_such_option", "not known"});
  expect_refused(run({"--set", "align.bend=false"}), {"align.bend", "is called align.motion_model now"});
  expect_refused(run({"--set", "align.tremor.yaw_share=0.1"}), {"is called align.vibration.yaw_ratio now"});
  expect_refused(run({"--set", "min_range=-1"}), {"min_range", "-1", "0 .. "});
  expect_refused(run({"--set", "min_range=near"}), {"min_range", "near", "number"});
  expect_refused(run({"--set", "min_range"}), {"min_range", "key=value"});
  expect_refused(run({"--map-voxel", "0"}), {"map_voxel", "0.001"});
  expect_refused(run({"--pipeline", "none"}), {"none", "improved_floam"});
  expect_refused(run({"--config", (folder_ / "missing.yaml").string()}), {"missing.yaml"});
  expect_refused(run({"--truth", (folder_ / "missing.tum").string()}), {"missing.tum"});
  expect_refused(run({"--no-such-flag"}), {"--no-such-flag"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(BadInput, OutputThatIsAFile) {
  write_room(scans_, kScans);
  std::ofstream(folder_ / "out") << "mine";
  expect_refused(run(), {(folder_ / "out").string()});
  EXPECT_EQ(text_of(folder_ / "out"), "mine");
}

TEST_F(BadInput, OutputThatIsReadOnly) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  write_room(scans_, kScans);
  std::filesystem::create_directories(folder_ / "out");
  ::chmod((folder_ / "out").c_str(), 0500);
  expect_refused(run(), {(folder_ / "out").string()});
  ::chmod((folder_ / "out").c_str(), 0700);
}

TEST_F(BadInput, FullDiskKeepsTheOtherFiles) {
  write_room(scans_, kScans);
  std::filesystem::create_directories(folder_ / "out");
  std::filesystem::create_symlink("/dev/full", folder_ / "out" / "map.pcd");
  expect_refused(run(), {"map.pcd", "No space left"});
  EXPECT_EQ(poses(), std::size_t(kScans));
}

}  // namespace
}  // namespace tilth::app
