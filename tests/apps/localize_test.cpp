// Whole commands: a drive becomes a map, another drive is found in it, and what is no map is refused.
#include <cmath>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth::app {
namespace {

constexpr const char* kMapped = "sim://office?seed=71&world_seed=7&columns=600&duration=30";
constexpr const char* kDriven = "sim://office?seed=72&world_seed=7&columns=600&duration=20&changed=0.2";

/// One map for all tests of this file.
class LocalizeCommand : public testing::Test {
 public:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    made_ = tilth({"run", kMapped, "--out", (*folder_ / "run").string(), "--save-map", map()});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string map() { return (*folder_ / "map").string(); }

 protected:
  void SetUp() override { ASSERT_EQ(made_.exit_code, 0) << made_.err; }

  inline static std::unique_ptr<TemporaryFolder> folder_;
  inline static Outcome made_;
};

Trajectory truth_of(const std::string& scene, const OptionValues& values) {
  return Simulator(scene, simulation_options(scene, values)).truth();
}

TEST_F(LocalizeCommand, FindsAnotherDriveInTheMap) {
  const std::filesystem::path out = *folder_ / "found";
  const Outcome outcome = tilth({"localize", kDriven, "--map", map(), "--out", out.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  const OptionValues same{{"world_seed", "7"}, {"columns", "600"}};
  OptionValues mapped = same, driven = same;
  mapped.insert({{"seed", "71"}, {"duration", "30"}});
  driven.insert({{"seed", "72"}, {"duration", "20"}});
  const Trajectory truth = truth_of("office", driven), found = read_tum(out / "trajectory.tum");
  const double first = read_tum(*folder_ / "run/trajectory.tum").front().stamp;
  const Pose T_world_map = interpolate(truth_of("office", mapped), first);
  ASSERT_GT(found.size(), 150U);
  double worst = 0;
  for (const StampedPose& pose : found) {
    const Pose error = (T_world_map.inverse() * interpolate(truth, pose.stamp)).inverse() * pose.T_world_lidar;
    worst = std::max(worst, error.translation().norm());
  }
  EXPECT_LT(worst, 0.05);
  const std::string summary = text_of(out / "summary.json"), table = text_of(out / "localization.csv");
  EXPECT_NE(summary.find("\"localization\""), std::string::npos);
  EXPECT_EQ(lines_in(table), 1 + Simulator("office", simulation_options("office", driven)).size());
  EXPECT_GT(lines_in(text_of(out / "hypotheses.csv")), 1U);
  EXPECT_GT(std::filesystem::file_size(out / "report.html"), 1000U);
}

TEST_F(LocalizeCommand, DoesNotFindAnotherBuilding) {
  const std::filesystem::path out = *folder_ / "elsewhere";
  const Outcome outcome = tilth({"localize", "sim://hospital?seed=73&columns=600&duration=9", "--map", map(), "--out",
                                 out.string(), "--set", "localize.retry=2"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err << outcome.out;
  EXPECT_EQ(lines_in(text_of(out / "trajectory.tum")), 0U);
}

TEST_F(LocalizeCommand, TellsAndExportsWhatAMapHolds) {
  const Outcome info = tilth({"map", "info", map()});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("all whole"), std::string::npos) << info.out;
  const std::filesystem::path cloud = *folder_ / "cloud.pcd";
  const Outcome exported = tilth({"map", "export", map(), cloud.string()});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_GT(read_pcd(cloud).count, 1000U);
  EXPECT_EQ(tilth({"map", "export", map(), (*folder_ / "cloud.txt").string()}).exit_code, 1);
}

TEST_F(LocalizeCommand, RefusesWhatIsNoMap) {
  const std::string out = (*folder_ / "no").string();
  const Outcome missing = tilth({"localize", kDriven, "--map", (*folder_ / "none").string(), "--out", out});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("is no folder of a map"), std::string::npos) << missing.err;
  const Outcome option = tilth({"localize", kDriven, "--map", map(), "--out", out, "--set", "localize.no_such=1"});
  EXPECT_EQ(option.exit_code, 1);
  EXPECT_NE(option.err.find("localize.no_such"), std::string::npos) << option.err;
  const Outcome here = tilth({"run", kMapped, "--out", out, "--save-map", (*folder_ / "run").string()});
  EXPECT_EQ(here.exit_code, 1);
  EXPECT_NE(here.err.find("is no map"), std::string::npos) << here.err;
}

}  // namespace
}  // namespace tilth::app
