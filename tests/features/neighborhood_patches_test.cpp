// Patches of made-up scans whose rings nobody knows: of every surface is known where it is.
#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "features/cast_scans.hpp"
#include <tilth/features/neighborhood_patches.hpp>

namespace tilth {
namespace {

using cast::plane;
using cast::pole;

const Eigen::Vector3d kUp(0, 0, 1), kBack(-1, 0, 0), kRight(0, -1, 0);

PointCloud ringless(const cast::Surfaces& surfaces, const cast::Turn& turn) {
  PointCloud cloud = cast::scan(surfaces, turn);
  cloud.rings.clear();
  return cloud;
}

SurfacePatches patches_of(const PointCloud& cloud, const PatchOptions& options = {.max_misfit = 2}) {
  return neighborhood_patches(cloud, std::vector<std::uint8_t>(cloud.size(), 1), options);
}

cast::Surfaces room() {
  return {plane(kUp, 0.6), plane(kBack, 4), plane(-kBack, 4.5), plane(kRight, 3.2), plane(-kRight, 5)};
}

/// [deg] from a flat patch to the nearest of the room's normals; [m] from it to the surface that faces so.
struct Miss {
  double slant = 180, distance = 0;
};

Miss miss(const SurfacePatch& patch) {
  const std::vector<std::pair<Eigen::Vector3d, double>> sides{
      {kUp, 0.6}, {kBack, 4}, {-kBack, 4.5}, {kRight, 3.2}, {-kRight, 5}};
  Miss least;
  for (const auto& [normal, distance] : sides) {
    const double slant = std::acos(std::min(1.0, normal.dot(patch.normal))) / cast::kDegree;
    if (slant < least.slant) least = {slant, std::abs(normal.dot(patch.mean) + distance)};
  }
  return least;
}

std::vector<SurfacePatch> flat_ones(const SurfacePatches& patches) {
  std::vector<SurfacePatch> flat;
  std::copy_if(patches.begin(), patches.end(), std::back_inserter(flat), [](const SurfacePatch& p) { return p.flat; });
  return flat;
}

TEST(NeighborhoodPatches, LieOnTheirSurfacesAndFaceTheSensor) {
  const std::vector<SurfacePatch> flat = flat_ones(patches_of(ringless(room(), {.noise = 0.01})));
  ASSERT_GT(flat.size(), 600u);
  std::size_t slanting = 0, off = 0, floor = 0;
  for (const SurfacePatch& patch : flat) {
    const Miss m = miss(patch);
    slanting += m.slant > 10, off += m.distance > 0.02;
    floor += patch.normal.z() > 0.9;
    EXPECT_LT(patch.normal.dot(patch.mean), 0);
  }
  EXPECT_LT(double(slanting), 0.03 * double(flat.size()));
  EXPECT_LT(double(off), 0.01 * double(flat.size()));
  EXPECT_GT(floor, 40u) << "beams that meet the floor metres apart make patches of it";
}

TEST(NeighborhoodPatches, AreTheSameWhateverTheFrame) {
  PointCloud cloud = ringless(room(), {.noise = 0.01});
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
  const std::size_t upright = flat_ones(patches_of(cloud)).size();
  const std::vector<SurfacePatch> tilted = flat_ones(patches_of(transform(cloud, T)));
  EXPECT_NEAR(double(tilted.size()), double(upright), 0.2 * double(upright));
  std::size_t slanting = 0;
  for (SurfacePatch patch : tilted) {
    patch.normal = T.linear().transpose() * patch.normal, patch.mean = T.inverse() * patch.mean;
    slanting += miss(patch).slant > 10;
  }
  EXPECT_LT(double(slanting), 0.02 * double(tilted.size()));
}

TEST(NeighborhoodPatches, OfOneBeamAloneAreNone) {
  const auto slit = [](const Eigen::Vector3d& p) { return std::abs(p.z() / p.head<2>().norm() - 0.0175) < 0.01; };
  const PointCloud line = ringless({plane(kBack, 4, slit)}, {.noise = 0.01});
  ASSERT_GT(line.size(), 300u);
  EXPECT_TRUE(patches_of(line).empty()) << "a line that travels with the sensor says nothing true";
}

TEST(NeighborhoodPatches, OfAPoleAreNotFlat) {
  for (const SurfacePatch& patch : patches_of(ringless({pole(3, 0.2, 0.15)}, {.noise = 0.01})))
    EXPECT_FALSE(patch.flat && patch.thickness < 1e-5F);
}

TEST(NeighborhoodPatches, KeepApartWhatWasSeenAtDifferentTimes) {
  // The same wall twice in a scan, a third of a metre nearer the second time: the sensor has moved in between.
  const PointCloud wall = ringless({plane(kBack, 4)}, {.noise = 0.005});
  PointCloud twice = wall;
  for (float& time : twice.times) time *= 0.4F;
  PointCloud later = twice;
  for (Eigen::Vector3d& p : later.points) p.x() -= 0.3;
  for (float& time : later.times) time += 0.06F;
  append(twice, later);
  std::size_t flat = 0;
  for (const SurfacePatch& patch : patches_of(twice)) {
    if (!patch.flat) continue;
    ++flat;
    EXPECT_NEAR(patch.mean.x(), patch.time < 0.05F ? 4.0 : 3.7, 0.02);
    EXPECT_LT(patch.thickness, 0.015 * 0.015);
  }
  EXPECT_GT(flat, 100u);
}

TEST(NeighborhoodPatches, PassOverWhatIsNotKept) {
  const PointCloud cloud = ringless(room(), {});
  EXPECT_TRUE(neighborhood_patches(cloud, std::vector<std::uint8_t>(cloud.size(), 0), {}).empty());
  EXPECT_TRUE(patches_of({}).empty());
}

}  // namespace
}  // namespace tilth
