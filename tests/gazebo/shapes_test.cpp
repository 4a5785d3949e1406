// Every kind of geometry in worlds of several SDF versions: single rays against distances worked out by hand.
#include <cmath>

#include "made_world.hpp"

namespace tilth {
namespace {

const Eigen::Vector3d kOrigin(0, 0, 0), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

class Shapes : public MadeWorld, public testing::WithParamInterface<const char*> {};

TEST_P(Shapes, BoxCylinderSphereAndPlaneStandWhereTheirPosesSay) {
  write_world(
      model("box", "5 0 0 0 0 0.785398163397", "<box><size>2 2 1</size></box>") +
          model("cylinder", "0 4 0 1.570796326795 0 0", "<cylinder><radius>0.5</radius><length>3</length></cylinder>") +
          model("sphere", "-6 1 0 0 0 0", "<sphere><radius>2</radius></sphere>") +
          model("plane", "0 0 -1.5 0 0 0", "<plane><normal>0 0 1</normal><size>20 10</size></plane>"),
      GetParam());
  load();
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  EXPECT_NEAR(range(kOrigin, kX), 5 - std::sqrt(2.0), kExact);            // an edge of the turned box
  EXPECT_NEAR(range({0, 0.5, 0}, kX), 5 - std::sqrt(2.0) + 0.5, kExact);  // its sides at 45 degrees
  EXPECT_NEAR(range(kOrigin, kY), 4 - 1.5, kExact);                       // the lid of the lying cylinder
  EXPECT_NEAR(range({3, 4, 0}, -kX), 3 - 0.5, kRound);                    // its round side
  EXPECT_NEAR(range(kOrigin, -kX), 6 - std::sqrt(4 - 1.0), kRound);       // a chord of the sphere
  EXPECT_NEAR(range({-6, 1, 5}, -kZ), 3, kRound);
  EXPECT_NEAR(range(kOrigin, -kZ), 1.5, kExact);
  EXPECT_NEAR(range({1, 0, 0}, {0, 1, -1}), 1.5 * std::sqrt(2.0), kExact);
  EXPECT_TRUE(std::isinf(range({9.9, 5.1, 0}, -kZ)));  // the plane is 20 x 10 m, not without end
  EXPECT_NEAR(range({9.9, 4.9, 0}, -kZ), 1.5, kExact);
}

TEST_P(Shapes, CollisionsStandInForMissingVisualsOnly) {
  write_world(model("wall", "3 0 0 0 0 0", kUnitBox, "collision") +
                  "<model name=\"both\"><pose>0 3 0 0 0 0</pose><link name=\"l\">"
                  "<visual name=\"v\"><geometry><box><size>1 1 1</size></box></geometry></visual>"
                  "<collision name=\"c\"><geometry><box><size>4 4 4</size></box></geometry></collision></link></model>",
              GetParam());
  load();
  EXPECT_NEAR(range(kOrigin, kX), 2.5, kExact);
  EXPECT_NEAR(range(kOrigin, kY), 2.5, kExact);
  EXPECT_EQ(hit(kOrigin, kX).surface->name, "wall/link/collision");
  EXPECT_EQ(hit(kOrigin, kY).surface->name, "both/l/v");
}

INSTANTIATE_TEST_SUITE_P(Versions, Shapes, testing::Values("1.4", "1.5", "1.6", "1.7", "1.8", "1.9"),
                         [](const auto& version) { return std::string("v1_") + std::string(version.param).substr(2); });

class Shape : public MadeWorld {};

TEST_F(Shape, CapsuleAndEllipsoid) {
  write_world(model("capsule", "3 0 0 0 0 0", "<capsule><radius>0.5</radius><length>2</length></capsule>") +
              model("ellipsoid", "0 5 0 0 0 0", "<ellipsoid><radii>0.5 2 1</radii></ellipsoid>"));
  load();
  EXPECT_NEAR(range(kOrigin, kX), 2.5, kRound);
  EXPECT_NEAR(range({3, 0, 4}, -kZ), 4 - 1.5, kRound);
  EXPECT_NEAR(range({0, 0, 1.3}, kX), 3 - 0.4, kRound);  // 0.3 above the middle of its upper cap: sqrt(0.25 - 0.09)
  EXPECT_NEAR(range(kOrigin, kY), 3, kRound);
  EXPECT_NEAR(range({3, 5, 0}, -kX), 2.5, kRound);
  EXPECT_NEAR(range({0, 5, 3}, -kZ), 2, kRound);
}

TEST_F(Shape, PlaneTurnsWithItsNormal) {
  write_world(model("plane", "4 0 0 0 0 0", "<plane><normal>-1 0 0</normal><size>2 2</size></plane>"));
  load();
  EXPECT_NEAR(range(kOrigin, kX), 4, kExact);
  EXPECT_TRUE(std::isinf(range({0, 1.1, 0}, kX)));
}

TEST_F(Shape, RoundSurfacesLieWithinAMillimetre) {
  write_world(model("tower", "30 0 0 0 0 0", "<sphere><radius>20</radius></sphere>"));
  load();
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.7 * std::sin(i * 0.77), height = 0.7 * std::cos(i * 1.13);
    const Eigen::Vector3d to(-std::cos(height) * std::cos(angle), std::cos(height) * std::sin(angle), std::sin(height));
    const Eigen::Vector3d middle(30, 0, 0);
    EXPECT_NEAR(range(middle + 25 * to, -to), 5, 1.001e-3);
  }
}

TEST_F(Shape, EdgesAreThoseOfTheSolid) {
  write_world(model("box", "3 0 0 0 0 0", "<box><size>2 2 2</size></box>") +
              model("ball", "0 5 0 0 0 0", "<sphere><radius>1</radius></sphere>") +
              model("drum", "0 -5 0 0 0 0", "<cylinder><radius>1</radius><length>2</length></cylinder>") +
              model("pole", "-5 0 0 0 0 0", "<cylinder><radius>0.05</radius><length>2</length></cylinder>"));
  load();
  EXPECT_NEAR(hit({0, 0.3, 0.2}, kX).edge_distance, 0.7, kExact);
  EXPECT_NEAR(hit({0, 0.3, -0.9}, kX).edge_distance, 0.1, kExact);
  EXPECT_TRUE(std::isinf(hit({0.2, 0, 0.1}, kY).edge_distance));  // a ball has none
  EXPECT_NEAR(hit({0.1, 0, 0.8}, -kY).edge_distance, 0.2, 1e-2);  // a drum has its rims alone
  EXPECT_GT(hit({0.1, 0, 0}, -kY).edge_distance, 0.9);
  EXPECT_EQ(hit({0, 0.01, 0.1}, -kX).edge_distance, 0);  // a pole is one as a whole
}

TEST_F(Shape, NumbersThatAreNoneLeaveTheShapeOut) {
  write_world(model("far", "0 -1e200 0 0 0 0", kUnitBox) +
              model("huge", "0 9 0 0 0 0", "<box><size>1e9 1e9 1</size></box>") +
              model("good", "3 0 0 0 0 0", kUnitBox));
  load();
  EXPECT_TRUE(warned_of("huge/link/visual"));
  EXPECT_TRUE(warned_of("far/link/visual"));
  EXPECT_NEAR(range(kOrigin, kX), 2.5, kExact);
  EXPECT_TRUE(std::isinf(range(kOrigin, kY)));
}

TEST_F(Shape, GeometryThatIsNotReadIsNamed) {
  write_world(model("hill", "0 0 0 0 0 0", "<heightmap><uri>hill.png</uri></heightmap>") +
              model("box", "3 0 0 0 0 0", kUnitBox));
  load();
  EXPECT_TRUE(warned_of("hill/link/visual: <heightmap>"));
  EXPECT_NEAR(range(kOrigin, kX), 2.5, kExact);
}

TEST_F(Shape, MaterialsSayWhatABeamDoes) {
  const auto visual = [](const std::string& y, const std::string& material) {
    return "<model name=\"m" + y + "\"><pose>3 " + y + " 0 0 0 0</pose><link name=\"l\"><visual name=\"v\"><geometry>" +
           kUnitBox + "</geometry>" + material + "</visual></link></model>";
  };
  write_world(visual("0", "") + visual("2", "<material><diffuse>1 0 0 1</diffuse></material>") +
              visual("4", "<material><pbr><metal><metalness>0.9</metalness></metal></pbr></material>") +
              visual("6", "<transparency>0.8</transparency>"));
  load();
  EXPECT_EQ(hit(kOrigin, kX).surface->material, Material::matte);
  EXPECT_EQ(hit(kOrigin, kX).surface->reflectivity, 0.5);
  EXPECT_NEAR(hit({0, 2, 0}, kX).surface->reflectivity, 0.3, 1e-6);
  EXPECT_EQ(hit({0, 4, 0}, kX).surface->material, Material::metal);
  EXPECT_EQ(hit({0, 6, 0}, kX).surface->material, Material::glass);
}

}  // namespace
}  // namespace tilth
