// How sure a pair of a patch and a surface is, and what patches that are not flat are held against.
#include <gtest/gtest.h>

#include "made_places.hpp"

namespace tilth {
namespace {

TEST(PatchPairs, APairIsAsSureAsThePatchHasPointsAndTheSurfaceHasPatches) {
  const Place::Plane plane = room().planes.front();
  SurfacePatch patch = seen(room(), kTruth, Vector6d::Zero(), 1).front();
  patch.thickness = 9e-4F;
  const Eigen::Vector3d askew = (patch.normal + 0.2 * patch.normal.unitOrthogonal()).normalized();
  const auto variance = [&](std::uint16_t points, std::uint32_t patches, const Eigen::Vector3d& normal) {
    SurfacePatch some = patch;
    Place::Plane surface = plane;
    some.points = points, surface.patches = patches;
    return pair_variance(some, normal, surface, kOptions);
  };
  EXPECT_NEAR(variance(1, 60, patch.normal) - variance(9, 60, patch.normal), 9e-4 * (1 - 1.0 / 9), 1e-9);
  EXPECT_NEAR(variance(9, 1, patch.normal) - variance(9, 10, patch.normal), kOptions.surface_doubt * 1e-4 * 0.9, 1e-9);
  EXPECT_GT(variance(9, 60, askew) - variance(9, 60, patch.normal), 0.9 * kOptions.spread_ratio * 0.04 * 1e-2);
}

/// Planes told apart by where they are: none of the patches faces as its surface does.
struct NearestPlane {
  Place place;
  const Place::Plane* find(const Eigen::Vector3d& p, const Eigen::Vector3d&, bool flat) const {
    EXPECT_FALSE(flat);
    const auto nearer = [&](const Place::Plane& a, const Place::Plane& b) {
      return std::abs(a.normal.dot(p - a.mean)) < std::abs(b.normal.dot(p - b.mean));
    };
    return &*std::min_element(place.planes.begin(), place.planes.end(), nearer);
  }
};

TEST(PatchPairs, PatchesThatAreNotFlatAreHeldAgainstPlanes) {
  SurfacePatches patches = seen(room(), kTruth, kVelocity, 600);
  for (SurfacePatch& patch : patches) {
    patch.flat = false;
    patch.normal = patch.normal.unitOrthogonal();
  }
  const NearestPlane nearest{room()};
  const auto result = align_continuous_time(patches, kMiddle, prior_of(kVelocity, 0.3 * kSurprise), nearest, kOptions);
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(pose_error(result), 1e-3);
}

}  // namespace
}  // namespace tilth
