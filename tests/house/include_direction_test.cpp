// Includes run down only: the list of the rooms, held against every #include line.
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "source_files.hpp"

namespace tilth::house {
namespace {

using Rooms = std::map<std::string, std::set<std::string>>;

/// What a room may include of the house, beside itself: the lines "room: room room" of the list that CMake builds by.
Rooms rooms_of(const std::string& list) {
  Rooms rooms;
  for (const std::string& line : lines_of(list)) {
    if (line.empty() || line.starts_with('#') || line.starts_with('[')) continue;
    const std::size_t colon = line.find(':');
    std::istringstream below(line.substr(colon + 1));
    std::set<std::string> names;
    for (std::string name; below >> name;) {
      EXPECT_TRUE(rooms.contains(name)) << line << ": " << name << " does not stand above it in the list";
      names.insert(name);
    }
    EXPECT_TRUE(rooms.emplace(line.substr(0, colon), names).second) << line << ": twice in the list";
  }
  return rooms;
}

Rooms rooms() {
  return rooms_of(read_text(std::filesystem::path(TILTH_SOURCE_DIR) / "cmake/rooms.txt"));
}

/// Where alone a library's headers may stand: beginnings of paths.
const std::map<std::string, std::vector<std::string>> kLibraryHome{
    {"tbb/", {"tilth/core/parallel.hpp", "apps/"}},
    {"hwy/", {"tilth/search/", "tilth/preprocess/", "tilth/features/"}},
    {"nanoflann", {"tilth/search/kdtree"}},
    {"embree", {"tilth/simulation/mesh_world.cpp"}},
    {"sdf/", {"tilth/gazebo/"}},
    {"assimp/", {"tilth/gazebo/mesh_file.cpp"}},
    {"yaml-cpp/",
     {"tilth/io/beam_file.cpp", "tilth/io/config_file.cpp", "tilth/io/rosbag2_metadata.cpp",
      "tilth/sensor/calibration_text.cpp"}},
    {"pugixml", {"tilth/sensor/calibration_text.cpp"}},
    {"lz4", {"tilth/io/"}},
    {"liblzf/", {"tilth/io/lzf.cpp"}},
    {"bzlib", {"tilth/io/"}},
    {"pcap/", {"tilth/io/pcap.cpp"}},
    {"sqlite3", {"tilth/io/rosbag2.cpp"}},
    {"zstd", {"tilth/io/unpack.cpp"}},
    {"zlib.h", {"tilth/report/packed_map.cpp", "tilth/atlas/patch_bytes.cpp"}},
    {"httplib.h", {"apps/tilth/view.cpp"}},
    {"nlohmann/",
     {"tilth/sensor/ouster_metadata.cpp", "tilth/sensor/ouster_encoder.cpp", "tilth/run/", "tilth/report/",
      "tilth/study/", "tilth/view/", "apps/"}},
    {"boost/", {"tilth/view/connection.cpp", "tilth/view/view_server.cpp", "tilth/view/view_hub.hpp"}},
    {"CLI/", {"apps/"}},
    {"nanobind/", {"python/"}},
    {"ceres/", {"tilth/slam/optimize.cpp"}},
    {"pcl/", {}},
    {"ros/", {}},
};

/// All other rooms are silent and blind: no file, no print, no clock, no thread.
const std::set<std::string> kLoudRooms{"io", "gazebo", "sources", "atlas", "run", "report", "study", "view", "node"};
const std::set<std::string> kLoudHeaders{"iostream", "fstream",  "print",   "filesystem", "chrono",
                                         "ctime",    "time.h",   "thread",  "mutex",      "future",
                                         "atomic",   "unistd.h", "csignal", "random",     "condition_variable"};

/// The one thread that an algorithm keeps, and the clock that tells what it cost: what it computes does not depend on
/// when it gets to it (Slam.NoScanWaitsForItsLoops).
const std::string kOwnThread = "tilth/slam/loop_closing_thread.";

std::string room_of(const std::string& path) {
  const std::size_t begin = path.find('/') + 1;
  return path.substr(begin, path.find('/', begin) - begin);
}

TEST(IncludeDirection, RoomsSeeOnlyWhatStandsBelowThem) {
  const Rooms may_include = rooms();
  for (const SourceFile& file : source_files("tilth")) {
    if (file.path == "tilth/tilth.hpp") continue;  // stands above all rooms
    const std::string room = room_of(file.path);
    ASSERT_TRUE(may_include.contains(room)) << file.path << " stands in a room that cmake/rooms.txt does not know";
    for (const std::string& include : includes_of(file.text)) {
      if (!include.starts_with("tilth/")) continue;
      const std::string other = room_of(include);
      EXPECT_TRUE(other == room || may_include.at(room).contains(other)) << file.path << " includes " << include;
    }
  }
}

TEST(IncludeDirection, APipelineKnowsNoOther) {
  const std::set<std::string> pipelines{"tilth_odometry", "improved_floam", "floam", "lego_loam", "lio_sam"};
  for (const SourceFile& file : source_files("tilth/odometry")) {
    const std::string stem = std::filesystem::path(file.path).stem().string();
    if (stem == "make_odometry") continue;
    for (const std::string& include : includes_of(file.text)) {
      if (!include.starts_with("tilth/odometry/")) continue;
      const std::string other = std::filesystem::path(include).stem().string();
      EXPECT_TRUE(stem.starts_with(other) || !pipelines.contains(other)) << file.path << " includes " << include;
    }
  }
}

TEST(IncludeDirection, LibrariesStayInTheirRooms) {
  for (const char* folder : {"tilth", "apps", "python"}) {
    for (const SourceFile& file : source_files(folder)) {
      for (const std::string& include : includes_of(file.text)) {
        for (const auto& [library, homes] : kLibraryHome) {
          if (!include.starts_with(library)) continue;
          const bool at_home = std::any_of(homes.begin(), homes.end(),
                                           [&](const std::string& home) { return file.path.starts_with(home); });
          EXPECT_TRUE(at_home) << file.path << " includes " << include;
        }
      }
    }
  }
}

TEST(IncludeDirection, JsonIsNoPartOfAnInterface) {
  for (const SourceFile& file : source_files("tilth")) {
    if (!file.path.ends_with(".hpp")) continue;
    for (const std::string& include : includes_of(file.text))
      EXPECT_FALSE(include.starts_with("nlohmann/")) << file.path;
  }
}

TEST(IncludeDirection, AlgorithmRoomsAreSilentAndBlind) {
  for (const SourceFile& file : source_files("tilth")) {
    if (kLoudRooms.contains(room_of(file.path)) || file.path.starts_with(kOwnThread)) continue;
    for (const std::string& include : includes_of(file.text)) {
      EXPECT_FALSE(kLoudHeaders.contains(include)) << file.path << " includes " << include;
    }
  }
}

TEST(IncludeDirection, AlgorithmRoomsPrintNothing) {
  const std::regex loud(R"(\b(printf|fprintf|puts|fputs|fopen|getenv|exit|abort)\s*\(|\bstd::(cout|cerr|clog)\b)");
  for (const SourceFile& file : source_files("tilth")) {
    if (kLoudRooms.contains(room_of(file.path))) continue;
    for (const std::string& line : lines_of(file.text))
      EXPECT_FALSE(std::regex_search(line, loud)) << file.path << ": " << line;
  }
}

TEST(IncludeDirection, NobodyIncludesTheApps) {
  for (const SourceFile& file : source_files("tilth")) {
    for (const std::string& include : includes_of(file.text)) {
      EXPECT_FALSE(include.starts_with("apps/") || include.starts_with("../")) << file.path << " includes " << include;
    }
  }
}

}  // namespace
}  // namespace tilth::house
