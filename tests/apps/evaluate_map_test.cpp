// `tilth evaluate-map`, `tilth score-basin` and `tilth run --prior` as their users run them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

using Json = nlohmann::json;

class TrueScene : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  void simulate(const std::string& duration) const {
    const Outcome made = tilth({"simulate", "corridor_fast", "--out", in("sim"), "--seed", "5", "--duration", duration,
                                "--quiet", "--set", "columns=450"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& word) const {
    const Outcome outcome = tilth(arguments);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }

  TemporaryFolder folder_;
};

TEST_F(TrueScene, AMapLiesOnTheSurfacesThatItWasMadeOf) {
  simulate("6");
  ASSERT_EQ(tilth({"run", in("sim"), "--out", in("run"), "--quiet"}).exit_code, 0);
  const Outcome judged = tilth({"evaluate-map", in("run"), in("sim/scene/mesh.ply"), "--json", in("map.json")});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  EXPECT_NE(judged.out.find("completeness"), std::string::npos);
  const Json found = Json::parse(text_of(folder_ / "map.json"));
  EXPECT_GT(found["points"].get<double>(), 1000);
  EXPECT_LT(found["distance_median_m"].get<double>(), 0.02);
  EXPECT_GT(found["on_surface_percent"].get<double>(), 90);
  EXPECT_GT(found["completeness_percent"].get<double>(), 20);
  expect_refused({"evaluate-map", in("run"), in("none.ply"), "--truth", in("sim/truth.tum")}, "none.ply");
  expect_refused({"evaluate-map", in("run"), in("run/map.pcd")}, "--truth");
}

TEST_F(TrueScene, APriorHelpsOrIsLeftOut) {
  simulate("2.5");
  const Outcome with_prior = tilth({"run", in("sim"), "--prior", in("sim/truth.tum"), "--out", in("run"), "--quiet"});
  EXPECT_EQ(with_prior.exit_code, 0) << with_prior.err;
  EXPECT_EQ(read_tum(folder_ / "run" / "trajectory.tum").size(), 24u);
  EXPECT_EQ(with_prior.err.find("tells of"), std::string::npos) << with_prior.err;
  std::ofstream(folder_ / "other_clock.tum") << "1e6 0 0 0 0 0 0 1\n1000100 9 0 0 0 0 0 1\n";
  const Outcome unheard = tilth({"run", in("sim"), "--prior", in("other_clock.tum"), "--out", in("c")});
  EXPECT_NE(unheard.err.find("tells of 0 of the 23 motions"), std::string::npos) << unheard.err;
  EXPECT_NE(text_of(folder_ / "c" / "summary.json").find("tells of 0 of the 23 motions"), std::string::npos);
  std::ofstream(folder_ / "one.tum") << "1 0 0 0 0 0 0 1\n";
  expect_refused({"run", in("sim"), "--prior", in("one.tum"), "--out", in("b")}, "fewer than two");
  expect_refused({"run", in("sim"), "--prior", in("none.tum"), "--out", in("b")}, "none.tum");
  expect_refused({"run", in("sim"), "--pipeline", "floam", "--prior", in("sim/truth.tum"), "--out", in("b")},
                 "has no use for a prior");
}

TEST_F(TrueScene, StartsNearTheTruthAreFoundByGicpAndByIcp) {
  const Outcome basin = tilth({"score-basin", "corridor", "--seed", "5", "--starts", "12", "--scan", "60"});
  ASSERT_EQ(basin.exit_code, 0) << basin.err;
  for (const char* word : {"GICP  found", "ICP   found", "of 12", "45.0 deg", "up to 2.0"})
    EXPECT_NE(basin.out.find(word), std::string::npos) << word << " in\n" << basin.out;
  expect_refused({"score-basin", "corridor", "--scan", "10"}, "--scan");
  expect_refused({"score-basin", "nowhere"}, "nowhere");
}

}  // namespace
}  // namespace tilth::app
