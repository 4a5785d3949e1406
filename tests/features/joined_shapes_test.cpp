// Shapes of many sets of runs at once against those of one set after another.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/symmetric_eigen.hpp>
#include <tilth/features/joined_shapes.hpp>

namespace tilth {
namespace {

/// Of a run of points along a line that is `thick` across; all in one place where that is 0.
Moments run(double thick, std::mt19937& rng) {
  std::normal_distribution<double> noise(0, thick);
  std::uniform_real_distribution<double> place(-20, 20);
  const Eigen::Vector3d middle(place(rng), place(rng), place(rng));
  Moments moments;
  for (int i = 0; i < 7; ++i) {
    const double along = thick > 0 ? 0.1 * i : 0.0;
    moments.add({.count = 1, .mean = middle + Eigen::Vector3d(along + noise(rng), noise(rng), noise(rng))});
  }
  return moments;
}

PlaneShape shape_of(const RunSet& set) {
  Moments joined = *set[0];
  for (const Moments* other : {set[1], set[2]}) {
    if (other != nullptr) joined.add(*other);
  }
  return {joined.covariance(), eigenvalues(joined.covariance())};
}

TEST(JoinedShapes, OfManySetsAreThoseOfEach) {
  std::mt19937 rng(3);
  std::vector<Moments> runs;
  for (int i = 0; i < 400; ++i) runs.push_back(run(i % 9 == 0 ? 0.0 : std::pow(10, -3 + i % 4), rng));
  for (const std::size_t count : {0, 1, 2, 7, 33, 398}) {
    std::vector<RunSet> sets;
    for (std::size_t i = 0; i < count; ++i)
      sets.push_back({&runs[i], i % 3 == 0 ? nullptr : &runs[i + 1], i % 5 == 0 ? nullptr : &runs[i + 2]});
    std::vector<PlaneShape> shapes(count);
    join_runs(sets, shapes);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(shapes[i].covariance.entries, shape_of(sets[i]).covariance.entries) << i;
      EXPECT_EQ(shapes[i].variances, shape_of(sets[i]).variances) << i;
    }
  }
}

}  // namespace
}  // namespace tilth
