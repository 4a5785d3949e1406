// tilth convert: what goes through a format comes out as it went in, as far as the format holds it.
#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

class Convert : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(tilth({"simulate", "corridor", "--out", in("sim"), "--format", "pcap", "--sensor", "vlp16", "--duration",
                     "1", "--quiet"})
                  .exit_code,
              0);
  }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  Outcome convert(const std::string& source, const std::string& target, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"convert", in(source), in(target)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tilth(arguments);
  }

  std::vector<Scan> scans_of(const std::string& source) const {
    const auto opened = open_source(in(source), {});
    std::vector<Scan> scans;
    while (std::optional<Scan> scan = opened->next()) scans.push_back(std::move(*scan));
    return scans;
  }

  void expect_same_scans(const std::string& a, const std::string& b, bool rings_and_times) const {
    SCOPED_TRACE(b);
    const std::vector<Scan> expected = scans_of(a), got = scans_of(b);
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t k = 0; k < got.size(); ++k) {
      const PointCloud &was = expected[k].cloud, &is = got[k].cloud;
      EXPECT_NEAR(got[k].stamp, expected[k].stamp, 1e-8);
      ASSERT_EQ(is.size(), was.size());
      EXPECT_EQ(is.intensities, was.intensities);
      for (std::size_t i = 0; i < is.size(); ++i) ASSERT_LT((is.points[i] - was.points[i]).norm(), 1e-5);
      if (!rings_and_times) continue;
      EXPECT_EQ(is.rings, was.rings);
      ASSERT_EQ(is.times.size(), was.times.size());
      for (std::size_t i = 0; i < is.size(); ++i) ASSERT_NEAR(is.times[i], was.times[i], 1e-6);
    }
  }

  TemporaryFolder folder_;
};

TEST_F(Convert, KeepsScansThroughEveryFormat) {
  for (const std::string target : {"a.mcap", "a.bag", "pcd", "ply", "kitti"}) {
    const bool folder = target.find('.') == std::string::npos;
    const Outcome outcome = convert("sim/scans.pcap", target,
                                    folder ? std::vector<std::string>{"--format", target} : std::vector<std::string>{});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("loss: coordinates become 32-bit floats"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("rings and times of the points are lost") != std::string::npos, target == "kitti");
    expect_same_scans("sim/scans.pcap", target, target != "kitti");
  }
  ASSERT_EQ(convert("a.mcap", "b.bag").exit_code, 0);
  expect_same_scans("a.mcap", "b.bag", true);
}

TEST_F(Convert, CopiesThePacketsOfACapture) {
  ASSERT_EQ(convert("sim/scans.pcap", "copy.pcap").exit_code, 0);
  const std::vector<Scan> expected = scans_of("sim/scans.pcap"), got = scans_of("copy.pcap");
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t k = 0; k < got.size(); ++k) {
    EXPECT_EQ(got[k].stamp, expected[k].stamp);
    EXPECT_EQ(got[k].cloud.points, expected[k].cloud.points);
  }
  const Outcome simulated = tilth({"convert", "sim://corridor?sensor=vlp16&duration=1", in("direct.pcap")});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_EQ(scans_of("direct.pcap").size(), expected.size());
}

TEST_F(Convert, RefusesWhatItWouldDestroyOrCannotDo) {
  const auto refused = [&](const Outcome& outcome, const std::string& reason) {
    EXPECT_EQ(outcome.exit_code, 1) << reason;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
  };
  ASSERT_EQ(convert("sim/scans.pcap", "pcd", {"--max-scans", "5"}).exit_code, 0);
  EXPECT_EQ(scans_of("pcd").size(), 5U);
  refused(convert("sim/scans.pcap", "pcd"), "--force");
  ASSERT_EQ(convert("sim/scans.pcap", "pcd", {"--max-scans", "3", "--force"}).exit_code, 0);
  EXPECT_EQ(scans_of("pcd").size(), 3U) << "those of before are gone";
  refused(convert("sim/scans.pcap", "sim/scans.pcap", {"--force"}), "is the source itself");
  refused(convert("pcd", "scans.pcap"), "holds no packets");
  refused(convert("sim/scans.pcap", "scans.db3"), "expected .pcap, .bag, .mcap");
  refused(convert("sim/scans.pcap", "other", {"--format", "e57"}), "pcd | ply | las");
  refused(convert("none.pcap", "other"), "no such file");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scans.pcap"));
}

TEST_F(Convert, ARunWritesItsMapInEveryFormat) {
  const Outcome outcome = tilth({"run", in("sim/scans.pcap"), "--out", in("run"), "--map-format", "ply,las", "--mcap"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* file : {"map.ply", "map.las", "run.mcap"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "run" / file), 1000U) << file;
    EXPECT_NE(outcome.out.find(file), std::string::npos) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run/map.pcd"));
  const Outcome wrong = tilth({"run", in("sim/scans.pcap"), "--out", in("run"), "--map-format", "pcd,obj"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("'obj': expected pcd, ply, las, bt or tiles"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace tilth::app
