// Meshes that the test writes: OBJ, STL and Collada, with scale, unit, submesh; missing and broken ones are named.
#include <cmath>

#include "made_world.hpp"

namespace tilth {
namespace {

const Eigen::Vector3d kOrigin(0, 0, 0), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

/// Two squares across the x axis: "near" at x = 1 with |y|, |z| < 1, "far" at x = 2 with |y|, |z| < 2.
const std::string kObj =
    "o near\nv 1 -1 -1\nv 1 1 -1\nv 1 1 1\nv 1 -1 1\nf 1 2 3 4\n"
    "o far\nv 2 -2 -2\nv 2 2 -2\nv 2 2 2\nv 2 -2 2\nf 5 6 7 8\n";

const std::string kStl =
    "solid wall\nfacet normal -1 0 0\nouter loop\nvertex 1 -1 -1\nvertex 1 1 -1\nvertex 1 0 2\nendloop\nendfacet\n"
    "endsolid wall\n";

/// One square of half a side at x = 1 of a file that counts in centimetres and calls y its upward axis.
std::string collada() {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="wall" name="wall"><mesh>
<source id="p"><float_array id="a" count="12">100 -50 -50 100 50 -50 100 50 50 100 -50 50</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="placed"><translate>200 0 0</translate>
<instance_geometry url="#wall"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string mesh(const std::string& uri, const std::string& more = "") {
  return "<mesh><uri>" + uri + "</uri>" + more + "</mesh>";
}

class Meshes : public MadeWorld {};

TEST_F(Meshes, ObjWithScaleAndPose) {
  write("walls.obj", kObj);
  write_world(model("m", "1 0 0 0 0 1.570796326795", mesh("walls.obj", "<scale>2 1 1</scale>")));
  load();
  EXPECT_TRUE(warnings_.empty());
  EXPECT_NEAR(range({1, 0, 0}, kY), 2, kExact);        // near: x = 1, scaled by two, turned to y
  EXPECT_NEAR(range({1 + 1.5, 0, 0}, kY), 4, kExact);  // beside near: far
  EXPECT_TRUE(std::isinf(range({1 + 2.1, 0, 0}, kY)));
}

TEST_F(Meshes, SubmeshAloneAndCentred) {
  write("walls.obj", kObj);
  const std::string far = "<submesh><name>far</name><center>false</center></submesh>";
  const std::string centred = "<submesh><name>far</name><center>true</center></submesh>";
  write_world(model("m", "0 0 0 0 0 0", mesh("walls.obj", far)) +
              model("c", "-3 0 0 0 0 0", mesh("walls.obj", centred)));
  load();
  EXPECT_NEAR(range(kOrigin, kX), 2, kExact);
  EXPECT_NEAR(range(kOrigin, -kX), 3, kExact);
}

TEST_F(Meshes, SubmeshThatIsMissingIsNamed) {
  write("walls.obj", kObj);
  write_world(model("m", "0 0 0 0 0 0", mesh("walls.obj", "<submesh><name>roof</name></submesh>")) +
              model("b", "0 3 0 0 0 0", kUnitBox));
  load();
  EXPECT_TRUE(warned_of("roof"));
  EXPECT_TRUE(std::isinf(range(kOrigin, kX)));
}

TEST_F(Meshes, Stl) {
  write("wall.stl", kStl);
  write_world(model("m", "2 0 0 0 0 0", mesh("file://wall.stl")));
  load();
  EXPECT_NEAR(range(kOrigin, kX), 3, kExact);
  EXPECT_TRUE(std::isinf(range({0, 0.9, 1}, kX)));
}

TEST_F(Meshes, OfModelsNamedByFileAreFoundInTheModelPath) {
  write_model(
      "elsewhere/shop/models/shelf",
      "<link name=\"l\"><visual name=\"v\"><geometry><mesh><uri>file://models/shelf/meshes/wall.stl</uri></mesh>"
      "</geometry></visual></link>");
  write("elsewhere/shop/models/shelf/meshes/wall.stl", kStl);
  for (const char* folder : {"elsewhere/shop/models", "elsewhere/shop"}) {
    SCOPED_TRACE(folder);
    const bool of_models = std::string(folder).ends_with("models");
    const std::string uri = of_models ? "model://shelf" : "model://models/shelf";
    write_world("<include><uri>" + uri + "</uri><pose>2 0 0 0 0 0</pose></include>");
    load({(folder_ / folder).string()});
    EXPECT_TRUE(warnings_.empty());
    EXPECT_NEAR(range(kOrigin, kX), 3, kExact);
  }
}

TEST_F(Meshes, ColladaCountsInItsUnitAndIgnoresItsUpAxis) {
  write("wall.dae", collada());
  write_world(model("m", "0 0 0 0 0 0", mesh("wall.dae")));
  load();
  EXPECT_NEAR(range(kOrigin, kX), 3, kExact);  // 1 m in the geometry, 2 m by its node
  EXPECT_NEAR(range({0, 0.45, 0.45}, kX), 3, kExact);
  EXPECT_TRUE(std::isinf(range({0, 0.55, 0}, kX)));
}

TEST_F(Meshes, EdgesOfAMeshAreItsRimsAndFoldsNotItsDiagonals) {
  write("walls.obj", kObj);
  write_world(model("m", "0 0 0 0 0 0", mesh("walls.obj")));
  load();
  EXPECT_NEAR(hit({0, 0.01, 0.01}, kX).edge_distance, 0.99, kExact);
}

TEST_F(Meshes, MissingAndBrokenOnesAreNamedAndLeftOut) {
  write("broken.dae", "<COLLADA");
  write("broken.stl", "solid");
  write("empty.obj", "# nothing\n");
  write_world(model("a", "9 0 0 0 0 0", mesh("model://nowhere/meshes/chair.dae")) +
              model("b", "9 1 0 0 0 0", mesh("broken.dae")) + model("c", "9 2 0 0 0 0", mesh("broken.stl")) +
              model("d", "9 3 0 0 0 0", mesh("empty.obj")) + model("e", "9 4 0 0 0 0", mesh("https://far.away/x.dae")) +
              model("box", "3 0 0 0 0 0", kUnitBox));
  load();
  for (const char* name :
       {"model://nowhere/meshes/chair.dae", "broken.dae", "broken.stl", "empty.obj", "https://far"}) {
    EXPECT_TRUE(warned_of(name)) << name;
  }
  EXPECT_EQ(warnings_.size(), 5u);
  EXPECT_NEAR(range(kOrigin, kX), 2.5, kExact);
}

}  // namespace
}  // namespace tilth
