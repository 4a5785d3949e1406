// The map of patches against sums done by hand and a look at every surface; its table of voxels against std::map.
#include <map>
#include <random>
#include <set>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <tilth/map/patch_map.hpp>

namespace tilth {
namespace {

Eigen::Vector3d random_point(std::mt19937& rng, double reach) {
  std::uniform_real_distribution<double> u(-reach, reach);
  const double x = u(rng), y = u(rng), z = u(rng);
  return {x, y, z};
}

/// A patch 10 cm wide and 5 mm thick, as the features room makes them.
SurfacePatch patch_at(const Eigen::Vector3d& mean, const Eigen::Vector3d& normal, bool flat = true) {
  const Eigen::Vector3d n = normal.normalized();
  const Eigen::Matrix3d across = n * n.transpose();
  return {.mean = mean,
          .covariance = 1e-2 * (Eigen::Matrix3d::Identity() - across) + 2.5e-5 * across,
          .normal = n,
          .thickness = 2.5e-5f,
          .flat = flat};
}

/// Patches of a piece of plane through `center`, `half` wide along the two directions beside `normal`.
SurfacePatches plane(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double half, std::size_t n) {
  std::mt19937 rng(3);
  SurfacePatches patches;
  while (patches.size() < n) {
    const Eigen::Vector3d d = random_point(rng, half);
    patches.push_back(patch_at(center + d - d.dot(normal) * normal, normal));
  }
  return patches;
}

/// Mean and covariance of all patches as one: that of their means, and the mean of theirs.
struct Joint {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Joint joint_of(const SurfacePatches& patches, const Pose& T) {
  Joint joint;
  const double n = double(patches.size());
  for (const SurfacePatch& p : patches) joint.mean += T * p.mean / n;
  for (const SurfacePatch& p : patches) {
    const Eigen::Vector3d d = T * p.mean - joint.mean;
    joint.covariance += (d * d.transpose() + T.linear() * p.covariance * T.linear().transpose()) / n;
  }
  return joint;
}

/// Patches that all lie in the voxel of 0.5 m from (10, -5, 0) once they are moved by `T`, and face -y there.
SurfacePatches patches_of_one_voxel(const Pose& T, std::size_t n, bool flat) {
  std::mt19937 rng(11);
  SurfacePatches patches;
  while (patches.size() < n) {
    const Eigen::Vector3d in_voxel = Eigen::Vector3d(10.25, -4.75, 0.25) + random_point(rng, 0.2);
    const Eigen::Vector3d normal = Eigen::Vector3d(0, -1, 0) + random_point(rng, 0.1);
    patches.push_back(patch_at(T.inverse() * in_voxel, T.linear().transpose() * normal, flat));
  }
  return patches;
}

const Pose kPose = exp((Vector6d() << 0.2, -0.3, 1.2, 4, -2, 0.5).finished());

TEST(VoxelTable, NumbersKeysAsAMapDoes) {
  std::mt19937 rng(1);
  std::uniform_int_distribution<int> near(-30, 30), kind(0, 7);
  VoxelTable table;
  std::map<std::int64_t, std::uint32_t> expected;
  for (int i = 0; i < 30000; ++i) {
    const std::int64_t key = voxel_key({near(rng), near(rng), near(rng) / 10}, kind(rng));
    const auto [slot, is_new] = expected.try_emplace(key, std::uint32_t(expected.size()));
    ASSERT_EQ(table.find(key), is_new ? VoxelTable::kNone : slot->second);
    ASSERT_EQ(table.insert(key), slot->second);
    ASSERT_EQ(table.size(), expected.size());
  }
  EXPECT_GT(expected.size(), 20000u);  // it grew several times
  for (const auto& [key, number] : expected) ASSERT_EQ(table.find(key), number);
  EXPECT_EQ(table.find(voxel_key({31, 0, 0}, 0)), VoxelTable::kNone);
  table.clear();
  EXPECT_EQ(table.size(), 0u);
  EXPECT_EQ(table.find(expected.begin()->first), VoxelTable::kNone);
  EXPECT_EQ(table.insert(expected.begin()->first), 0u);
}

TEST(VoxelTable, NoTwoVoxelsShareAKey) {
  std::set<std::int64_t> keys;
  const std::vector<int> steps{-(1 << 19), -1000, -2, -1, 0, 1, 2, 1000, (1 << 19) - 1};
  for (const int x : steps) {
    for (const int y : steps) {
      for (const int z : steps) {
        for (int kind = 0; kind < 8; ++kind) keys.insert(voxel_key({x, y, z}, kind));
      }
    }
  }
  EXPECT_EQ(keys.size(), steps.size() * steps.size() * steps.size() * 8);
}

TEST(PatchMap, AVoxelHoldsTheGaussianOfItsPatches) {
  const PatchMapOptions options{.voxel_size = 0.5, .surface_variance = 1e-9, .blur = 0.02};
  for (const bool flat : {true, false}) {
    const SurfacePatches patches = patches_of_one_voxel(kPose, 10, flat);
    const Joint joint = joint_of(patches, kPose);
    PatchMap map(options);
    map.insert(patches, kPose);
    ASSERT_EQ(map.surfaces().size(), 1u);
    const MapSurface& surface = map.surfaces().front();
    EXPECT_EQ(surface.flat, flat);
    EXPECT_LT((surface.mean - joint.mean).norm(), 1e-9);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(joint.covariance);
    Eigen::Vector3d normal = eigen.eigenvectors().col(0);
    if (normal.y() > 0) normal = -normal;
    EXPECT_LT((surface.normal - normal).norm(), 1e-6);
    EXPECT_NEAR(surface.variance, eigen.eigenvalues()[0], 1e-9);
    if (flat) {
      EXPECT_NEAR(normal.dot(surface.covariance * normal), eigen.eigenvalues()[0], 1e-9);
      EXPECT_GT(eigen.eigenvectors().col(1).dot(surface.covariance * eigen.eigenvectors().col(1)), 0.1);
    } else {
      EXPECT_LT((surface.covariance - joint.covariance - 0.02 * Eigen::Matrix3d::Identity()).norm(), 1e-9);
    }
  }
}

TEST(PatchMap, PatchesThatAreNotFlatMakeAPlaneWhereTheyLieInOne) {
  std::mt19937 rng(11);
  const auto map_of = [&](std::size_t count, double thickness) {
    std::uniform_real_distribution<double> u(0, 0.5);
    std::normal_distribution<double> n(0, thickness);
    SurfacePatches patches;
    while (patches.size() < count) {
      const double y = u(rng), z = u(rng), x = 2.25 + n(rng);
      SurfacePatch patch =
          patch_at({x, y, z}, Eigen::Vector3d::UnitZ(), false);  // a line along a ring, no normal known
      patch.covariance = Eigen::Vector3d(thickness * thickness, 5e-3, thickness * thickness).asDiagonal();
      patches.push_back(patch);
    }
    PatchMap map({.planar_patches = 10});
    map.insert(patches, Pose::Identity());
    return map;
  };
  const PatchMap wall = map_of(40, 0.02);
  const MapSurface* surface = wall.find({2.25, 0.25, 0.25}, Eigen::Vector3d::UnitZ(), false);
  ASSERT_NE(surface, nullptr);
  EXPECT_TRUE(surface->planar);
  EXPECT_FALSE(surface->flat);
  EXPECT_GT(std::abs(surface->normal.x()), 0.99);
  EXPECT_EQ(surface->patches, 40U);
  for (const PatchMap& map : {map_of(9, 0.02), map_of(40, 0.1)})
    EXPECT_FALSE(map.find({2.25, 0.25, 0.25}, Eigen::Vector3d::UnitZ(), false)->planar);
}

TEST(PatchMap, AGaussianIsHardlyEverOld) {
  const SurfacePatches patches = patches_of_one_voxel(kPose, 57, false);
  PatchMap map({.voxel_size = 0.5, .blur = 0});
  for (const SurfacePatch& patch : patches) map.insert({patch}, kPose);
  const Joint joint = joint_of(patches, kPose);
  EXPECT_LT((map.surfaces().front().mean - joint.mean).norm(), 1e-9);
  EXPECT_LT((map.surfaces().front().covariance - joint.covariance).norm(), 0.15 * joint.covariance.norm());
}

TEST(PatchMap, FloorAndWallInOneVoxelStayApart) {
  PatchMap map({.voxel_size = 0.5});
  map.insert(plane({0.25, 0.25, 0.02}, Eigen::Vector3d::UnitZ(), 0.2, 20), Pose::Identity());
  map.insert(plane({0.48, 0.25, 0.25}, -Eigen::Vector3d::UnitX(), 0.2, 20), Pose::Identity());
  ASSERT_EQ(map.surfaces().size(), 2u);
  const MapSurface* floor = map.find({0.3, 0.3, 0.1}, Eigen::Vector3d(0.2, 0.2, 1).normalized(), true);
  const MapSurface* wall = map.find({0.3, 0.3, 0.1}, Eigen::Vector3d(-1, 0.2, 0.2).normalized(), true);
  ASSERT_TRUE(floor != nullptr && wall != nullptr);
  EXPECT_GT(floor->normal.z(), 0.9999);
  EXPECT_NEAR(floor->mean.z(), 0.02, 1e-9);
  EXPECT_LT(wall->normal.x(), -0.9999);
  EXPECT_NEAR(wall->mean.x(), 0.48, 1e-9);
  for (const MapSurface* surface : {floor, wall}) EXPECT_LT(surface->variance, 2e-4);
  EXPECT_EQ(map.find({0.3, 0.3, 0.1}, -Eigen::Vector3d::UnitZ(), true), nullptr);  // nothing faces down
  EXPECT_EQ(map.find({0.3, 0.3, 0.1}, Eigen::Vector3d::UnitZ(), false), nullptr);  // and all is flat
}

TEST(PatchMap, TheTwoSidesOfADoorStayApart) {
  PatchMap map({.voxel_size = 0.5});
  const Eigen::Vector3d out = Eigen::Vector3d::UnitX();
  for (int visit = 0; visit < 2; ++visit) {
    map.insert(plane({1.23, 0.25, 0.25}, -out, 0.2, 15), Pose::Identity());
    map.insert(plane({1.27, 0.25, 0.25}, out, 0.2, 15), Pose::Identity());
  }
  const MapSurface *front = map.find({1.27, 0.2, 0.3}, -out, true), *back = map.find({1.23, 0.2, 0.3}, out, true);
  ASSERT_TRUE(front != nullptr && back != nullptr);
  EXPECT_NEAR(front->mean.x(), 1.23, 1e-9);
  EXPECT_NEAR(back->mean.x(), 1.27, 1e-9);
}

TEST(PatchMap, FindsTheNearestOfTheEightVoxelsAround) {
  struct Entry {
    Eigen::Vector3d mean, voxel_center;
    int kind;  // two an axis; 6: not flat
  };
  const double size = 0.4;
  std::mt19937 rng(7);
  std::uniform_int_distribution<int> cell(-6, 5), any_kind(0, 6);
  const auto direction = [](int kind) {
    return Eigen::Vector3d((kind % 2 ? 1 : -1) * Eigen::Vector3d::Unit(kind / 2));
  };
  const auto normal_of = [&](int kind) { return kind == 6 ? Eigen::Vector3d(1, 0, 0) : direction(kind); };
  std::map<std::int64_t, Entry> entries;  // one patch a voxel and kind
  PatchMap map({.voxel_size = size});
  for (int i = 0; i < 2500; ++i) {
    const Eigen::Vector3i voxel(cell(rng), cell(rng), cell(rng));
    const int kind = any_kind(rng);
    const Eigen::Vector3d center = size * (voxel.cast<double>().array() + 0.5).matrix();
    const Entry entry{center + random_point(rng, 0.49 * size), center, kind};
    if (!entries.try_emplace(voxel_key(voxel, kind), entry).second) continue;
    map.insert({patch_at(entry.mean, normal_of(kind), kind != 6)}, Pose::Identity());
  }
  std::size_t found = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d point = random_point(rng, 7 * size);
    const int kind = any_kind(rng);
    const Entry* nearest = nullptr;
    for (const auto& [key, entry] : entries) {
      if (entry.kind != kind || (entry.voxel_center - point).cwiseAbs().maxCoeff() > size) continue;
      if (!nearest || (entry.mean - point).norm() < (nearest->mean - point).norm()) nearest = &entry;
    }
    const MapSurface* surface = map.find(point, normal_of(kind), kind != 6);
    ASSERT_EQ(surface != nullptr, nearest != nullptr) << point.transpose();
    if (!surface) continue;
    ++found;
    ASSERT_LT((surface->mean - nearest->mean).norm(), 1e-12) << point.transpose();
  }
  EXPECT_GT(found, 500u);
}

TEST(PatchMap, AFullVoxelChangesNoMore) {
  PatchMap map({.voxel_size = 0.5, .max_patches = 12});
  map.insert(patches_of_one_voxel(Pose::Identity(), 12, true), Pose::Identity());
  const MapSurface full = map.surfaces().front();
  SurfacePatches others = patches_of_one_voxel(Pose::Identity(), 30, true);
  for (SurfacePatch& patch : others) patch.mean.y() = -4.99;
  map.insert(others, Pose::Identity());
  ASSERT_EQ(map.surfaces().size(), 1u);
  const MapSurface& after = map.surfaces().front();
  EXPECT_EQ(after.mean, full.mean);
  EXPECT_EQ(after.covariance, full.covariance);
  EXPECT_EQ(after.normal, full.normal);
}

TEST(PatchMap, ForgetsWhatIsFarAndFindsAllTheRest) {
  const double range = 20;
  PatchMap map({.voxel_size = 0.5, .max_range = range});
  std::size_t most = 0;
  for (int x = 0; x < 200; ++x) {
    const Eigen::Vector3d here(x, 0, 0);
    for (const double side : {-1.0, 1.0}) {  // a corridor, 1 m more of it at each step
      const Eigen::Vector3d inwards(0, -side, 0);
      map.insert(plane({0.25, 2.25 * side, 0.25}, inwards, 0.2, 3), Pose(Eigen::Translation3d(here)));
    }
    map.crop(here);
    most = std::max(most, map.surfaces().size());
    for (const MapSurface& surface : map.surfaces()) {
      ASSERT_LT((surface.mean - here).norm(), 1.11 * range);
      ASSERT_EQ(map.find(surface.mean, surface.normal, surface.flat), &surface);
    }
    const std::size_t before = map.surfaces().size();
    map.insert(plane({x - 9.75, 2.25, 0.25}, -Eigen::Vector3d::UnitY(), 0.2, 1), Pose::Identity());
    ASSERT_EQ(map.surfaces().size(), before + (x < 10 ? 1 : 0)) << x;  // a voxel that was kept goes on
  }
  EXPECT_LE(most, 2 * 24u + 10);
  EXPECT_EQ(map.find({0.25, 2.25, 0.25}, -Eigen::Vector3d::UnitY(), true), nullptr);
  for (int x = 185; x < 200; ++x)
    EXPECT_NE(map.find({x + 0.25, -2.25, 0.25}, Eigen::Vector3d::UnitY(), true), nullptr) << x;
}

}  // namespace
}  // namespace tilth
