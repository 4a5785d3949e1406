// Maps come back as they were written; what is damaged is refused with file and reason; the old map outlives a crash.
#include <csignal>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/atlas/map_files.hpp>
#include <tilth/atlas/map_folder.hpp>
#include <tilth/atlas/map_writer.hpp>
#include <tilth/atlas/patch_bytes.hpp>
#include <tilth/io/output_file.hpp>

namespace tilth {
namespace {

SurfacePatches some_patches(int count, double shift) {
  SurfacePatches patches;
  for (int i = 0; i < count; ++i) {
    SurfacePatch patch;
    patch.mean = Eigen::Vector3d(shift + 0.5 * i, 1.25 * i, -0.75);
    patch.covariance = Eigen::Vector3d(0.25, 0.125, 0.0625).asDiagonal();
    patch.covariance(0, 1) = patch.covariance(1, 0) = 0.03125;
    patch.normal = i % 2 == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    patch.thickness = 0.5F, patch.points = std::uint16_t(3 + i), patch.ring = std::uint16_t(i);
    patch.flat = i % 3 != 0;
    patches.insert(patches.end(), 2, patch);  // what is seen once is no upright cell
  }
  return patches;
}

Pose place_at(double x) {
  return Pose(Eigen::Translation3d(x, 2, 0.5) * Eigen::AngleAxisd(0.3 * x, Eigen::Vector3d::UnitZ()));
}

void write_map(const std::filesystem::path& folder, int places, const std::string& source) {
  MapWriter writer(folder);
  PoseGraph graph;
  for (int i = 0; i < places; ++i) {
    const MapPlace place{10.0 + i, place_at(i), (1.0 + i) * Matrix6d::Identity(), 0};
    writer.add(place, some_patches(5, i));
    graph.poses.push_back(place.T_map_lidar);
    if (i > 0) graph.constraints.push_back({std::size_t(i - 1), std::size_t(i), place_at(1), Matrix6d::Identity()});
  }
  BeamEstimate beams;
  beams.model.range = {0.01, -0.02};
  writer.finish({"1.2.3", source}, graph, beams);
}

std::vector<std::byte> bytes_in(const std::filesystem::path& path) {
  return read_file(path);
}

void put(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.close();
}

/// Everything that can be asked of a map.
void read_all(const std::filesystem::path& folder) {
  const MapFolder map(folder);
  for (std::size_t i = 0; i < map.places().size(); ++i) map.patches(i);
  map.graph();
  map.beams();
}

TEST(MapFolder, HoldsWhatWasWritten) {
  const TemporaryFolder folder;
  write_map(folder / "map", 3, "it's here: \"x\"");
  const MapFolder map(folder / "map");
  EXPECT_EQ(map.origin().program, "1.2.3");
  EXPECT_EQ(map.origin().source, "it's here: \"x\"");
  ASSERT_EQ(map.places().size(), 3U);
  const MapPlace& place = map.places()[2];
  EXPECT_EQ(place.stamp, 12.0);
  EXPECT_TRUE(place.T_map_lidar.isApprox(place_at(2), 1e-12));
  EXPECT_TRUE(place.covariance.isApprox(3.0 * Matrix6d::Identity()));
  const SurfacePatches expected = some_patches(5, 2), patches = map.patches(2);
  ASSERT_EQ(patches.size(), expected.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    EXPECT_EQ(patches[i].mean, expected[i].mean);  // all of them are exact as floats
    EXPECT_EQ(patches[i].covariance, expected[i].covariance);
    EXPECT_EQ(patches[i].normal, expected[i].normal);
    EXPECT_EQ(patches[i].thickness, expected[i].thickness);
    EXPECT_EQ(patches[i].points, expected[i].points);
    EXPECT_EQ(patches[i].ring, expected[i].ring);
    EXPECT_EQ(patches[i].flat, expected[i].flat);
  }
  EXPECT_EQ(map.graph().constraints.size(), 2U);
  ASSERT_TRUE(map.beams());
  EXPECT_EQ(map.beams()->model.range, (std::vector<double>{0.01, -0.02}));
  EXPECT_FALSE(map.uprights().empty());
}

TEST(MapFolder, RefusesEveryFileTruncatedAtEveryLength) {
  const TemporaryFolder folder;
  const std::filesystem::path map = folder / "map";
  write_map(map, 3, "s");
  for (const char* file : {kMapList, kMapPlaces, kMapUprights, kMapPatches, kMapGraph, kMapBeams}) {
    const std::vector<std::byte> whole = bytes_in(map / file);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      put(map / file, std::span(whole).first(length));
      if (file == std::string(kMapList) && length + 1 == whole.size()) continue;  // only its last line end is missing
      SCOPED_TRACE(std::string(file) + " of " + std::to_string(length) + " bytes");
      expect_error([&] { read_all(map); }, {file});
    }
    std::filesystem::remove(map / file);
    expect_error([&] { read_all(map); }, {file});
    put(map / file, whole);
  }
  EXPECT_NO_THROW(read_all(map));
}

TEST(MapFolder, RefusesEveryFileWithAByteChanged) {
  const TemporaryFolder folder;
  const std::filesystem::path map = folder / "map";
  write_map(map, 3, "s");
  for (const char* file : {kMapPlaces, kMapUprights, kMapPatches, kMapGraph, kMapBeams}) {
    const std::vector<std::byte> whole = bytes_in(map / file);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      std::vector<std::byte> changed = whole;
      changed[i] ^= std::byte(1 << (i % 8));
      put(map / file, changed);
      SCOPED_TRACE(std::string(file) + ", byte " + std::to_string(i));
      expect_error([&] { read_all(map); }, {file});
    }
    put(map / file, whole);
  }
  const std::vector<std::byte> list = bytes_in(map / kMapList);
  expect_corruption_survived(list, 500, [&](const std::vector<std::byte>& bytes) {
    put(map / kMapList, bytes);
    read_all(map);
  });
}

