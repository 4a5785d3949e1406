// tilth play and tilth live over the loopback: the same trajectory as without a network; killed, and gone on with.
#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "live_program.hpp"
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

constexpr double kMicrosecond = 1e-6;
constexpr double kRangeStep = 0.002;  // [m] of the VLP-16; that of the C16 is 2.5 mm

TEST_F(Live, APlayedRecordingGivesTheTrajectoryOfTheSimulation) {
  for (const std::string sensor : {"leishen_c16", "vlp16"}) {
    SCOPED_TRACE(sensor);
    record(sensor, "4");
    const auto program = live(sensor, {"--idle", "1", "--queue", "100"});
    ASSERT_EQ(tilth(play("2")).exit_code, 0);
    const Outcome outcome = program->wait();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("dropped"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
    ASSERT_EQ(tilth({"run", "sim://plaza_fast?duration=4&sensor=" + sensor, "--out", in("direct")}).exit_code, 0);
    const Trajectory played = read_tum(folder_ / sensor / "trajectory.tum");
    const Trajectory direct = read_tum(folder_ / "direct" / "trajectory.tum");
    ASSERT_EQ(played.size(), direct.size());
    for (std::size_t i = 0; i < played.size(); ++i) {
      EXPECT_NEAR(played[i].stamp - played[0].stamp, direct[i].stamp - direct[0].stamp, 5 * kMicrosecond);
      const Pose difference = direct[i].T_world_lidar.inverse() * played[i].T_world_lidar;
      EXPECT_LT(difference.translation().norm(), 2 * kRangeStep) << i;
      EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), 5e-4) << i;
    }
  }
}

TEST_F(Live, ScansAreCorrectedByTheErrorsOfTheBeams) {
  record("vlp16", "3");
  const auto write = [&](const std::string& name, const std::string& range) {
    std::ofstream(in(name)) << "version: 1\nrange: [" << range << "]\n";
  };
  write("beams.yaml", "0.012, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0");
  write("four.yaml", "0.012, 0, 0, 0");
  for (const auto& [file, exit_code] : {std::pair("beams.yaml", 0), std::pair("four.yaml", 1)}) {
    const auto program = live(std::string(file) + ".out", {"--idle", "1", "--queue", "100", "--beams", in(file)});
    ASSERT_EQ(tilth(play("4")).exit_code, 0);
    const Outcome outcome = program->wait();
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    const std::string sentence = exit_code == 0 ? "beams: corrected by " + in(file) + " (ranges up to 12 mm)"
                                                : in(file) + ": has the errors of 4 beams, but the scans are of 16";
    EXPECT_NE((outcome.out + outcome.err).find(sentence), std::string::npos) << outcome.out << outcome.err;
  }
}

TEST_F(Live, SigtermEndsItWithEveryFileWritten) {
  record("vlp16", "5");
  const auto program = live("out", {});
  const Program player(play("1"));
  while (program->running() && player.running() && poses_in("out") < 5) rest();
  program->signal(SIGTERM);
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  player.signal(SIGINT);
  EXPECT_EQ(player.wait().exit_code, 128 + SIGINT);
  const std::string summary = text_of(folder_ / "out/summary.json");
  EXPECT_NE(summary.find("\"ended\": \"interrupted\""), std::string::npos) << summary;
  EXPECT_EQ(read_kitti_poses(folder_ / "out/trajectory_kitti.txt").size(), poses_in("out"));
  EXPECT_GT(read_pcd(folder_ / "out/map.pcd").count, 1000U);
  const std::string table = text_of(folder_ / "out/scans.csv");
  EXPECT_EQ(lines_in(table), poses_in("out") + 1);
  const Outcome again = tilth({"live", "udp://" + address(), "--out", in("out")});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.err.find("--resume"), std::string::npos) << again.err;
}

