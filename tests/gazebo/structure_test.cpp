// Models within models, frames, includes by several ways, saved states; and files that are no worlds.
#include <cmath>
#include <cstdlib>
#include <random>

#include "made_world.hpp"

namespace tilth {
namespace {

const Eigen::Vector3d kOrigin(0, 0, 0), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

const std::string kBoxLink =
    "<link name=\"link\"><visual name=\"visual\"><geometry><box><size>1 1 1</size></box></geometry></visual></link>";

class Structure : public MadeWorld {};

TEST_F(Structure, PosesAddUpThroughNestedModels) {
  write_world(
      "<model name=\"outer\"><pose>1 0 0 0 0 1.570796326795</pose><model name=\"inner\"><pose>4 0 0 0 0 0</pose>"
      "<link name=\"l\"><pose>0 0 2 0 0 0</pose><visual name=\"v\"><pose>1 0 0 0 0 0</pose><geometry>" +
      kUnitBox + "</geometry></visual></link></model></model>");
  load();
  EXPECT_NEAR(range({1, 0, 2}, kY), 4.5, kExact);  // 4 + 1 along the outer model's x, which points along y
  EXPECT_EQ(hit({1, 0, 2}, kY).surface->name, "outer/inner/l/v");
}

TEST_F(Structure, PosesMayBeRelativeToFrames) {
  write_world(
      "<frame name=\"corner\"><pose>0 0 1 0 0 3.14159265358979</pose></frame>"
      "<model name=\"m\"><pose relative_to=\"corner\">3 0 0 0 0 0</pose><frame name=\"up\"><pose>0 0 2 0 0 0</pose>"
      "</frame><link name=\"a\"/><link name=\"b\"><pose relative_to=\"up\">0 0 1 0 0 0</pose><visual name=\"v\">"
      "<geometry>" +
      kUnitBox + "</geometry></visual></link></model>");
  load();
  EXPECT_NEAR(range({0, 0, 4}, -kX), 2.5, kExact);
}

TEST_F(Structure, ModelsAreIncludedFromEveryFolderThatMayHoldThem) {
  write_model("given/a", kBoxLink);
  write_model("from_variable/b", kBoxLink, "1.4");
  write_model("models/c", kBoxLink, "1.6");
  write_world(
      "<include><uri>model://a</uri><pose>3 0 0 0 0 0</pose></include>"
      "<include><uri>model://b</uri><pose>0 4 0 0 0 0</pose></include>"
      "<include><uri>model://c</uri><name>renamed</name><pose>0 0 5 0 0 0</pose></include>");
  ::setenv("GAZEBO_MODEL_PATH", ("/nowhere:" + (folder_ / "from_variable").string()).c_str(), 1);
  load({(folder_ / "given").string()});
  ::unsetenv("GAZEBO_MODEL_PATH");
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  EXPECT_NEAR(range(kOrigin, kX), 2.5, kExact);
  EXPECT_NEAR(range(kOrigin, kY), 3.5, kExact);
  EXPECT_NEAR(range(kOrigin, kZ), 4.5, kExact);
  EXPECT_EQ(hit(kOrigin, kZ).surface->name, "renamed/link/visual");
}

TEST_F(Structure, AnIncludedModelBringsItsMeshAndItsOwnIncludes) {
  write("models/lamp/meshes/lamp.obj", "v 1 -1 -1\nv 1 1 -1\nv 1 0 2\nf 1 2 3\n");
  write_model("models/lamp",
              "<link name=\"l\"><visual name=\"v\"><geometry><mesh><uri>meshes/lamp.obj</uri></mesh>"
              "</geometry></visual></link>");
  write_model("models/post", "<include><uri>model://lamp</uri><pose>1 0 0 0 0 0</pose></include><link name=\"foot\"/>");
  write_world("<include><uri>model://post</uri><pose>1 0 0 0 0 0</pose></include>");
  load();
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  EXPECT_NEAR(range(kOrigin, kX), 3, kExact);
}

TEST_F(Structure, AMissingModelIsNamedAndLeftOut) {
  write_model("models/post", "<include><uri>model://lost_lamp</uri></include>" + kBoxLink);
  write_world("<include><uri>model://lost_table</uri></include><include><uri>model://post</uri></include>" +
              model("b", "3 0 0 0 0 0", kUnitBox));
  load();
  EXPECT_TRUE(warned_of("model://lost_table"));
  EXPECT_TRUE(warned_of("model://lost_lamp"));
  EXPECT_NEAR(range({1, 0, 0}, kX), 1.5, kExact);
}

TEST_F(Structure, GazebosOwnGroundPlaneAndSunNeedNoFile) {
  write_world("<include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>");
  load();
  EXPECT_TRUE(warnings_.empty());
  EXPECT_NEAR(range({40, 40, 2}, -kZ), 2, kExact);
  write_world(
      "<include><uri>https://far.away/models/Sun</uri></include>"
      "<include><uri>https://far.away/models/Ground Plane</uri></include>");
  load();
  EXPECT_TRUE(warnings_.empty());
  EXPECT_NEAR(range({40, 40, 2}, -kZ), 2, kExact);
}

TEST_F(Structure, ModelsThatIncludeThemselvesAreNamedAndLeftOut) {
  write_model("models/snake", "<include><uri>model://tail</uri></include>" + kBoxLink);
  write_model("models/tail", "<include><uri> model://snake </uri></include>" + kBoxLink);
  write_world("<include><uri>model://snake</uri></include>" + model("b", "3 0 0 0 0 0", kUnitBox));
  load();
  EXPECT_TRUE(warned_of("model://snake includes itself"));
  EXPECT_NEAR(range({1, 0, 0}, kX), 1.5, kExact);
}

TEST_F(Structure, ASavedStateSaysWhereModelsRest) {
  write_world(model("crate", "3 0 5 0 0 0", kUnitBox) +
                  "<state world_name=\"w\"><model name=\"crate\"><pose>4 0 0 0 0 0"
                  "</pose><link name=\"link\"><pose>4 0 0 0 0 0</pose></link></model></state>",
              "1.6");
  load();
  EXPECT_NEAR(range(kOrigin, kX), 3.5, kExact);
}

TEST_F(Structure, AModelFileIsAWorldOfOneModel) {
  write("test.world", "<?xml version=\"1.0\"?><sdf version=\"1.6\">" + model("m", "2 0 0 0 0 0", kUnitBox) + "</sdf>");
  load();
  EXPECT_NEAR(range(kOrigin, kX), 1.5, kExact);
}

TEST_F(Structure, AClassicWorldMayBeginWithAComment) {
  write("chair.obj", "v 1 -1 -1\nv 1 1 -1\nv 1 0 2\nf 1 2 3\n");
  write("test.world", "<!-- Usage -->\n<?xml version=\"1.0\" ?>\n<sdf version=\"1.5\"><world name=\"w\">" +
                          model("m", "2 0 0 0 0 0", "<mesh><uri>chair.obj</uri></mesh>") + "</world></sdf>");
  load();
  EXPECT_TRUE(warnings_.empty());
  EXPECT_NEAR(range(kOrigin, kX), 3, kExact);
}

TEST_F(Structure, WhatIsNoWorldIsRefusedByName) {
  expect_refused("no such file");
  write("test.world", std::string("\x00\x01\xff garbage", 11));
  expect_refused("<sdf>");
  write("test.world", "<sdf version=\"1.9\"><world name=\"w\"><model");
  expect_refused("XML");
  write("test.world", "<sdf version=\"1.9\"></sdf>");
  expect_refused("<world>");
  write_world(model("m", "0 0 0 0 0 0", "<box><size>1 1 q</size></box>"));
  expect_refused("geometry/box/size");
  write_world("<light name=\"l\" type=\"point\"/>");
  expect_refused("nothing that a beam could meet");
  write_world("<include><uri>model://lost_table</uri></include>");
  expect_refused("model://lost_table");
  std::filesystem::remove(folder_ / "test.world");
  std::filesystem::create_directories(folder_ / "test.world");
  expect_refused("no file that can be read");
}

TEST_F(Structure, AFolderOfModelsThatIsMissingIsRefused) {
  write_world(model("m", "0 0 0 0 0 0", kUnitBox));
  EXPECT_THROW(read({"/nowhere/at/all"}), Error);
}

/// Every cut and every changed byte gives a world or an Error, and nothing else.
TEST_F(Structure, DamagedFilesNeverBringItDown) {
  write_world(
      model("a", "1 2 3 0.1 0.2 0.3", kUnitBox) +
          "<actor name=\"p\"><script><trajectory id=\"0\" type=\"walk\"><waypoint><time>1</time><pose>1 2 3 0 0 0"
          "</pose></waypoint></trajectory></script></actor><include><uri>model://b</uri></include>",
      "1.6");
  std::ifstream in(folder_ / "test.world", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::mt19937 random(7);
  int read_anyway = 0;
  for (int i = 0; i < 45; ++i) {
    std::string text = whole;
    if (i % 3 == 0) text.resize(random() % text.size());
    for (int k = 0; i % 3 != 0 && k < i % 3; ++k) text[random() % text.size()] = char(random() % 256);
    write("test.world", text);
    try {
      read_anyway += read().mesh.triangles.empty() ? 0 : 1;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(read_anyway, 0);
}

}  // namespace
}  // namespace tilth
