// Whole commands: a drive becomes a map, another drive is found in it, and what is no map is refused.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "program.hpp"
#include "support/real_recording.hpp"
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

TEST_F(LocalizeCommand, BeginsAnewWhenItIsFound) {
  const std::filesystem::path out = *folder_ / "starts";
  tilth({"localize", kDriven, "--map", map(), "--out", out.string(), "--max-scans", "50", "--restart-when-found"});
  std::ifstream table(out / "localization.csv");
  std::size_t located = 0, begun = 0;
  for (std::string line; std::getline(table, line);) {
    const bool is_located = line.find(",located,") != std::string::npos;
    EXPECT_FALSE(is_located && line.find(",located,1,") != std::string::npos) << "from one scan: " << line;
    located += is_located, begun += line.find("ing,1,") != std::string::npos;
  }
  EXPECT_GE(located, 2U);
  EXPECT_GE(begun, located);
  EXPECT_LE(begun, located + 1);
}

TEST_F(LocalizeCommand, TellsWhereTheBaseIs) {
  const auto localized = [&](const std::string& name, std::vector<std::string> more) {
    const std::string out = (*folder_ / name).string();
    std::vector<std::string> arguments{"localize", kDriven, "--map", map(), "--out", out, "--max-scans", "60"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = tilth(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_tum(out + "/trajectory.tum");
  };
  const Trajectory lidar = localized("of_lidar", {});
  const Trajectory base = localized("of_base", {"--base-from-lidar", "0.5,0,0.3,0,0,90"});
  const Pose T_base_lidar(Eigen::Translation3d(0.5, 0, 0.3) *
                          Eigen::AngleAxisd(std::acos(-1.0) / 2, Eigen::Vector3d::UnitZ()));
  ASSERT_EQ(lidar.size(), base.size());
  ASSERT_GT(lidar.size(), 20U);
  for (std::size_t i = 0; i < lidar.size(); ++i)
    EXPECT_TRUE((base[i].T_world_lidar * T_base_lidar).isApprox(lidar[i].T_world_lidar, 1e-9)) << i;
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
  EXPECT_EQ(tilth({"map", "export", map(), cloud.string(), "--origin", "32N,1,2,3"}).exit_code, 1);
}

TEST_F(LocalizeCommand, ExportsAFloorPlan) {
  const std::filesystem::path plan = *folder_ / "plan.pgm";
  const Outcome made = tilth({"map", "export", map(), plan.string(), "--grid", "--grid-resolution", "0.1"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(text_of(plan).substr(0, 3), "P5\n");
  const std::string about = text_of(*folder_ / "plan.yaml");
  EXPECT_NE(about.find("image: plan.pgm\n"), std::string::npos) << about;
  EXPECT_NE(about.find("resolution: 0.1\n"), std::string::npos) << about;
  EXPECT_EQ(tilth({"map", "export", map(), plan.string()}).exit_code, 1) << "a cloud of that name";
  const Outcome wrong = tilth({"map", "export", map(), (*folder_ / "plan.pcd").string(), "--grid"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find(".pgm or .yaml"), std::string::npos) << wrong.err;
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

TEST_F(LocalizeCommand, GoesOnWithAMap) {
  const std::string both = (*folder_ / "both").string(), out = (*folder_ / "next").string();
  const Outcome run = tilth({"run", kDriven, "--out", out, "--map", map(), "--save-map", both});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Outcome info = tilth({"map", "info", both});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("seed=71"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("seed=72"), std::string::npos) << info.out;
  EXPECT_FALSE(std::filesystem::exists(both + ".new"));
  EXPECT_EQ(text_of(std::filesystem::path(out) / "map_changes.csv").substr(0, 13), "change,x,y,z,");
  const std::string elsewhere = (*folder_ / "elsewhere_map").string();
  const Outcome apart = tilth(
      {"run", "sim://plaza?seed=74&columns=400&duration=8", "--out", out, "--map", map(), "--save-map", elsewhere});
  EXPECT_EQ(apart.exit_code, 1);
  EXPECT_NE(apart.err.find("do not overlap"), std::string::npos) << apart.err;
  EXPECT_FALSE(std::filesystem::exists(elsewhere));
}

TEST_F(LocalizeCommand, MakesAMapOfACloud) {
  const std::string cloud = (*folder_ / "bare.pcd").string(), imported = (*folder_ / "imported").string();
  ASSERT_EQ(tilth({"map", "export", map(), cloud, "--map-voxel", "0.05"}).exit_code, 0);
  const Outcome made = tilth({"map", "import", cloud, "--out", imported});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(tilth({"map", "info", imported}).exit_code, 0);
  const std::string survey = (*folder_ / "survey.las").string(), other = (*folder_ / "of_survey").string();
  ASSERT_EQ(tilth({"map", "export", map(), survey, "--map-voxel", "0.05"}).exit_code, 0);
  const Outcome of_survey = tilth({"map", "import", survey, "--out", other});
  ASSERT_EQ(of_survey.exit_code, 0) << of_survey.err;
  EXPECT_NEAR(std::stod(of_survey.out), std::stod(made.out), 0.05 * std::stod(made.out)) << "places";
  const std::string utm = "32N,400123,5600300,50";
  ASSERT_EQ(tilth({"map", "export", map(), survey, "--map-voxel", "0.05", "--origin", utm}).exit_code, 0);
  const Outcome in_utm = tilth({"map", "import", survey, "--out", other});
  ASSERT_EQ(in_utm.exit_code, 0) << in_utm.err;
  EXPECT_NE(tilth({"map", "info", other}).out.find("survey.las, less 400000 5600000 0 m"), std::string::npos);
  const Outcome wrong = tilth({"map", "import", (*folder_ / "cloud.csv").string(), "--out", imported});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find(".pcd, .ply or .las"), std::string::npos) << wrong.err;
}

/// Scans `from` to `to` of a folder of scans with times, as a folder of its own.
void cut_out(const std::filesystem::path& whole, std::size_t from, std::size_t to, const std::filesystem::path& part) {
  std::filesystem::create_directories(part / "scans");
  for (std::size_t i = from; i <= to; ++i) {
    std::string name = std::to_string(i);
    name = std::string(6 - name.size(), '0') + name + ".pcd";
    std::filesystem::create_symlink(std::filesystem::absolute(whole / "scans" / name), part / "scans" / name);
  }
  std::ifstream times(whole / "times.txt");
  std::ofstream some(part / "times.txt");
  std::string line;
  for (std::size_t i = 0; std::getline(times, line);) {
    if (line.starts_with('#')) continue;
    if (i >= from && i <= to) some << line << '\n';
    ++i;
  }
}

TEST(LocalizeReal, FindsAWayDrivenBackTheOtherWay) {
  const std::filesystem::path loop = recording("vlp16-outdoor-loop");
  NEEDS(loop);
  const TemporaryFolder folder;
  cut_out(loop, 0, 200, folder / "first");
  cut_out(loop, 340, 405, folder / "back");
  const std::string whole = (folder / "whole").string(), map = (folder / "map").string();
  ASSERT_EQ(tilth({"run", loop.string(), "--out", whole, "--loop-closure"}).exit_code, 0);
  ASSERT_EQ(
      tilth({"run", (folder / "first").string(), "--out", (folder / "out").string(), "--save-map", map}).exit_code, 0);
  const Outcome outcome = tilth({"localize", (folder / "back").string(), "--map", map, "--out",
                                 (folder / "found").string(), "--restart-every", "30"});
  ASSERT_EQ(outcome.exit_code, 3) << outcome.err;  // the last start has too few scans
  const Trajectory expected = read_tum(folder / "whole/trajectory.tum"),
                   found = read_tum(folder / "found/trajectory.tum");
  ASSERT_GE(found.size(), 30U);
  for (const StampedPose& pose : found) {
    const Pose error = interpolate(expected, pose.stamp).inverse() * pose.T_world_lidar;
    EXPECT_LT(error.translation().norm(), 0.05) << pose.stamp;
    EXPECT_LT(angle_of(error), 0.01) << pose.stamp;
  }
}

}  // namespace
}  // namespace tilth::app
