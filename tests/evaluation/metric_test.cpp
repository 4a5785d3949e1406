// Statistics of hand-made errors.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/metric.hpp>

namespace tilth {
namespace {

TEST(Metric, HandMadeNumbers) {
  const Metric m = metric_of({3, 1, 4, 2});
  EXPECT_DOUBLE_EQ(m.mean, 2.5);
  EXPECT_DOUBLE_EQ(m.sse, 30);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(m.std, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(m.median, 2.5);
  EXPECT_DOUBLE_EQ(m.min, 1);
  EXPECT_DOUBLE_EQ(m.max, 4);
  EXPECT_EQ(m.errors, (std::vector<double>{3, 1, 4, 2}));
}

TEST(Metric, MedianOfAnOddNumberIsTheMiddle) {
  EXPECT_DOUBLE_EQ(metric_of({9, 1, 2}).median, 2);
  EXPECT_DOUBLE_EQ(metric_of({7}).median, 7);
}

TEST(Metric, ScaledIsTheSameInAnotherUnit) {
  const Metric m = scaled(metric_of({3, 1, 4, 2}), 10);
  EXPECT_DOUBLE_EQ(m.mean, 25);
  EXPECT_DOUBLE_EQ(m.std, 10 * std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(m.sse, 3000);
}

TEST(Metric, RefusesNoErrors) {
  EXPECT_THROW(metric_of({}), Error);
}

}  // namespace
}  // namespace tilth