TEST(MapFolder, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  expect_error([&] { MapFolder map(folder / "none"); }, {"none", "is no folder of a map"});
  std::filesystem::create_directory(folder / "empty");
  expect_error([&] { MapFolder map(folder / "empty"); }, {"empty", "is no map", kMapList});
  write_map(folder / "map", 2, "s");
  std::string list(as_text(bytes_in(folder / "map" / kMapList)));
  list.replace(list.find("format: 1"), 9, "format: 7");
  write_text(folder / "map" / kMapList, list);
  expect_error([&] { MapFolder map(folder / "map"); }, {kMapList, "format", "is 7", "later version"});
}

TEST(MapWriter, ReplacesMapsAndNothingElse) {
  const TemporaryFolder folder;
  write_map(folder / "map", 2, "old");
  write_map(folder / "map", 4, "new");
  EXPECT_EQ(MapFolder(folder / "map").places().size(), 4U);
  EXPECT_FALSE(std::filesystem::exists(folder / "map.partial"));
  std::filesystem::create_directory(folder / "photos");
  write_text(folder / "photos" / "a", "b");
  expect_error([&] { MapWriter writer(folder / "photos"); }, {"photos", "is no map"});
}

TEST(MapWriter, LeavesTheOldMapWhereItDoesNotFinish) {
  const TemporaryFolder folder;
  write_map(folder / "map", 2, "old");
  {
    MapWriter writer(folder / "map");
    writer.add({}, some_patches(3, 0));
  }
  EXPECT_EQ(MapFolder(folder / "map").origin().source, "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "map.partial"));
  MapWriter writer(folder / "map");
  expect_error([&] { writer.finish({}, {}, {}); }, {"no place"});
}

TEST(MapWriter, KilledAtAnyTimeLeavesAWholeMap) {
  const TemporaryFolder folder;
  const std::filesystem::path map = folder / "map";
  write_map(map, 2, "old");
  for (int round = 0; round < 40; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int i = 0;; ++i) write_map(map, 2 + i % 3, "new");
    }
    ::usleep(useconds_t(300 + 411 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_NO_THROW(read_all(map)) << "round " << round;
  }
}

}  // namespace
}  // namespace tilth
