// tilth simulate on Gazebo worlds and on ways of the user's own: what is written, and what is refused.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/core/trajectory.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/simulation/beam_flaws.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

/// A room of 10 x 6 x 3 m about the origin of the floor, its walls 1 m thick, and a chair whose mesh is missing.
const std::string kRoom = [] {
  const auto box = [](const std::string& name, const std::string& pose, const std::string& size) {
    return "<visual name=\"" + name + "\"><pose>" + pose + " 0 0 0</pose><geometry><box><size>" + size +
           "</size></box></geometry></visual>";
  };
  return "<?xml version=\"1.0\"?><sdf version=\"1.6\"><world name=\"room\"><model name=\"shell\"><link name=\"l\">" +
         box("floor", "0 0 -0.5", "12 8 1") + box("ceiling", "0 0 3.5", "12 8 1") + box("east", "5.5 0 1.5", "1 8 3") +
         box("west", "-5.5 0 1.5", "1 8 3") + box("north", "0 3.5 1.5", "12 1 3") +
         box("south", "0 -3.5 1.5", "12 1 3") +
         "</link></model><model name=\"chair\"><link name=\"l\"><visual name=\"v\"><geometry><mesh>"
         "<uri>model://chair/chair.dae</uri></mesh></geometry></visual></link></model></world></sdf>";
}();

