// tilth live --map over the loopback: found in a saved map while the sensor sends; killed, what was said stays.
#include <csignal>
#include <memory>

#include <gtest/gtest.h>

#include "live_program.hpp"
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

class LiveInMap : public Live {
 protected:
  void SetUp() override {
    record("vlp16", "5");
    ASSERT_EQ(tilth({"run", in("sim/scans.pcap"), "--out", in("run"), "--save-map", in("map")}).exit_code, 0);
  }
  std::string map() const { return in("map"); }
  std::size_t rows_in(const std::string& out) const { return lines_in(text_of(folder_ / out / "localization.csv")); }
};

TEST_F(LiveInMap, TheSensorIsFoundAndFollowed) {
  const auto program = live("found", {"--map", map(), "--idle", "1", "--queue", "100"});
  ASSERT_EQ(tilth(play("2")).exit_code, 0);
  const Outcome outcome = program->wait();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  const Trajectory found = read_tum(folder_ / "found/trajectory.tum"),
                   mapped = read_tum(folder_ / "run/trajectory.tum");
  ASSERT_GT(found.size(), 25U);
  EXPECT_EQ(rows_in("found"), 1 + mapped.size()) << "a row a scan";
  const std::size_t before = mapped.size() - found.size();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Pose error = mapped[before + i].T_world_lidar.inverse() * found[i].T_world_lidar;
    EXPECT_LT(error.translation().norm(), 0.03) << i;
  }
  EXPECT_NE(text_of(folder_ / "found/summary.json").find("\"localization\""), std::string::npos);
}

TEST_F(LiveInMap, WhatWasSaidStaysWhenItIsKilled) {
  const auto program = live("killed", {"--map", map()});
  const Program player(play("1"));
  while (program->running() && player.running() && poses_in("killed") < 3) rest();
  program->signal(SIGKILL);
  program->wait();
  player.signal(SIGINT);
  player.wait();
  EXPECT_GE(read_tum(folder_ / "killed/trajectory.tum").size(), 3U);
  EXPECT_GT(rows_in("killed"), 3U);
}

TEST_F(LiveInMap, WhatMeansNothingThereIsRefused) {
  for (const std::string flag : {"--grid", "--learn-beams", "--resume", "--loop-closure", "--level", "--keep-moving"}) {
    const Outcome outcome =
        tilth({"live", "udp://127.0.0.1:0", "--out", in("no"), "--map", map(), flag, "--duration", "0.1"});
    EXPECT_NE(outcome.exit_code, 0) << flag;
    EXPECT_NE(outcome.err.find(flag), std::string::npos) << outcome.err;
  }
  const Outcome checkpoint =
      tilth({"live", "udp://127.0.0.1:0", "--out", in("no"), "--map", map(), "--checkpoint", "5"});
  EXPECT_NE(checkpoint.err.find("--map excludes --checkpoint"), std::string::npos) << checkpoint.err;
  const Outcome none = tilth({"live", "udp://127.0.0.1:0", "--out", in("no"), "--map", in("none")});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("is no folder of a map"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace tilth::app
