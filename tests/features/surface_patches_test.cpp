// Patches of made-up scans of 16 beams, of which every surface is known.
#include <array>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "features/cast_scans.hpp"
#include <tilth/features/surface_patches.hpp>

namespace tilth {
namespace {

using cast::plane;
using cast::pole;
using cast::scan;
using Normals = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d kUp(0, 0, 1), kBack(-1, 0, 0), kRight(0, -1, 0);
constexpr double kHeight = 0.6;  // [m] of the sensor: four beams reach the floor before a wall at 4 m

cast::Surfaces room() {
  return {plane(kUp, kHeight), plane(kBack, 4), plane(-kBack, 4.5), plane(kRight, 3.2), plane(-kRight, 5)};
}

/// [deg] between each flat patch and the nearest of `normals`, ascending.
std::vector<double> slants(const SurfacePatches& patches, const Normals& normals) {
  std::vector<double> slants;
  for (const SurfacePatch& patch : patches) {
    if (!patch.flat) continue;
    double cosine = -1;
    for (const Eigen::Vector3d& n : normals) cosine = std::max(cosine, n.dot(patch.normal));
    slants.push_back(std::acos(std::min(1.0, cosine)) / cast::kDegree);
  }
  std::sort(slants.begin(), slants.end());
  return slants;
}

std::size_t flat_count(const SurfacePatches& patches) {
  return std::size_t(std::count_if(patches.begin(), patches.end(), [](const SurfacePatch& p) { return p.flat; }));
}

/// The greatest difference of any mean, covariance, normal or time; 1e9 where the patches are not the same ones.
double difference(SurfacePatches a, SurfacePatches b) {
  if (a.size() != b.size() || flat_count(a) != flat_count(b)) return 1e9;
  const auto before = [](const SurfacePatch& p, const SurfacePatch& q) {
    return std::lexicographical_compare(p.mean.begin(), p.mean.end(), q.mean.begin(), q.mean.end());
  };
  std::sort(a.begin(), a.end(), before);
  std::sort(b.begin(), b.end(), before);
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max({worst, (a[i].mean - b[i].mean).norm(), (a[i].covariance - b[i].covariance).norm(),
                      double(std::abs(a[i].time - b[i].time))});
    if (a[i].flat) worst = std::max(worst, (a[i].normal - b[i].normal).norm());
  }
  return worst;
}

TEST(SurfacePatches, FloorAndWallHaveTheirNormalsTowardsTheSensor) {
  const struct {
    double noise, median, most, mean;  // [m], [deg]
  } cases[] = {{0, 1e-4, 0.02, 0.02}, {0.01, 1.0, 3.0, 0.2}, {0.02, 2.0, 6.0, 0.4}};
  for (const auto& expected : cases) {
    SCOPED_TRACE(expected.noise);
    for (const auto& [normal, distance] : {std::pair(kUp, kHeight), std::pair(kBack, 4.0)}) {
      const auto part = [](const Eigen::Vector3d& p) { return p.norm() < 8; };
      const SurfacePatches patches = surface_patches(scan({plane(normal, distance, part)}, {expected.noise}), {});
      EXPECT_GT(double(flat_count(patches)), 0.98 * double(patches.size()));
      const std::vector<double> slant = slants(patches, {normal});
      ASSERT_GT(slant.size(), 300u);
      EXPECT_LT(slant[slant.size() / 2], expected.median);
      EXPECT_LT(slant[slant.size() * 95 / 100], expected.most);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const SurfacePatch& patch : patches) sum += patch.normal;
      EXPECT_LT(std::acos(std::min(1.0, normal.dot(sum.normalized()))) / cast::kDegree, expected.mean);  // no bias
    }
  }
}

