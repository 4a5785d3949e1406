// --times of tilth run, info, convert and compare: scans that a simulator took at once must not be taken for a spin.
#include <numeric>

#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"

namespace tilth::app {
namespace {

/// The room's scans in the order in which a spinning sensor would fire, though taken at once: times are derived.
PointCloud column_by_column(int index) {
  std::vector<std::uint32_t> order(kBeams * kColumns);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::uint32_t(i % kBeams * kColumns + i / kBeams);
  return select(room_scan(index), order);
}

class PointTimes : public testing::Test {
 protected:
  static constexpr int kScans = 12;

  void SetUp() override {
    for (const char* name : {"plain", "zero"}) std::filesystem::create_directories(folder_ / name);
    for (int k = 0; k < kScans; ++k) {
      PointCloud cloud = column_by_column(k);
      write_scan(folder_ / "plain", k, cloud);
      cloud.times.assign(cloud.size(), 0.0F);
      write_scan(folder_ / "zero", k, cloud);
    }
  }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string file(const std::string& run, const std::string& name) const { return text_of(folder_ / run / name); }

  void run(const std::string& source, const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", in(source), "--rate", "10", "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = tilth(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  TemporaryFolder folder_;
};

TEST_F(PointTimes, OfNoneGiveTheTrajectoryOfTimesOfZero) {
  run("plain", "derived");
  run("plain", "none", {"--times", "none"});
  run("plain?times=none", "uri");
  run("zero", "zeros");
  EXPECT_EQ(file("none", "trajectory.tum"), file("zeros", "trajectory.tum"));
  EXPECT_EQ(file("uri", "trajectory.tum"), file("zeros", "trajectory.tum"));
  EXPECT_NE(file("derived", "trajectory.tum"), file("zeros", "trajectory.tum"));
  EXPECT_NE(file("derived", "summary.json").find("--times none says so"), std::string::npos);
}

TEST_F(PointTimes, StandInTheReportWithTheOtherOptionsOfTheSource) {
  run("plain", "none", {"--times", "none"});
  EXPECT_NE(file("none", "summary.json").find(R"("source.times": "none")"), std::string::npos);
  const std::string page = file("none", "report.html");
  for (const char* text : {"source.times", "source.rate", "as asked for (times=none)"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("source.echoes"), std::string::npos) << "it is as by default";
}

TEST_F(PointTimes, AreToldByInfoAndKeptByConvert) {
  const Outcome derived = tilth({"info", in("plain")}), none = tilth({"info", in("plain"), "--times", "none"});
  EXPECT_NE(derived.out.find("derived from the order of firing"), std::string::npos) << derived.out;
  EXPECT_NE(derived.out.find("--times none says so"), std::string::npos) << derived.out;
  EXPECT_NE(none.out.find("time: none, as asked for (times=none)"), std::string::npos) << none.out;
  EXPECT_EQ(tilth({"convert", in("plain"), in("kept.mcap"), "--times", "none"}).exit_code, 0);
  const Outcome kept = tilth({"info", in("kept.mcap")});
  EXPECT_NE(kept.out.find("scans are snapshots, no point times"), std::string::npos) << kept.out;
}

TEST_F(PointTimes, ThatAreWrongAreRefusedByName) {
  const Outcome wrong = tilth({"run", in("plain"), "--times", "never", "--out", in("out")});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("times"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("auto | none | derived"), std::string::npos) << wrong.err;
  const Outcome simulated = tilth({"run", "sim://corridor?duration=1", "--times", "none", "--out", in("out")});
  EXPECT_EQ(simulated.exit_code, 1);
  EXPECT_NE(simulated.err.find("option times: means nothing for sim://corridor"), std::string::npos) << simulated.err;
}

TEST_F(PointTimes, GoIntoACompare) {
  std::ofstream truth(folder_ / "truth.tum");
  for (int k = 0; k < kScans; ++k) truth << 0.1 * k << ' ' << kStep * k << " 0 0 0 0 0 1\n";
  truth.close();
  const Outcome outcome = tilth({"compare", "--sources", in("plain") + "," + in("plain") + "?times=none", "--truth",
                                 in("truth.tum"), "--pipelines", "tilth", "--align", "origin", "--out", in("both")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_NE(file("both/runs/plain:times=none/tilth", "summary.json").find("as asked for (times=none)"),
            std::string::npos);
  EXPECT_NE(file("both/runs/plain/tilth", "summary.json").find("derived from the order of firing"), std::string::npos);
}

}  // namespace
}  // namespace tilth::app