TEST_F(Live, IsKilledAndGoesOn) {
  record("vlp16", "5");
  const auto program = live("out", {"--checkpoint", "0.2"});
  const Program player(play("1"));
  const auto map_is_there = [&] { return std::filesystem::exists(folder_ / "out/map.pcd"); };
  while (program->running() && player.running() && (poses_in("out") < 10 || !map_is_there())) rest();
  const std::size_t seen = poses_in("out");
  program->signal(SIGKILL);
  EXPECT_EQ(program->wait().exit_code, 128 + SIGKILL);
  player.signal(SIGINT);
  player.wait();
  const Trajectory before = read_tum(folder_ / "out/trajectory.tum");
  EXPECT_GE(before.size(), seen) << "no pose that was there is lost";
  const std::size_t points = read_pcd(folder_ / "out/map.pcd").count;

  const auto resumed = live("out", {"--resume", "--idle", "1"});
  ASSERT_EQ(tilth(play("1")).exit_code, 0);  // faster than the clock, its first stamps would lie before their arrival
  const Outcome outcome = resumed->wait();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("resumed: " + std::to_string(before.size()) + " poses"), std::string::npos) << outcome.out;
  const Trajectory all = read_tum(folder_ / "out/trajectory.tum");
  ASSERT_GT(all.size(), before.size() + 20);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(all[i].T_world_lidar.matrix(), before[i].T_world_lidar.matrix());
  EXPECT_TRUE(all[before.size()].T_world_lidar.isApprox(before.back().T_world_lidar, 1e-9));
  EXPECT_GE(read_pcd(folder_ / "out/map.pcd").count, points);
  const std::string table = text_of(folder_ / "out/scans.csv");
  EXPECT_NEAR(double(lines_in(table)), double(all.size() + 1), 1.0);
}

TEST_F(Live, AFolderIsWrittenByOneAtATime) {
  const auto program = live("out", {});
  for (const char* way : {"--resume", "--force"}) {
    const Outcome second = tilth({"live", "udp://127.0.0.1:0", "--out", in("out"), way, "--idle", "0.2"});
    EXPECT_EQ(second.exit_code, 1);
    EXPECT_NE(second.err.find(in("out/.lock") + ": is locked"), std::string::npos) << second.err;
  }
  const Outcome run = tilth({"run", "sim://corridor?duration=0.5", "--out", in("out")});
  EXPECT_NE(run.err.find(in("out/.lock") + ": is locked"), std::string::npos) << run.err;
  program->signal(SIGKILL);
  program->wait();
  EXPECT_EQ(tilth({"run", "sim://corridor?duration=0.5", "--out", in("out")}).exit_code, 0) << "free again";
}

TEST_F(Live, WithLoopClosureTheWayIsCorrectedAtTheEnd) {
  record("vlp16", "5");
  const auto program = live("out", {"--idle", "1", "--queue", "100", "--loop-closure", "--set",
                                    "loop.keyframe.distance=0.1", "--set", "loop.detect.min_path=2"});
  ASSERT_EQ(tilth(play("1")).exit_code, 0);
  const Outcome outcome = program->wait();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Trajectory before = read_tum(folder_ / "out/trajectory_odometry.tum");
  const Trajectory after = read_tum(folder_ / "out/trajectory.tum");
  ASSERT_GT(before.size(), 40U);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_GE(lines_in(text_of(folder_ / "out/closures.csv")), 2U) << "no pair was looked at";
  EXPECT_NE(text_of(folder_ / "out/summary.json").find("\"loop_closure\""), std::string::npos);
  bool corrected = false;
  for (std::size_t i = 0; i < after.size(); ++i)
    corrected = corrected || after[i].T_world_lidar.matrix() != before[i].T_world_lidar.matrix();
  EXPECT_TRUE(corrected) << "trajectory.tum is what was appended scan by scan";
  const Outcome both = tilth({"live", "udp://" + address(), "--out", in("b"), "--resume", "--loop-closure"});
  EXPECT_GT(both.exit_code, 100);
  EXPECT_NE(both.err.find("--resume excludes --loop-closure"), std::string::npos) << both.err;
}

TEST_F(Live, BadArgumentsAreRefused) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& reason) {
    const Outcome outcome = tilth(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << reason;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
  };
  refused({"live", "some.pcap", "--out", in("a")}, "udp://[ADDRESS]:PORT");
  refused({"live", "udp://" + address(), "--idle", "0.2", "--out", in("a")}, "no packet came");
  refused({"live", "ros2:/points", "--library", in("libtilth_ros2.so"), "--out", in("a")}, "cannot be loaded");
  refused({"live", "ros2:/points", "--host", "1.2.3.4", "--out", in("a")}, "means nothing for a topic of ROS 2");
  refused({"live", "udp://" + address(), "--reliable", "--out", in("a")}, "means nothing for packets of a sensor");
  refused({"play", in("none.pcap"), "--to", address()}, "no such file");
  refused({"play", "sim://corridor", "--to", "127.0.0.1"}, "has no port");
  refused({"play", "sim://corridor", "--to", ":2368"}, "names no computer");
  refused({"play", "sim://street?sensor=hdl64", "--to", address()}, "hdl64");
}

}  // namespace
}  // namespace tilth::app