TEST(SurfacePatches, HoldWhatTheySay) {
  const SurfacePatches patches = surface_patches(scan(room(), {0.01}), {});
  ASSERT_GT(patches.size(), 1000u);
  for (const SurfacePatch& patch : patches) {
    ASSERT_NEAR(patch.normal.norm(), 1, 1e-9);
    ASSERT_LE(patch.normal.dot(patch.mean), 0);
    ASSERT_LT((patch.covariance - patch.covariance.transpose()).norm(), 1e-12);
    ASSERT_NEAR(patch.normal.dot(patch.covariance * patch.normal), patch.thickness, 1e-7);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(patch.covariance, Eigen::EigenvaluesOnly);
    ASSERT_NEAR(std::max(0.0, eigen.eigenvalues()[0]), patch.thickness, 1e-7);
    if (patch.flat) {
      ASSERT_LT(std::sqrt(patch.thickness), PatchOptions().max_thickness);
    }
    double off = 1;  // [m] from the nearest surface of the room
    for (const auto& [n, d] : {std::pair(kUp, kHeight), std::pair(kBack, 4.0), std::pair(Eigen::Vector3d(1, 0, 0), 4.5),
                               std::pair(kRight, 3.2), std::pair(Eigen::Vector3d(0, 1, 0), 5.0)})
      off = std::min(off, std::abs(n.dot(patch.mean) + d));
    ASSERT_LT(off, 0.08);  // a run about a corner
  }
}

TEST(SurfacePatches, NoneSlantsFromTheFloorToAWall) {
  for (const double noise : {0.0, 0.015}) {
    for (double x = 3; x < 9; x += 0.73) {  // at least three beams on the floor before the wall
      SCOPED_TRACE(x);
      const SurfacePatches patches = surface_patches(scan({plane(kUp, kHeight), plane(kBack, x)}, {noise}), {});
      EXPECT_LT(slants(patches, {kUp, kBack}).back(), 16);  // degrees

      EXPECT_GT(flat_count(patches), 1500u);
    }
    for (double x = 2; x < 3; x += 0.3) {  // fewer, which leaves the last one with the wall alone
      SCOPED_TRACE(x);
      const auto slant =
          slants(surface_patches(scan({plane(kUp, kHeight), plane(kBack, x)}, {noise}), {}), {kUp, kBack});
      EXPECT_LT(slant[slant.size() * 99 / 100], 10);
    }
  }
}

TEST(SurfacePatches, NoneCutsTheCornerOfARoom) {
  for (const double noise : {0.0, 0.015}) {
    for (double x = 2; x < 8; x += 0.73) {
      SCOPED_TRACE(x);
      const auto slant =
          slants(surface_patches(scan({plane(kRight, 2), plane(kBack, x)}, {noise}), {}), {kRight, kBack});
      EXPECT_LT(slant.back(), 25);  // a run that only just reaches round the corner
      EXPECT_LT(slant[slant.size() * 98 / 100], 7);
    }
  }
}

// In a passage the last beams on the floor and the first ones on the wall are a few centimetres apart, and as thin
// together as a noisy plane: a run of the one would pass for a piece of the other.
TEST(SurfacePatches, LieOnTheSurfaceThatTheyFaceAs) {
  const auto near = [](const Eigen::Vector3d& p) { return p.norm() < 8; };
  const std::array<std::pair<Eigen::Vector3d, double>, 4> walls{
      {{kUp, 0.8}, {-kUp, 1.7}, {kRight, 1.5}, {-kRight, 1.5}}};
  cast::Surfaces passage;
  for (const auto& [normal, distance] : walls) passage.push_back(plane(normal, distance, near));
  const auto astray = [&](double max_misfit, double noise) {
    PatchOptions options;
    options.max_misfit = max_misfit;
    std::size_t count = 0, all = 0;
    for (const SurfacePatch& patch : surface_patches(scan(passage, {noise}), options)) {
      if (!patch.flat) continue;
      const auto faced = std::max_element(walls.begin(), walls.end(), [&](const auto& a, const auto& b) {
        return a.first.dot(patch.normal) < b.first.dot(patch.normal);
      });
      count += std::abs(faced->first.dot(patch.mean) + faced->second) > 0.015 + noise;
      ++all;
    }
    return std::pair(double(count), double(all));
  };
  for (const double noise : {0.0, 0.01, 0.02}) {
    SCOPED_TRACE(noise);
    const auto [believed, all] = astray(1e6, noise);
    const auto [left, kept] = astray(2, noise);
    EXPECT_LT(left, 0.3 * believed);
    EXPECT_GT(kept, 0.9 * all);
  }
}

