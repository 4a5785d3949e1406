// Actors walk where their scripts say, at the times they say, on what ground there is.
#include <cmath>
#include <numbers>

#include "made_world.hpp"

namespace tilth {
namespace {

std::string waypoint(double time, const std::string& pose) {
  return "<waypoint><time>" + std::to_string(time) + "</time><pose>" + pose + "</pose></waypoint>";
}

std::string actor(const std::string& pose, const std::string& script) {
  return "<actor name=\"walker\"><pose>" + pose + "</pose>" +
         (script.empty() ? "" : "<script>" + script + "</script>") + "</actor>";
}

std::string walk(const std::string& waypoints) {
  return "<trajectory id=\"0\" type=\"walk\">" + waypoints + "</trajectory>";
}

const std::string kFloor = "<plane><normal>0 0 1</normal><size>40 40</size></plane>";
const Eigen::Vector3d kY(0, 1, 0);

class Actors : public MadeWorld {
 protected:
  void load_with(const std::string& actors, const std::string& version = "1.9") {
    write_world(model("floor", "0 0 0 0 0 0", kFloor) + actors, version);
    load();
  }
  Pose pose(double time) const { return pose_at(world_->movers().scripted.at(0), time); }
  Eigen::Vector3d position(double time) const { return pose(time).translation(); }
  double yaw(double time) const { return std::atan2(pose(time).linear()(1, 0), pose(time).linear()(0, 0)); }
};

const std::string kThere = waypoint(0, "0 5 1 0 0 0") + waypoint(4, "8 5 1 0 0 0") + waypoint(5, "8 5 1 0 0 3.141592");

TEST_F(Actors, WalkFromWayPointToWayPointAndTurn) {
  load_with(actor("0 0 0 0 0 0", "<loop>false</loop>" + walk(kThere)));
  EXPECT_TRUE(position(0).isApprox(Eigen::Vector3d(0, 5, 0), 1e-9)) << position(0);  // feet on the floor
  EXPECT_TRUE(position(1).isApprox(Eigen::Vector3d(2, 5, 0), 1e-9));
  EXPECT_NEAR(std::abs(yaw(4.5)), std::numbers::pi / 2, 1e-5);
  EXPECT_TRUE(position(100).isApprox(Eigen::Vector3d(8, 5, 0), 1e-9));
}

TEST_F(Actors, BeginAnewAfterTheirDelay) {
  load_with(actor("0 0 0 0 0 0", "<loop>true</loop><delay_start>3</delay_start>" + walk(kThere)));
  EXPECT_TRUE(position(2.9).isApprox(Eigen::Vector3d(0, 5, 0), 1e-9));
  EXPECT_TRUE(position(4).isApprox(Eigen::Vector3d(2, 5, 0), 1e-9));
  EXPECT_TRUE(position(4 + 3 * 8).isApprox(Eigen::Vector3d(2, 5, 0), 1e-9));  // rounds of 3 + 5 s
}

TEST_F(Actors, AreMetWhereTheyAreWhenTheRayIsCast) {
  load_with(actor("0 0 0 0 0 0", walk(kThere)));
  const Hit at_start = hit({0, 0, 1.1}, kY, 0), later = hit({0, 0, 1.1}, kY, 2), there = hit({4, 0, 1.1}, kY, 2);
  EXPECT_TRUE(at_start.moving);
  EXPECT_NEAR(at_start.distance, 5 - 0.16, 0.15);  // a trunk of 16 cm radius, or an arm beside it
  EXPECT_FALSE(later.met());
  EXPECT_TRUE(there.moving);
  for (double time = 0; time < 25; time += 0.37) {  // and no ball about a walker leaves one out
    const Eigen::Vector3d feet = position(time);
    EXPECT_TRUE(hit(feet + Eigen::Vector3d(0, -4, 1.2), kY, time).moving) << time;
  }
}

TEST_F(Actors, StandWithoutAScript) {
  load_with(actor("3 4 1.25 0 0 1.5708", ""));
  EXPECT_TRUE(position(7).isApprox(Eigen::Vector3d(3, 4, 0), 1e-9));
  EXPECT_NEAR(yaw(7), std::numbers::pi / 2, 1e-4);
}

TEST_F(Actors, TakeWayPointsInTheirOwnFrameSinceSdf17AndInTheWorldBefore) {
  const std::string turned =
      actor("1 0 0 0 0 1.570796326795", walk(waypoint(0, "2 0 1 0 0 0") + waypoint(9, "6 0 1 0 0 0")));
  load_with(turned, "1.9");
  EXPECT_TRUE(position(0).isApprox(Eigen::Vector3d(1, 2, 0), 1e-6)) << position(0);
  load_with(turned, "1.6");
  EXPECT_TRUE(position(0).isApprox(Eigen::Vector3d(2, 0, 0), 1e-6)) << position(0);
}

TEST_F(Actors, StandOnTheGroundUnderThemNotOnWhatHangsAbove) {
  load_with(model("platform", "3 4 0.25 0 0 0", "<box><size>2 2 0.5</size></box>") +
            model("roof", "3 4 3 0 0 0", "<box><size>2 2 0.5</size></box>") + actor("3 4 1.4 0 0 0", ""));
  EXPECT_NEAR(position(0).z(), 0.5, 1e-9);
}

TEST_F(Actors, OfSeveralTrajectoriesWalkOneAfterTheOther) {
  load_with(actor("0 0 0 0 0 0", "<loop>false</loop>" + walk(waypoint(0, "0 5 0 0 0 0") + waypoint(2, "4 5 0 0 0 0")) +
                                     "<trajectory id=\"1\" type=\"walk\">" + waypoint(2, "4 9 0 0 0 0") +
                                     "</trajectory>"));
  EXPECT_TRUE(position(3).isApprox(Eigen::Vector3d(4, 7, 0), 1e-9)) << position(3);
}

}  // namespace
}  // namespace tilth
