// Network captures through the program: simulate --format pcap, info, run.
#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

class Packets : public testing::Test {
 protected:
  Outcome simulate(const std::string& sensor, const std::string& out) const {
    return tilth({"simulate", "corridor", "--out", (folder_ / out).string(), "--format", "pcap", "--sensor", sensor,
                  "--duration", "1.5", "--quiet"});
  }

  TemporaryFolder folder_;
};

TEST_F(Packets, ASimulatedCaptureIsRunLikeTheSimulation) {
  ASSERT_EQ(simulate("leishen_c16", "sim").exit_code, 0);
  const std::string capture = (folder_ / "sim/scans.pcap").string();
  ASSERT_EQ(tilth({"run", capture, "--out", (folder_ / "packets").string(), "--quiet"}).exit_code, 0);
  ASSERT_EQ(tilth({"run", "sim://corridor?sensor=leishen_c16&duration=1.5", "--out", (folder_ / "direct").string()})
                .exit_code,
            0);
  const Trajectory packets = read_tum(folder_ / "packets/trajectory.tum");
  const Trajectory direct = read_tum(folder_ / "direct/trajectory.tum");
  ASSERT_EQ(packets.size(), direct.size());
  for (std::size_t i = 0; i < packets.size(); ++i) {
    EXPECT_NEAR(packets[i].stamp, direct[i].stamp, 3e-6);
    EXPECT_LT((packets[i].T_world_lidar.translation() - direct[i].T_world_lidar.translation()).norm(), 0.01);
  }
}

TEST_F(Packets, InfoTellsSensorCountsAndWarnings) {
  ASSERT_EQ(simulate("vlp16", "sim").exit_code, 0);
  const Outcome outcome = tilth({"info", (folder_ / "sim/scans.pcap").string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* line : {"sender 192.168.1.201: ", "sensor: Velodyne VLP-16 (vlp16)", "scans: 14 over 1.300 s",
                           "rate: 10.00 scans a second", "beams: 16", "ranges [m]:", "Warnings\n  none"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << "\n" << outcome.out;
  }
}

TEST_F(Packets, SensorsWithoutPacketsAndWrongOptionsAreRefused) {
  const Outcome hdl64 = simulate("hdl64", "none");
  EXPECT_EQ(hdl64.exit_code, 1);
  EXPECT_NE(hdl64.err.find("sensor hdl64"), std::string::npos) << hdl64.err;
  ASSERT_EQ(simulate("vlp16", "sim").exit_code, 0);
  const std::string capture = (folder_ / "sim/scans.pcap").string();
  const auto refused = [&](const std::string& source, const std::string& reason) {
    const Outcome outcome = tilth({"info", source});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
  };
  refused(capture + "?sensor=hdl64", "sensor hdl64");
  refused(capture + "?sensor=leishen_c16_v4", "1206 bytes");
  refused(capture + "?host=10.0.0.1", "192.168.1.201");
  refused(capture + "?colour=red", "colour");
  refused((folder_ / "sim/times.txt").string() + "?sensor=vlp16", "times.txt: is no folder of scans");
}

}  // namespace
}  // namespace tilth::app
