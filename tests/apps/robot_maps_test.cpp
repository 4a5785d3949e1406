// Maps without ghosts, floor plans and verdicts, by the program.
#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"
#include <tilth/io/output_file.hpp>

namespace tilth::app {
namespace {

class RobotMaps : public testing::Test {
 protected:
  Outcome run(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", scans_.string(), "--out", (folder_ / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tilth(arguments);
  }

  TemporaryFolder folder_;
  std::filesystem::path scans_ = folder_ / "room";
};

TEST_F(RobotMaps, MovingPointsHaveAFileUnlessTheyStay) {
  write_room(scans_, 3);
  ASSERT_EQ(run("clean").exit_code, 0);
  ASSERT_EQ(run("raw", {"--keep-moving"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "clean" / "moving.pcd"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "raw" / "moving.pcd"));
  EXPECT_EQ(text_of(folder_ / "clean" / "trajectory.tum"), text_of(folder_ / "raw" / "trajectory.tum"));
}

TEST_F(RobotMaps, FloorPlanIsWrittenWhereAskedForAndItsOptionsAreHeldToBounds) {
  write_room(scans_, 3);
  ASSERT_EQ(run("plan", {"--grid", "--grid-resolution", "0.1"}).exit_code, 0);
  EXPECT_EQ(text_of(folder_ / "plan" / "map.pgm").substr(0, 3), "P5\n");
  EXPECT_NE(text_of(folder_ / "plan" / "map.yaml").find("resolution: 0.1\n"), std::string::npos);
  const Outcome band = run("band", {"--grid", "--grid-low", "3", "--grid-high", "1"});
  EXPECT_EQ(band.exit_code, 1);
  EXPECT_NE(band.err.find("grid_low"), std::string::npos) << band.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "band" / "map.pcd"));
  EXPECT_NE(run("fine", {"--grid-resolution", "0.001"}).exit_code, 0);
}

TEST_F(RobotMaps, AssessJudgesARunAndRefusesWhatIsNone) {
  write_room(scans_, 3);
  ASSERT_EQ(run("out").exit_code, 0);
  const Outcome good = tilth({"assess", (folder_ / "out").string()});
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_NE(good.out.find("verdict                 good"), std::string::npos) << good.out;
  const Outcome two = tilth({"assess", (folder_ / "out").string(), (folder_ / "out").string()});
  EXPECT_NE(two.out.find("sharpest"), std::string::npos) << two.out;
  EXPECT_EQ(tilth({"assess", scans_.string()}).exit_code, 1);
  const std::string table = text_of(folder_ / "out" / "scans.csv");
  write_text(folder_ / "out" / "scans.csv", table.substr(0, table.size() / 2));
  EXPECT_EQ(tilth({"assess", (folder_ / "out").string()}).exit_code, 1);
}

TEST(ScoreMoving, SaysWhatWasTakenOut) {
  const Outcome outcome = tilth({"score-moving", "corridor", "--duration", "2", "--seed", "5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* row : {"moving", "surfaces", "edges and poles", "ms of CPU"})
    EXPECT_NE(outcome.out.find(row), std::string::npos) << row;
  EXPECT_EQ(tilth({"score-moving", "nowhere"}).exit_code, 1);
}

}  // namespace
}  // namespace tilth::app
