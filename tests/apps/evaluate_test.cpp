// `tilth evaluate` on the files that users have: KITTI's truth of the camera, tables with headers, truths with holes.
#include <cmath>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/evaluation/body_frame.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

Trajectory drive(std::size_t poses) {
  Trajectory trajectory;
  Pose T = Pose::Identity();
  for (std::size_t i = 0; i < poses; ++i) {
    trajectory.push_back({1.6e9 + 0.1 * double(i), T});
    Vector6d motion;
    motion << 0, 0, 0.02 * std::sin(0.02 * double(i)), 0.5, 0, 0;
    T = retract(T, motion);
  }
  return trajectory;
}

Pose camera_lidar() {
  Pose T = Pose::Identity();
  T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T.translation() = Eigen::Vector3d(0.1, -0.2, -0.3);
  return T;
}

class Evaluate : public testing::Test {
 protected:
  Evaluate() { write_tum(folder_ / "estimate.tum", drive(600)); }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  Outcome evaluate(const std::string& truth, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"evaluate", in(truth), in("estimate.tum")});
    return tilth(more);
  }
  static void expect_says(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
  }

  TemporaryFolder folder_;
};

TEST_F(Evaluate, KittisOwnTruth) {
  write_kitti_poses(folder_ / "00.txt", in_frame_of(drive(600), camera_lidar().inverse()));
  const Outcome blind = evaluate("00.txt", {"--kitti"});
  ASSERT_EQ(blind.exit_code, 0) << blind.err;
  expect_says(blind.out, {"warning: the truth moves along +z", "--calib"});
  put("calib.txt", "Tr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n");
  const Outcome found = evaluate("00.txt", {"--kitti", "--json", in("report.json")});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  expect_says(found.out, {"moved to the LiDAR's by", "calib.txt, found beside it", "   0.000000    0.000000"});
  EXPECT_EQ(found.out.find("warning"), std::string::npos) << found.out;
  expect_says(text_of(folder_ / "report.json"), {"\"notices\"", "found beside it"});
  expect_says(evaluate("00.txt", {"--calib", in("none.txt")}).err, {"none.txt", "No such file"});
  EXPECT_NE(evaluate("00.txt", {"--calib", in("estimate.tum")}).exit_code, 0);
}

TEST_F(Evaluate, ATableThatPutsWFirst) {
  std::string table = "\xef\xbb\xbftimestamp [ns],x,y,z,q_w,q_x,q_y,q_z\r\n";
  for (const StampedPose& pose : drive(600)) {
    const Eigen::Quaterniond q(pose.T_world_lidar.linear());
    const Eigen::Vector3d t = pose.T_world_lidar.translation();
    table += std::to_string(std::llround(1e9 * pose.stamp));
    for (const double value : {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()})
      table.append(",").append(std::to_string(value));
    table += "\r\n";
  }
  put("truth.csv", table);
  const Outcome outcome = evaluate("truth.csv", {"--json", in("report.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_says(outcome.out, {"600 matching poses of 600", "columns by their names in line 1", "qw 5"});
  expect_says(outcome.out, {"APE rotation [deg]        0.0000"});
}

TEST_F(Evaluate, AHoleInTheTruth) {
  Trajectory truth = drive(600);
  truth.erase(truth.begin() + 300, truth.begin() + 329);
  write_tum(folder_ / "truth.tum", truth);
  const Outcome outcome = evaluate("truth.tum", {"--interpolate"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_says(outcome.out, {"29 poses of the estimate are left out", "571 matching poses"});
  expect_says(evaluate("truth.tum", {"--interpolate", "--max-gap", "3.1"}).out, {"600 matching poses"});
}

TEST_F(Evaluate, BadTablesAreNamedByLineAndField) {
  put("truth.csv", "t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n2,0,abc,0,0,0,0,1\n");
  const Outcome outcome = evaluate("truth.csv");
  EXPECT_NE(outcome.exit_code, 0);
  expect_says(outcome.err, {"truth.csv, line 3, field 3 (ty): 'abc'"});
}

}  // namespace
}  // namespace tilth::app