class Simulate : public testing::Test {
 protected:
  Simulate() { write("room.world", kRoom); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  Outcome simulate(const std::string& scene, const std::vector<std::string>& more,
                   const std::string& out = "out") const {
    std::vector<std::string> arguments{"simulate", scene, "--out", path(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tilth(arguments);
  }
  Outcome room(const std::vector<std::string>& more, const std::string& out = "out") const {
    return simulate(path("room.world"), more, out);
  }
  static void expect_refused(const Outcome& outcome, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << ": " << outcome.err;
  }
  std::size_t scans(const std::string& out = "out") const {
    return std::size_t(std::distance(fs::directory_iterator(folder_ / out / "scans"), {}));
  }

  TemporaryFolder folder_;
};

/// [m] from the nearest inner side of the room.
double off_the_walls(const Eigen::Vector3d& p) {
  return std::min({std::abs(std::abs(p.x()) - 5), std::abs(std::abs(p.y()) - 3), std::abs(p.z()), std::abs(p.z() - 3)});
}

std::map<std::string, std::vector<double>> columns_of(const fs::path& scan) {
  const PointRecords records = read_pcd(scan);
  std::map<std::string, std::vector<double>> columns;
  for (const PointField& field : records.fields) columns[field.name] = column(records, field);
  return columns;
}

TEST_F(Simulate, AWorldAlongWayPoints) {
  const Outcome outcome = room({"--waypoints", "-3,0;3,0;3,2", "--cruise", "2", "--set", "columns=200", "noise=0",
                                "outliers=0", "mixed=0", "quantize=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("model://chair/chair.dae"), std::string::npos) << outcome.err;
  const Trajectory truth = read_tum(folder_ / "out" / "truth.tum");
  EXPECT_LT((truth.front().T_world_lidar.translation() - Eigen::Vector3d(-3, 0, 0.8)).norm(), 1e-9);
  EXPECT_LT((truth.back().T_world_lidar.translation() - Eigen::Vector3d(3, 2, 0.8)).norm(), 1e-6);
  ASSERT_GT(scans(), 30u);
  std::ifstream times(folder_ / "out" / "times.txt");
  double stamp = 0;
  for (int i = 0; times >> stamp; ++i) {
    const std::string name = std::string(i < 10 ? "00000" : "0000") + std::to_string(i);
    const auto values = columns_of(folder_ / "out" / "scans" / (name + ".pcd"));
    const std::vector<double>&x = values.at("x"), &y = values.at("y"), &z = values.at("z"), &time = values.at("time");
    ASSERT_EQ(fs::file_size(folder_ / "out" / "labels" / (name + ".bin")), x.size());
    for (std::size_t k = 0; k < x.size(); k += 7) {
      const Pose T = interpolate(truth, stamp + time[k]);
      ASSERT_LT(off_the_walls(T * Eigen::Vector3d(x[k], y[k], z[k])), 2e-4) << "scan " << i << ", point " << k;
    }
  }
  EXPECT_NE(text_of(folder_ / "out" / "scene" / "mesh.ply").find("shell/l/east"), std::string::npos);
}

TEST_F(Simulate, ItsRecipeMakesTheSameAgain) {
  ASSERT_EQ(room({"--waypoints", "-3,0;3,0", "--duration", "1", "--seed", "4", "--beams", "worn", "--set",
                  "columns=100", "walk=0.01"})
                .exit_code,
            0);
  const std::string recipe = text_of(folder_ / "out" / "recipe.txt");
  std::string command = recipe.substr(recipe.find("\ntilth ") + 1);
  command = command.substr(0, command.find('\n'));
  command.replace(0, 5, TILTH_BINARY);
  command.replace(command.find("--out DIR"), 9, "--quiet --out " + path("again"));
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  for (const char* file : {"truth.tum", "times.txt", "beams.yaml", "recipe.txt", "scans/000003.pcd",
                           "labels/000003.bin", "scene/mesh.ply"}) {
    EXPECT_EQ(text_of(folder_ / "out" / file), text_of(folder_ / "again" / file)) << file;
  }
}

TEST_F(Simulate, TheErrorsOfTheBeamsAreWrittenOut) {
  ASSERT_EQ(room({"--waypoints", "-3,0;3,0", "--duration", "1", "--beams", "worn", "--set", "walk=0.01", "beam_seed=9"})
                .exit_code,
            0);
  BeamFlawOptions flaws = flaws_of(BeamPreset::worn);
  flaws.walk = 0.01;
  const BeamModel drawn = draw_beams(flaws, 16, 9), written = read_beams(folder_ / "out" / "beams.yaml").model;
  EXPECT_EQ(written.range, drawn.range);
  EXPECT_EQ(written.elevation, drawn.elevation);
  EXPECT_EQ(written.encoder, drawn.encoder);
  EXPECT_EQ(written.walk, 0.01);
  EXPECT_EQ(written.bright, drawn.bright);
  expect_refused(room({"--waypoints", "-3,0;3,0", "--sensor", "rosette", "--beams", "worn"}), {"sensor rosette"});
  expect_refused(room({"--waypoints", "-3,0;3,0", "--beams", "bent"}), {"option beams", "ideal | good | worn"});
}

TEST_F(Simulate, AlongATrajectoryFile) {
  write("way.tum",
        "# a pose a line\n100 -3 0 1.2 0 0 0 1\n102 0 0.5 1.2 0 0 0.7071068 0.7071068\n103 1 1 1.2 0 0 1 0\n");
  ASSERT_EQ(room({"--path", path("way.tum"), "--set", "columns=100"}).exit_code, 0);
  const Trajectory truth = read_tum(folder_ / "out" / "truth.tum");
  EXPECT_EQ(truth.front().stamp, 0);
  EXPECT_NEAR(truth.back().stamp, 3, 1e-9);
  EXPECT_LT((interpolate(truth, 2).translation() - Eigen::Vector3d(0, 0.5, 1.2)).norm(), 1e-6);
}

TEST_F(Simulate, ABuiltInSceneTakesWayPointsToo) {
  ASSERT_EQ(simulate("corridor", {"--waypoints", "1,0;4,0.3,1", "--set", "columns=100", "vibration=0"}).exit_code, 0);
  const Trajectory truth = read_tum(folder_ / "out" / "truth.tum");
  EXPECT_LT((truth.back().T_world_lidar.translation() - Eigen::Vector3d(4, 0.3, 1)).norm(), 1e-6);
}

TEST_F(Simulate, ModelsComeFromTheFoldersGiven) {
  fs::create_directories(folder_ / "first" / "nothing");
  fs::create_directories(folder_ / "second" / "chair");
  write("second/chair/chair.dae", "no mesh");
  const std::vector<std::string> way{"--waypoints", "-3,0;3,0", "--duration", "0.3", "--model-path", path("first")};
  EXPECT_NE(room(way).err.find("not found"), std::string::npos);
  std::vector<std::string> both = way;
  both.insert(both.end(), {"--model-path", path("second")});
  EXPECT_NE(room(both).err.find("no mesh that can be read"), std::string::npos);
  both.push_back("--quiet");
  EXPECT_EQ(room(both).err, "");
  expect_refused(room({"--waypoints", "-3,0;3,0", "--model-path", path("third")}), {"third", "no folder"});
}

TEST_F(Simulate, RunTakesAWorldAsItsSource) {
  const std::string uri = "sim://" + path("room.world") + "?waypoints=-3,0;-2,0&columns=400&duration=1.2";
  const Outcome outcome = tilth({"run", uri, "--out", path("run")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_tum(folder_ / "run" / "trajectory.tum").size(), 11u);
  EXPECT_NE(text_of(folder_ / "run" / "summary.json").find("model://chair/chair.dae"), std::string::npos);
}

TEST_F(Simulate, RefusesAWorldWithoutAWayAndSaysHowToGiveOne) {
  expect_refused(room({}), {"room.world", "--waypoints", "--path"});
  expect_refused(tilth({"run", "sim://" + path("room.world"), "--out", path("run")}), {"room.world", "waypoints"});
}

TEST_F(Simulate, RefusesBadWays) {
  write("back.tum", "1 0 0 1 0 0 0 1\n0.5 1 0 1 0 0 0 1\n");
  write("same.tum", "1 0 0 1 0 0 0 1\n1 1 0 1 0 0 0 1\n");
  write("one.tum", "1 0 0 1 0 0 0 1\n");
  write("words.tum", "there and back\n");
  expect_refused(room({"--path", path("none.tum")}), {"none.tum"});
  expect_refused(room({"--path", path("back.tum")}), {"back.tum", "2"});
  expect_refused(room({"--path", path("same.tum")}), {"same.tum", "not after"});
  expect_refused(room({"--path", path("one.tum")}), {"one.tum", "two poses"});
  expect_refused(room({"--path", path("words.tum")}), {"words.tum", "1"});
  expect_refused(room({"--waypoints", "0,0"}), {"waypoints", "two"});
  expect_refused(room({"--waypoints", "0,0;0,zero"}), {"0,zero"});
  expect_refused(room({"--waypoints", "0,0;0,0"}), {"waypoints", "same"});
  expect_refused(room({"--waypoints", "0,0;1,1", "--path", path("one.tum")}), {"waypoints", "path"});
  expect_refused(room({"--waypoints", "0,0;1,1", "--cruise", "0"}), {"cruise"});
  expect_refused(simulate("corridor", {"--path", path("none.tum")}), {"none.tum"});
}

TEST_F(Simulate, RefusesWhatIsNoWorld) {
  const std::vector<std::string> way{"--waypoints", "0,0;1,1"};
  write("garbage.world", std::string("\x7f"
                                     "ELF\x00\x00",
                                     6));
  write("torn.sdf", kRoom.substr(0, kRoom.size() / 2));
  write("bad.sdf",
        "<sdf version=\"1.6\"><world name=\"w\"><model name=\"m\"><link name=\"l\"><visual name=\"v\"><geometry>"
        "<box><size>one</size></box></geometry></visual></link></model></world></sdf>");
  expect_refused(simulate(path("none.world"), way), {"none.world", "no such file"});
  expect_refused(simulate(path("garbage.world"), way), {"garbage.world", "<sdf>"});
  expect_refused(simulate(path("torn.sdf"), way), {"torn.sdf", "XML"});
  expect_refused(simulate(path("bad.sdf"), way), {"bad.sdf", "box/size"});
  expect_refused(simulate("corridoor", way), {"corridoor", ".world"});
  expect_refused(room({"--waypoints", "0,0;1,1", "--set", "people=3"}), {"people"});
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

// Derived times would bend scans that were taken at once: 0.27 m instead of 1 mm in the plaza.
TEST_F(Simulate, ASnapshotIsReadBackAsOne) {
  ASSERT_EQ(simulate("corridor", {"--snapshot", "--set", "columns=300", "duration=1", "--quiet"}).exit_code, 0);
  const Outcome info = tilth({"info", path("out")});
  EXPECT_NE(info.out.find("scans are snapshots, no point times"), std::string::npos) << info.out;
}

}  // namespace
}  // namespace tilth::app
