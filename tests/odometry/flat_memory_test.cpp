// What the pipelines remember is bounded by the range of their maps: round a block of rooms, the map at one place is as
// large after two laps as after one.
#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr double kPlace = 12.0;  // [m] along the first corridor

/// Round the block of sim://office, of four corridors: 83 m a lap.
Simulator round_the_block(int laps) {
  std::string path = "0,0";
  for (int lap = 0; lap < laps; ++lap) path += ";24.43,0;24.43,15.57;-1.44,15.57;-1.44,0";
  const SimulationOptions options =
      simulation_options("office", {{"cruise", "2"}, {"columns", "200"}, {"people", "0"}});
  Scene scene = make_scene("office", options.scene);
  scene.trajectory = drive_through(parse_waypoints(path + ";20,0", options.scene.height), options.path, {});
  return Simulator(std::move(scene), options);
}

/// Surfaces in the map whenever the robot passes the place.
std::vector<std::size_t> surfaces_at_place(const Simulator& simulator, const std::string& pipeline,
                                           const std::string& max_range) {
  const auto odometry = make_odometry(pipeline, {{"map.max_range", max_range}});
  std::vector<std::size_t> surfaces;
  double last = kPlace;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    odometry->register_scan(simulator.scan(i).scan);
    const Eigen::Vector3d position = interpolate(simulator.truth(), simulator.stamp(i)).translation();
    if (std::abs(position.y()) < 2 && last < kPlace && position.x() >= kPlace)
      surfaces.push_back(odometry->local_map().size());
    last = position.x();
  }
  return surfaces;
}

TEST(FlatMemory, TheMapIsAsLargeAfterTwoLapsAsAfterOne) {
  const Simulator simulator = round_the_block(2);
  for (const std::string pipeline : {"improved_floam", "tilth"}) {
    const std::vector<std::size_t> surfaces = surfaces_at_place(simulator, pipeline, "12");
    ASSERT_EQ(surfaces.size(), 3u) << pipeline;
    EXPECT_LT(surfaces[1], 3 * surfaces[0] / 2) << pipeline;  // the first time, there is less of a way behind
    EXPECT_NEAR(double(surfaces[2]), double(surfaces[1]), 0.25 * double(surfaces[1])) << pipeline;  // cropped in steps
  }
}

TEST(FlatMemory, AMapWithoutBoundGrows) {
  const std::vector<std::size_t> surfaces = surfaces_at_place(round_the_block(1), "improved_floam", "1000");
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_GT(surfaces[1], 2 * surfaces[0]);
}

}  // namespace
}  // namespace tilth
