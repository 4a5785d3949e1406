// tilth calibrate and --beams: the errors of simulated beams are found, and a run is better without them.
#include <algorithm>
#include <csignal>
#include <random>

#include <gtest/gtest.h>

#include "worn_drive.hpp"
#include <tilth/io/beam_file.hpp>

namespace tilth::app {
namespace {

const std::string kSmallWindows = "calibration.window=15";

class Calibrate : public WornDrive {};

TEST_F(Calibrate, FindsTheErrorsOfWornBeamsAndRunsAreBetterWithoutThem) {
  simulate("worn");
  const Outcome outcome = tilth({"calibrate", in("drive"), "--out", in("beams.yaml"), "--set", kSmallWindows});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text : {"windows", "directions", "elevation of beams", "not shown by this drive", "thickness"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << ": " << outcome.out;
  EXPECT_EQ(outcome.out.find("nothing to correct"), std::string::npos);
  const BeamEstimate found = read_beams(folder_ / "beams.yaml");
  const BeamModel truth = read_beams(folder_ / "drive" / "beams.yaml").model;
  ASSERT_EQ(found.model.range.size(), 16U);
  EXPECT_EQ(found.covariance.rows(), 37);
  for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(found.model.range[k], truth.range[k], 0.005) << k;
  const double before = ape(run("before")), after = ape(run("after", {"--beams", in("beams.yaml")}));
  EXPECT_LT(after, 0.6 * before) << before;
  const std::string summary = text_of(folder_ / "after" / "summary.json");
  EXPECT_NE(summary.find("beams: corrected by " + in("beams.yaml") + " (ranges up to 2"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\"source.beams\": \"" + in("beams.yaml")), std::string::npos);
}

// Of only five windows chance passes two deviations now and then: hence the higher bar.
TEST_F(Calibrate, OfIdealBeamsThereIsNothingToCorrect) {
  simulate("ideal");
  const Outcome outcome = tilth({"calibrate", in("drive"), "--out", in("beams.yaml"), "--set", kSmallWindows, "--set",
                                 "calibration.significance=4"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("nothing to correct"), std::string::npos) << outcome.out;
  const Trajectory before = run("before"), after = run("after", {"--beams", in("beams.yaml")});
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((before[i].T_world_lidar.translation() - after[i].T_world_lidar.translation()).norm(), 0.001) << i;
  }
}

TEST_F(Calibrate, RefusesADriveThatIsTooShortAndSaysHowMuchIsMissing) {
  const std::string drive = "sim://corridor_fast?duration=7&columns=300";
  const std::vector<std::string> calibrate{"calibrate", drive, "--out", in("beams.yaml")};
  expect_refused(tilth(calibrate), {drive, "1 window of 12", "at least 3", "drive at least ", " m more"});
}

TEST_F(Calibrate, RefusesWhatCannotBeDoneBeforeItDrives) {
  const std::string drive = "sim://corridor?duration=100";
  const auto calibrate = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"calibrate", drive});
    return tilth(more);
  };
  expect_refused(calibrate({"--out", in("")}), {in(""), "is a folder"});
  expect_refused(calibrate({"--out", in("none/beams.yaml")}), {in("none"), "no such folder"});
  const std::vector<std::string> out{"--out", in("beams.yaml")};
  expect_refused(calibrate({"--out", in("beams.yaml"), "--set", "calibration.window=2"}), {"calibration.window", "5"});
  expect_refused(calibrate({"--out", in("beams.yaml"), "--set", "calibration.windows=9"}), {"calibration.windows"});
  expect_refused(calibrate({"--out", in("beams.yaml"), "--prior", in("none.yaml")}), {"none.yaml"});
}

TEST_F(Calibrate, APriorOfAnotherSensorIsRefused) {
  std::ofstream(in("eight.yaml")) << "version: 1\nrange: [0, 0, 0, 0, 0, 0, 0, 0.01]\n";
  const Outcome outcome = tilth({"calibrate", "sim://corridor_fast?duration=22&columns=300", "--out", in("beams.yaml"),
                                 "--prior", in("eight.yaml"), "--set", "calibration.window=5", "calibration.step=0.2"});
  expect_refused(outcome, {"eight.yaml", "8 beams", "16"});
}

TEST_F(Calibrate, RefusesScansWithoutRings) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at(-9, 9);
  std::filesystem::create_directories(folder_ / "cloud");
  for (int scan = 0; scan < 3; ++scan) {
    std::ofstream file(folder_ / "cloud" / (std::to_string(scan) + ".pcd"));
    file << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 900\nHEIGHT 1\nPOINTS 900\n"
            "DATA ascii\n";
    for (int i = 0; i < 900; ++i) file << at(random) << ' ' << at(random) << ' ' << at(random) << '\n';
  }
  expect_refused(tilth({"calibrate", in("cloud"), "--rate", "10", "--out", in("beams.yaml")}), {"cloud", "rings"});
  std::ofstream(in("zero.yaml")) << "version: 1\nrange: [0, 0.01]\n";
  const Outcome outcome = tilth({"run", in("cloud"), "--rate", "10", "--out", in("out"), "--beams", in("zero.yaml")});
  expect_refused(outcome, {"zero.yaml", "2 beams", "no rings"});
}

TEST_F(Calibrate, ALostTrackIsNoDrive) {
  for (const auto& [scene, duration] : {std::pair("plaza", "1.2"), std::pair("corridor", "5")}) {
    ASSERT_EQ(tilth({"simulate", scene, "--duration", duration, "--set", "columns=400", "--out", in(scene)}).exit_code,
              0);
  }
  const auto scan = [&](const std::string& name, int i) {
    const std::string number = std::to_string(i);
    return folder_ / name / "scans" / (std::string(6 - number.size(), '0') + number + ".pcd");
  };
  for (int i = 0; i < 10; ++i)
    std::filesystem::copy_file(scan("plaza", i), folder_ / "corridor" / "a.pcd"),
        std::filesystem::rename(folder_ / "corridor" / "a.pcd", scan("corridor", i));
  expect_refused(tilth({"calibrate", in("corridor"), "--out", in("beams.yaml")}),
                 {"the track was lost from ", "is not written"}, 3);
}

TEST_F(Calibrate, CtrlCLeavesNothing) {
  const Program program({"calibrate", "sim://corridor", "--out", in("beams.yaml")});
  while (program.running() && program.out_so_far().empty()) ::usleep(5000);
  program.signal(SIGINT);
  expect_refused(program.wait(), {"interrupted", "is not written"}, 130);
}

TEST(RunWithBeams, RefusesAFileOfAnotherSensor) {
  const TemporaryFolder folder;
  const std::string file = folder / "four.yaml", out = folder / "out";
  std::ofstream(file) << "version: 1\nrange: [0, 0, 0.01, 0]\n";
  const Outcome outcome = tilth({"run", "sim://corridor?duration=20&columns=300", "--out", out, "--beams", file});
  EXPECT_EQ(outcome.exit_code, 1);
  for (const char* word : {"four.yaml", "4 beams", "16"}) EXPECT_NE(outcome.err.find(word), std::string::npos);
  EXPECT_EQ(tilth({"run", "sim://corridor?duration=2", "--out", out, "--beams", file + "l"}).exit_code, 1);
}

}  // namespace
}  // namespace tilth::app
