#include <gtest/gtest.h>

#include <tilth/evaluation/distribution.hpp>

namespace tilth {
namespace {

TEST(Distribution, InterpolatesBetweenRanks) {
  const Distribution d = distribution_of({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(d.mean, 2.5);
  EXPECT_DOUBLE_EQ(d.median, 2.5);
  EXPECT_DOUBLE_EQ(d.p99, 3.97);
  EXPECT_DOUBLE_EQ(d.max, 4);
  EXPECT_EQ(distribution_of({}).max, 0.0);
}

}  // namespace
}  // namespace tilth
