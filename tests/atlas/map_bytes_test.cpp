// What stands behind the checksums holds on its own: bytes from anywhere are refused or understood, never a crash.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include <tilth/atlas/patch_bytes.hpp>
#include <tilth/atlas/place_table.hpp>

namespace tilth {
namespace {

SurfacePatches two_patches() {
  SurfacePatch patch;
  patch.mean = {1, 2, 3}, patch.normal = Eigen::Vector3d::UnitX(), patch.flat = true;
  return {2, patch};
}

TEST(MapBytes, PatchesSurviveAnyBytes) {
  const std::vector<std::byte> bytes = bytes_of(two_patches());
  expect_truncations_refused(
      bytes, [](const std::vector<std::byte>& some) { patches_of(some, "p"); },
      [&](std::size_t length) { return length % (bytes.size() / 2) == 0; });
  expect_corruption_survived(bytes, 5000, [](const std::vector<std::byte>& some) {
    for (const SurfacePatch& patch : patches_of(some, "p")) EXPECT_TRUE(patch.mean.allFinite());
  });
}

// One that is no number hides behind the largest of those that are.
TEST(MapBytes, RefusesPatchesWithValuesThatAreNoNumbers) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    SurfacePatches nowhere = two_patches(), shapeless = two_patches();
    nowhere[1].mean[axis] = shapeless[1].covariance(axis, axis) = std::nan("");
    expect_error([&] { patches_of(bytes_of(nowhere), "p"); }, {"p", "patch 1"});
    expect_error([&] { patches_of(bytes_of(shapeless), "p"); }, {"p", "patch 1"});
  }
}

TEST(MapBytes, PlacesSurviveAnyBytes) {
  const std::vector<PlaceRecord> records(2, PlaceRecord{.place = {.patches = 1}, .begin = 10, .size = 20});
  const std::vector<std::byte> bytes = bytes_of(records);
  expect_truncations_refused(
      bytes, [](const std::vector<std::byte>& some) { records_of(some, 100, "r"); },
      [&](std::size_t length) { return length % (bytes.size() / 2) == 0; });
  expect_corruption_survived(bytes, 5000, [](const std::vector<std::byte>& some) {
    for (const PlaceRecord& record : records_of(some, 100, "r")) {
      EXPECT_TRUE(record.place.T_map_lidar.matrix().allFinite());
      EXPECT_LE(record.begin + record.size, 100U);
    }
  });
  expect_error([&] { records_of(bytes, 25, "r"); }, {"r, place 0", "byte 10 to 30", "25"});
}

TEST(MapBytes, RefusesCellsBeyondTheWorld) {
  for (const std::int32_t x : {std::numeric_limits<std::int32_t>::min(), 1 << 25})
    expect_error([&] { cells_of(bytes_of(std::vector<UprightCell>{{x, 0, 1}}), "c"); }, {"c, cell 0", "lies farther"});
}

TEST(MapBytes, CellsSurviveAnyBytes) {
  const std::vector<std::byte> bytes = bytes_of(std::vector<UprightCell>{{3, -4, 1}, {5, -4, 255}});
  expect_truncations_refused(
      bytes, [](const std::vector<std::byte>& some) { cells_of(some, "c"); },
      [&](std::size_t length) { return length % (bytes.size() / 2) == 0; });
  expect_corruption_survived(bytes, 5000, [](const std::vector<std::byte>& some) { cells_of(some, "c"); });
}

}  // namespace
}  // namespace tilth