TEST(SurfacePatches, NoneBridgesAStepInDepth) {
  const auto left = [](const Eigen::Vector3d& p) { return p.y() < 0.1; };
  const auto low = [](const Eigen::Vector3d& p) { return p.z() < -0.05; };
  for (const double step : {0.25, 0.5, 1.0, 3.0}) {
    for (const cast::Part& part : {cast::Part(left), cast::Part(low)}) {
      SCOPED_TRACE(step);
      const SurfacePatches patches = surface_patches(scan({plane(kBack, 3, part), plane(kBack, 3 + step)}, {0.01}), {});
      EXPECT_LT(slants(patches, {kBack}).back(), 10);
      for (const SurfacePatch& p : patches)
        ASSERT_LT(std::min(std::abs(p.mean.x() - 3), std::abs(p.mean.x() - 3 - step)), 0.03);
    }
  }
}

TEST(SurfacePatches, APoleIsNotFlat) {
  for (const double x : {2.0, 4.0, 8.0}) {
    for (const bool before_wall : {false, true}) {
      const cast::Surface behind = before_wall ? plane(kBack, x + 2) : plane(kUp, 1.0);
      std::size_t on_pole = 0;
      for (const SurfacePatch& p : surface_patches(scan({pole(x, 0.3, 0.06), behind}, {0.01}), {})) {
        if ((p.mean.head<2>() - Eigen::Vector2d(x, 0.3)).norm() > 0.15 || p.mean.z() < -0.95) continue;
        EXPECT_FALSE(p.flat) << p.mean.transpose();
        ++on_pole;
        if (p.mean.z() > -0.2) {  // far from the floor
          EXPECT_GT(p.covariance(2, 2), 2 * p.covariance(0, 0)) << p.mean.transpose();
        }
      }
      EXPECT_GE(on_pole, 8u);
    }
  }
}

TEST(SurfacePatches, WhatOneBeamAloneSeesIsNone) {
  const auto slit = [](const Eigen::Vector3d& p) { return std::abs(p.z() / p.head<2>().norm() - 0.0175) < 0.01; };
  const PointCloud line = scan({plane(kBack, 4, slit)}, {0.01});
  ASSERT_GT(line.size(), 300u);
  EXPECT_TRUE(surface_patches(line, {}).empty());
  const auto slits = [](const Eigen::Vector3d& p) { return std::fmod(p.z() / p.head<2>().norm() + 1, 0.14) < 0.035; };
  const SurfacePatches patches = surface_patches(scan({plane(kBack, 4, slits), plane(-kBack, 4)}, {0.01}), {});
  EXPECT_EQ(
      std::count_if(patches.begin(), patches.end(), [](const SurfacePatch& p) { return p.flat && p.mean.x() > 0; }), 0)
      << "every fourth beam";
}

TEST(SurfacePatches, RunsOfTooFewPointsAreNone) {
  const PointCloud walls = scan({plane(kBack, 4), plane(-kBack, 4)}, {});
  for (const int run : {1, 2, 3}) {  // points side by side on the wall behind; that in front is whole
    std::vector<std::uint32_t> some;
    for (std::uint32_t i = 0; i < walls.size(); ++i) {
      const bool in_run = std::lround(walls.times[i] / cast::kPeriod * 1800) % 20 < run;
      if (walls.points[i].x() > 0 || in_run) some.push_back(i);
    }
    std::size_t behind = 0;
    for (const SurfacePatch& p : surface_patches(select(walls, some), {})) behind += p.mean.x() < 0;
    EXPECT_EQ(behind > 200, run == 3) << run;
    EXPECT_EQ(behind == 0, run < 3) << run;
  }
}

