// Scans whose beams are corrected: the points, the sentence that says so, and what is refused.
#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sources/beam_corrected_source.hpp>

namespace tilth {
namespace {

class FewScans : public ScanSource {
 public:
  explicit FewScans(std::vector<Scan> scans) : scans_(std::move(scans)) { contents_ = {"topic /points"}; }

  std::optional<Scan> next() override {
    if (decisions_.empty()) decisions_ = {"ring: in order"};
    if (next_ == scans_.size()) {
      skipped_.push_back({next_, "record 9", "is torn"});
      throw Error("list", "breaks off");
    }
    return scans_[next_++];
  }
  std::optional<std::size_t> size() const override { return scans_.size(); }
  std::vector<std::string> notices() const override { return {"a packet was lost"}; }

 private:
  std::vector<Scan> scans_;
  std::size_t next_ = 0;
};

BeamModel four_beams() {
  BeamModel beams;
  beams.range = {0.01, -0.031, 0.02, 0};
  beams.elevation = {0.005, 0, 0, -0.002};
  return beams;
}

Scan scan_of(const std::vector<Eigen::Vector3d>& points, const std::vector<std::uint16_t>& rings) {
  Scan scan;
  scan.cloud.points = points, scan.cloud.rings = rings;
  return scan;
}

std::unique_ptr<ScanSource> corrected_scans(std::vector<Scan> scans) {
  return beam_corrected_source(std::make_unique<FewScans>(std::move(scans)), four_beams(), "my/beams.yaml");
}

std::string refusal(Scan scan) {
  try {
    corrected_scans({std::move(scan)})->next();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(BeamCorrectedSource, CorrectsEveryScan) {
  const Scan scan = scan_of({{5, 0, 1}, {0, 7, 2}}, {0, 1});
  const auto source = corrected_scans({scan, scan});
  EXPECT_EQ(source->next()->cloud.points, corrected(scan.cloud, four_beams()).points);
  EXPECT_EQ(source->next()->cloud.points, corrected(scan.cloud, four_beams()).points);
}

TEST(BeamCorrectedSource, CorrectsInTheFrameOfTheSensor) {
  const Eigen::Isometry3d T_cloud_sensor =
      Eigen::Translation3d(0.3, 0, 1) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY());
  const Scan in_sensor = scan_of({{5, 0, 1}, {0, 7, 2}}, {0, 3});
  Scan scan{in_sensor.stamp, transform(in_sensor.cloud, T_cloud_sensor), T_cloud_sensor};
  const std::optional<Scan> found = corrected_scans({scan})->next();
  const PointCloud expected = transform(corrected(in_sensor.cloud, four_beams()), T_cloud_sensor);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((found->cloud.points[i] - expected.points[i]).norm(), 1e-12);
  EXPECT_TRUE(found->T_cloud_sensor.has_value());
}

TEST(BeamCorrectedSource, HandsOnWhatTheSourceSaysAndItsOwnSentence) {
  const auto source = corrected_scans({scan_of({{5, 0, 1}}, {0})});
  EXPECT_EQ(source->contents(), std::vector<std::string>{"topic /points"});
  EXPECT_EQ(source->size(), 1U);
  source->next();
  EXPECT_EQ(
      source->decisions(),
      (std::vector<std::string>{"ring: in order",
                                "beams: corrected by my/beams.yaml (ranges up to 31 mm, elevations up to 0.29 deg)"}));
  EXPECT_EQ(source->notices(), std::vector<std::string>{"a packet was lost"});
  EXPECT_TRUE(source->skipped().empty());
  EXPECT_THROW(source->next(), Error);
  ASSERT_EQ(source->skipped().size(), 1U);
  EXPECT_EQ(source->skipped()[0].where, "record 9");
}

TEST(BeamCorrectedSource, RefusesCloudsWithoutRings) {
  const std::string text = refusal(scan_of({{5, 0, 1}}, {}));
  for (const char* word : {"my/beams.yaml", "4 beams", "no rings"})
    EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(BeamCorrectedSource, RefusesMoreRingsThanTheFileHas) {
  const std::string text = refusal(scan_of({{5, 0, 1}}, {31}));
  for (const char* word : {"my/beams.yaml", "4 beams", "32"}) EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(BeamCorrectedSource, FewerRingsOrNoPointsAreFine) {
  const auto source = corrected_scans({scan_of({{5, 0, 1}}, {2}), Scan{}});
  EXPECT_EQ(source->next()->cloud.size(), 1U);
  EXPECT_TRUE(source->next()->cloud.empty());
}

TEST(BeamCorrectedSource, AFileOfAnotherSensorIsRefusedWhereItHasNothingToCorrectToo) {
  BeamModel zero;
  zero.range.assign(4, 0.0);
  const auto source = beam_corrected_source(
      std::make_unique<FewScans>(std::vector{scan_of({{5, 0, 1}}, {2}), scan_of({{5, 0, 1}}, {8})}), zero, "zero.yaml");
  EXPECT_EQ(source->next()->cloud.points[0], Eigen::Vector3d(5, 0, 1));
  EXPECT_EQ(source->decisions().back(), "beams: zero.yaml has nothing to correct");
  EXPECT_THROW(source->next(), Error);
}

}  // namespace
}  // namespace tilth
