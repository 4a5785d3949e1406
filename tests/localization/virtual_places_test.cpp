#include <cmath>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/localization/virtual_places.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void add_rectangle(Points& points, const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  constexpr double kStep = 0.07;  // [m]
  for (double a = 0; a < u.norm(); a += kStep)
    for (double b = 0; b < v.norm(); b += kStep) points.push_back(corner + a * u.normalized() + b * v.normalized());
}

/// 12 x 8 m, 3 m high, with a box of 1 x 1 x 1 m in its middle.
Points room() {
  Points points;
  const Eigen::Vector3d x(12, 0, 0), y(0, 8, 0), z(0, 0, 3), low(0, 0, 0.07);
  add_rectangle(points, low, x, y);
  add_rectangle(points, low + z, x, y);
  for (const auto& [corner, along] : {std::pair{low, x}, {low, y}, {low + x, y}, {low + y, x}})
    add_rectangle(points, corner, along, z);
  const Eigen::Vector3d box(5.5, 3.5, 0.07), one(1, 0, 0), other(0, 1, 0), up(0, 0, 1);
  for (const auto& [corner, along] :
       {std::pair{box, one}, {box, other}, {Eigen::Vector3d(box + one), other}, {Eigen::Vector3d(box + other), one}})
    add_rectangle(points, corner, along, up);
  return points;
}

TEST(VirtualPlaces, StandOnFreeGroundAndSeeWhatIsNotHidden) {
  const Points points = room();
  std::size_t places = 0;
  make_virtual_places(points, {}, [&](const VirtualPlace& place) {
    ++places;
    const Eigen::Vector3d at = place.T_map_lidar.translation();
    EXPECT_NEAR(at.z(), 0.87, 0.1);
    EXPECT_TRUE(at.x() > 0.3 && at.x() < 11.7 && at.y() > 0.3 && at.y() < 7.7) << at.transpose();
    EXPECT_FALSE(std::abs(at.x() - 6) < 0.5 && std::abs(at.y() - 4) < 0.5) << at.transpose();
    EXPECT_GT(place.patches.size(), 300U);
    std::size_t behind = 0;
    for (const SurfacePatch& patch : place.patches) {
      EXPECT_LE(patch.normal.dot(patch.mean), 1e-9);
      const Eigen::Vector3d seen = place.T_map_lidar * patch.mean;  // low behind the box, as seen from +x
      behind += at.x() > 7.5 && std::abs(at.y() - 4) < 0.5 && seen.x() < 5 && seen.x() > 4 &&
                std::abs(seen.y() - 4) < 0.3 && seen.z() < 0.3;
    }
    EXPECT_EQ(behind, 0U);
  });
  EXPECT_GE(places, 12U);
}

TEST(VirtualPlaces, RefuseACloudWithoutGround) {
  Points wall;
  add_rectangle(wall, {0, 0, 0}, {10, 0, 0}, {0, 0, 3});
  EXPECT_THROW(make_virtual_places(wall, {}, [](const VirtualPlace&) {}), Error);
  EXPECT_THROW(make_virtual_places({}, {}, [](const VirtualPlace&) {}), Error);
}

}  // namespace
}  // namespace tilth