TEST(SurfacePatches, ComeFromNeighborhoodsWhereThereAreNoRings) {
  PointCloud cloud = scan(room(), {});
  const std::size_t with_rings = flat_count(surface_patches(cloud, {}));
  cloud.rings.clear();
  EXPECT_GT(flat_count(surface_patches(cloud, {})), with_rings / 2);
  EXPECT_TRUE(surface_patches({}, {}).empty());
}

TEST(SurfacePatches, OfEverySecondRingAreThoseOfASensorWithHalfTheBeams) {
  const PointCloud cloud = scan(room(), {0.01});
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.rings[i] % 2 == 0) some.push_back(i);
  }
  const PointCloud half = select(cloud, some);
  PointCloud numbered = half;
  for (std::uint16_t& ring : numbered.rings) ring = std::uint16_t(ring / 2);
  const SurfacePatches patches = surface_patches(half, {});
  EXPECT_GT(flat_count(patches), 200u);
  EXPECT_EQ(difference(patches, surface_patches(numbered, {})), 0.0);
}

TEST(SurfacePatches, AreTheSameInWhateverOrderThePointsCome) {
  const PointCloud cloud = scan(room(), {0.01});
  const SurfacePatches patches = surface_patches(cloud, {});
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  std::reverse(order.begin(), order.end());
  EXPECT_LT(difference(patches, surface_patches(select(cloud, order), {})), 1e-6) << "the other way round";
  for (const std::size_t start : {cloud.size() / 7, cloud.size() / 2, cloud.size() - 3}) {
    std::iota(order.begin(), order.end(), 0u);
    std::rotate(order.begin(), order.begin() + std::ptrdiff_t(start), order.end());
    EXPECT_LT(difference(patches, surface_patches(select(cloud, order), {})), 1e-6) << "from " << start;
  }
  std::shuffle(order.begin(), order.end(), std::mt19937(4));
  EXPECT_LT(difference(patches, surface_patches(select(cloud, order), {})), 1e-6) << "shuffled";
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cloud.rings[a] < cloud.rings[b]; });
  EXPECT_LT(difference(patches, surface_patches(select(cloud, order), {})), 1e-6) << "ring after ring";
}

TEST(SurfacePatches, NothingHappensWhereTheAzimuthBeginsAnew) {
  const Eigen::Vector3d wall = -kBack;                // behind the sensor, across azimuth +-pi
  for (const double start : {180.0, 0.0, -179.99}) {  // the first also has points right at pi
    SCOPED_TRACE(start);
    PointCloud cloud = scan({plane(wall, 4)}, {.noise = 0.01, .start = start});
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (std::abs(cloud.points[i].y()) < 1e-9) cloud.points[i].y() = i % 2 ? 0.0 : -0.0;
    }
    std::size_t near_cut = 0;
    for (const SurfacePatch& p : surface_patches(cloud, {})) {
      ASSERT_NEAR(p.mean.x(), -4, 0.03);
      if (std::abs(p.mean.y()) > 0.4) continue;
      ++near_cut;
      EXPECT_TRUE(p.flat);
      EXPECT_GT(p.normal.dot(wall), std::cos(6 * cast::kDegree));
    }
    EXPECT_GE(near_cut, 3u * 16u);  // 0.8 m of it on every beam
  }
}

TEST(SurfacePatches, TimesAreThoseOfTheirPoints) {
  PointCloud cloud = scan(room(), {.clockwise = true, .start = -179.0});
  const SurfacePatches patches = surface_patches(cloud, {});
  ASSERT_GT(patches.size(), 1000u);
  for (const SurfacePatch& p : patches) {
    const double azimuth = std::atan2(p.mean.y(), p.mean.x()) / cast::kDegree;
    const double turned = std::fmod(360.0 - 179.0 - azimuth + 360.0, 360.0);
    if (turned < 5 || turned > 355) continue;
    ASSERT_NEAR(p.time, cast::kPeriod * turned / 360, 2e-4);
  }
  cloud.times.clear();
  for (const SurfacePatch& p : surface_patches(cloud, {})) ASSERT_EQ(p.time, 0.0f);
}

}  // namespace
}  // namespace tilth
