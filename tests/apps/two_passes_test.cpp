// tilth run in two passes: errors of beams that the drive shows are taken out from the first scan on.
#include <fstream>

#include <gtest/gtest.h>

#include "worn_drive.hpp"

namespace tilth::app {
namespace {

/// The first four scans of a recording behind those of another one, 0.1 s apart.
void append_scans(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::size_t scans = 0;
  double last = 0;
  for (std::ifstream times(to / "times.txt"); times >> last;) ++scans;
  std::ofstream times(to / "times.txt", std::ios::app);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto name = [](std::size_t number) { return std::to_string(1000000 + number).substr(1) + ".pcd"; };
    std::filesystem::copy_file(from / "scans" / name(i), to / "scans" / name(scans + i));
    times << std::fixed << last + 0.1 * double(i + 1) << "\n";
  }
}

class TwoPasses : public WornDrive {};

TEST_F(TwoPasses, ARunBeginsAnewWithoutTheErrorsThatItsDriveShows) {
  simulate("worn");
  const double kept = ape(run("kept"));
  const Outcome outcome = tilth({"run", in("drive"), "--out", in("anew")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("begun anew without them"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("beams: corrected by what a first pass found (ranges up to "), std::string::npos);
  EXPECT_LT(ape(read_tum(folder_ / "anew" / "trajectory.tum")), 0.6 * kept) << kept;
  const Outcome next = tilth({"run", in("drive"), "--out", in("next"), "--beams", in("anew") + "/beams.yaml"});
  EXPECT_EQ(next.exit_code, 0) << next.err;
  EXPECT_EQ(next.out.find("begun anew"), std::string::npos) << next.out;
}

// A sensor of more beams takes over at the end: what was found of sixteen says nothing of them.
TEST_F(TwoPasses, ARunThatIsNoBetterWithoutThemKeepsItsBeams) {
  simulate("worn");
  ASSERT_EQ(tilth({"simulate", "corridor_fast", "--duration", "2", "--sensor", "hdl32", "--set", "columns=900", "--out",
                   in("other"), "--quiet"})
                .exit_code,
            0);
  append_scans(folder_ / "other", folder_ / "drive");
  const Outcome outcome = tilth({"run", in("drive"), "--out", in("anew")});
  EXPECT_NE(outcome.out.find("begun anew without them"), std::string::npos) << outcome.out;
  const std::string said = "begun anew with the beams as they are";
  EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  EXPECT_NE(text_of(folder_ / "anew" / "summary.json").find(said), std::string::npos);
  const Outcome kept = tilth({"run", in("drive"), "--out", in("kept"), "--keep-beams"});
  EXPECT_EQ(outcome.exit_code, kept.exit_code);
  EXPECT_EQ(text_of(folder_ / "anew" / "trajectory.tum"), text_of(folder_ / "kept" / "trajectory.tum"));
}

TEST_F(TwoPasses, ARunOfIdealBeamsIsOnePass) {
  simulate("ideal");
  const Outcome outcome = tilth({"run", in("drive"), "--out", in("one")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("begun anew"), std::string::npos) << outcome.out;
  run("kept");
  EXPECT_EQ(text_of(folder_ / "one" / "trajectory.tum"), text_of(folder_ / "kept" / "trajectory.tum"));
}

}  // namespace
}  // namespace tilth::app
