// What three runs miss their plane by, against sums over all of their points; which runs are believed to share one.
#include <array>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <tilth/features/plane_misfit.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Runs = std::array<Points, 3>;

constexpr int kPoints = 20;
constexpr double kNoise = 0.02;  // [m] along the normal

/// A line of points along y at (x, z), with noise along the z axis.
Points run(double x, double z, double noise, std::mt19937& rng) {
  std::normal_distribution<double> off(0, noise);
  Points points;
  for (int i = 0; i < kPoints; ++i) points.emplace_back(x, 0.0125 * i, z + (noise > 0 ? off(rng) : 0));
  return points;
}

Moments moments_of(const Points& points) {
  Moments moments;
  for (const Eigen::Vector3d& p : points) moments.add({.count = 1, .mean = p});
  return moments;
}

struct Judged {
  std::array<Moments, 3> runs;
  Eigen::Vector3d normal;
  PlaneMisfit misfit;
};

Judged judge(const Runs& runs) {
  Judged judged;
  Moments joined;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    judged.runs[i] = moments_of(runs[i]);
    joined.add(judged.runs[i]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(joined.covariance().matrix());
  judged.normal = eigen.eigenvectors().col(0);
  judged.misfit = plane_misfit({&judged.runs[0], &judged.runs[1], &judged.runs[2]}, judged.normal);
  return judged;
}

TEST(PlaneMisfit, IsTheSumOverAllPoints) {
  std::mt19937 rng(5);
  Runs runs{run(0, 0, kNoise, rng), run(0.1, 0.02, kNoise, rng), run(0.25, 0, kNoise, rng)};
  runs[1].resize(7);
  const Judged judged = judge(runs);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double within = 0, between = 0, points = 0;
  for (const Points& run : runs) {
    for (const Eigen::Vector3d& p : run) mean += p, ++points;
  }
  mean /= points;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const Eigen::Vector3d& p : runs[i]) {
      within += std::pow(judged.normal.dot(p - judged.runs[i].mean), 2);
      between += std::pow(judged.normal.dot(judged.runs[i].mean - mean), 2);
    }
  }
  EXPECT_EQ(judged.misfit.points, points);
  EXPECT_NEAR(judged.misfit.within, within, 1e-12);
  EXPECT_NEAR(judged.misfit.between, between, 1e-12);
}

TEST(PlaneMisfit, OfAPlaneIsOneDeviationOfItsNoise) {
  std::mt19937 rng(6);
  constexpr int kTries = 2000;
  std::array<int, 3> kept{};
  for (int i = 0; i < kTries; ++i) {
    const Judged judged = judge({run(0, 0, kNoise, rng), run(0.1, 0, kNoise, rng), run(0.2, 0, kNoise, rng)});
    for (std::size_t sigma = 1; sigma <= kept.size(); ++sigma)
      kept[sigma - 1] += is_one_plane(judged.misfit, double(sigma), 0);
  }
  EXPECT_NEAR(kept[0] / double(kTries), 0.683, 0.03);
  EXPECT_NEAR(kept[1] / double(kTries), 0.954, 0.02);
  EXPECT_NEAR(kept[2] / double(kTries), 0.997, 0.01);
}

TEST(PlaneMisfit, TellsACornerFromAPlaneAsThick) {
  std::mt19937 rng(7);
  int kept = 0;
  for (int i = 0; i < 200; ++i) {  // two lines on a floor, one 6 cm up a wall
    const Judged judged = judge({run(0, 0, kNoise, rng), run(0.1, 0, kNoise, rng), run(0.12, 0.06, kNoise, rng)});
    kept += is_one_plane(judged.misfit, 2, 0.002);
  }
  EXPECT_LT(kept, 10);
}

TEST(PlaneMisfit, OfExactLinesIsHeldAgainstTheRoughness) {
  std::mt19937 rng(8);
  const Judged bowed = judge({run(0, 0, 0, rng), run(0.1, 0.006, 0, rng), run(0.2, 0, 0, rng)});
  EXPECT_NEAR(std::sqrt(bowed.misfit.between / bowed.misfit.points), 0.006 * std::sqrt(2.0) / 3, 1e-4);
  EXPECT_FALSE(is_one_plane(bowed.misfit, 2, 0.002));
  EXPECT_TRUE(is_one_plane(bowed.misfit, 2, 0.003));
}

}  // namespace
}  // namespace tilth
