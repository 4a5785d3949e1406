// Worlds that a test writes, reads and casts single rays in.
#pragma once

#include <fstream>
#include <io/temporary_folder.hpp>
#include <string>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/gazebo/world_file.hpp>
#include <tilth/simulation/mesh_world.hpp>

namespace tilth {

constexpr double kExact = 1e-6;  // [m]; Embree finds the triangle in float, the distance is worked out in double
constexpr double kRound = 2e-3;  // [m] for round surfaces, which are made of triangles

class MadeWorld : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  /// A world of that SDF version with `inside`.
  void write_world(const std::string& inside, const std::string& version = "1.9") const {
    write("test.world", "<?xml version=\"1.0\"?>\n<sdf version=\"" + version + "\">\n<world name=\"w\">" + inside +
                            "</world>\n</sdf>\n");
  }

  void write_model(const std::string& folder, const std::string& inside, const std::string& version = "1.9") const {
    const std::string name = std::filesystem::path(folder).filename();
    write(folder + "/model.config", "<?xml version=\"1.0\"?><model><name>" + name + "</name><sdf version=\"" + version +
                                        "\">model.sdf</sdf></model>");
    write(folder + "/model.sdf", "<?xml version=\"1.0\"?><sdf version=\"" + version + "\"><model name=\"" + name +
                                     "\">" + inside + "</model></sdf>");
  }

  WorldFile read(const std::vector<std::string>& folders = {}) const {
    return read_world_file(folder_ / "test.world", folders);
  }

  /// Reads what was written; the warnings are kept.
  void load(const std::vector<std::string>& folders = {}) {
    WorldFile file = read(folders);
    warnings_ = file.warnings;
    world_ = std::make_unique<MeshWorld>(std::move(file.mesh), std::move(file.movers));
  }

  Hit hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double time = 0) const {
    const Ray ray{origin, direction.normalized(), time};
    return world_->cast(std::span(&ray, 1)).front();
  }
  double range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double time = 0) const {
    return hit(origin, direction, time).distance;
  }

  bool warned_of(const std::string& word) const {
    return std::any_of(warnings_.begin(), warnings_.end(),
                       [&](const std::string& text) { return text.find(word) != std::string::npos; });
  }

  void expect_refused(const std::string& word) const {
    try {
      read();
      FAIL() << "was not refused";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("test.world"), std::string::npos) << error.what();
    }
  }

  TemporaryFolder folder_;
  std::unique_ptr<MeshWorld> world_;
  std::vector<std::string> warnings_;
};

/// A model of one link with one visual.
inline std::string model(const std::string& name, const std::string& pose, const std::string& geometry,
                         const std::string& kind = "visual") {
  return "<model name=\"" + name + "\"><static>true</static><pose>" + pose + "</pose><link name=\"link\"><" + kind +
         " name=\"" + kind + "\"><geometry>" + geometry + "</geometry></" + kind + "></link></model>";
}

inline const std::string kUnitBox = "<box><size>1 1 1</size></box>";

}  // namespace tilth
