// The bounds of a piece of a plane.
#include <gtest/gtest.h>

#include <tilth/core/flatness.hpp>

namespace tilth {
namespace {

TEST(Flatness, IsThinAndThreeTimesAsWide) {
  constexpr double kMost = kFlatThickness * kFlatThickness;
  EXPECT_TRUE(is_flat({1e-4, 1e-3, 1.0}, kMost));
  EXPECT_FALSE(is_flat({1e-4, 8e-4, 1.0}, kMost)) << "a line";
  EXPECT_FALSE(is_flat({2e-3, 1.0, 1.0}, kMost)) << "a bush";
  EXPECT_TRUE(is_flat({2e-3, 1.0, 1.0}, 2e-3)) << "where so much is allowed";
  EXPECT_FALSE(is_flat(Eigen::Vector3d::Zero(), kMost)) << "a point";
}

}  // namespace
}  // namespace tilth
