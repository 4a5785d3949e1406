// Clouds keep their frame where a map can have it, and lose whole kilometres where it cannot.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <tilth/localization/cloud_origin.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;

TEST(CloudOrigin, IsThatOfTheCloudWhereItIsNear) {
  EXPECT_EQ(cloud_origin(Points{}), Eigen::Vector3d::Zero());
  EXPECT_EQ(cloud_origin(Points{{9000, -9000, 700}, {9999, -9999, 800}}), Eigen::Vector3d::Zero());
}

TEST(CloudOrigin, IsInWholeKilometresWhereItIsFar) {
  const double nan = std::nan("");
  const Points survey{
      {400'400, 5'600'900, 130}, {400'300, 5'600'800, 131}, {400'200, 5'600'700, 129}, {0, 0, 0}, {nan, 1, 2},
      {400'100, 5'600'600, 132}};
  EXPECT_EQ(cloud_origin(survey), Eigen::Vector3d(400'000, 5'601'000, 0));
}

}  // namespace
}  // namespace tilth
