// The size of scans beside that of a map: of a made corridor, whose true pose and size are known.
#include <gtest/gtest.h>

#include "localization/made_map.hpp"
#include <tilth/localization/map_tiles.hpp>
#include <tilth/localization/place_scale.hpp>

namespace tilth {
namespace {

class PlaceScale : public testing::TestWithParam<double> {};

TEST_P(PlaceScale, IsThatOfTheMapOverThatOfTheScan) {
  const std::vector<Leg> legs{{1, 0, 0}, {10, 1.0, 0}, {1, 0, 0}};
  const Simulator drive(corridor_scene({26, {3, 4.7, 9, 13}}, legs),
                        simulation_options("corridor", {{"seed", "311"}, {"people", "0"}, {"columns", "600"}}));
  const MadeMap map = map_of(drive);
  const SubmapOptions options;
  MapTiles tiles(map, {}, options);
  const std::size_t place = map.places().size() / 2;
  const Pose T_map_lidar = map.places()[place].T_map_lidar;
  SurfacePatches query = map.patches(place);
  for (SurfacePatch& patch : query) patch.mean /= GetParam();
  EXPECT_NEAR(scale_in_map(query, *tiles.near(T_map_lidar.translation()), T_map_lidar, options), GetParam(), 0.003);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PlaceScale, testing::Values(0.9, 0.96, 1.0, 1.04, 1.1));

TEST(PlaceScaleOfNothing, IsOne) {
  const Submap nothing({}, {});
  EXPECT_EQ(scale_in_map({}, nothing, Pose::Identity(), {}), 1.0);
}

}  // namespace
}  // namespace tilth
