// How a localised recording ends: what was localised before stays, whatever comes.
#include <gtest/gtest.h>

#include "localization/made_map.hpp"
#include "run/scan_list.hpp"
#include <tilth/run/localization_run.hpp>

namespace tilth {
namespace {

class LocalizationRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::vector<Leg> legs{{1, 0, 0}, {4, 1.0, 0}, {1, 0, 0}};
    const Simulator mapped(corridor_scene({10, {3}}, legs),
                           simulation_options("corridor", {{"people", "0"}, {"columns", "300"}}));
    map_ = std::make_unique<MadeMap>(map_of(mapped));
  }
  static void TearDownTestSuite() { map_.reset(); }

  RunEnd run(ScanList scans, const SessionOptions& options = {}) {
    Localizer localizer(
        *map_, [] { return std::make_unique<MetreAScan>(); }, {}, std::nullopt);
    RunObserver nobody;
    return localize(scans, localizer, {options}, nobody, record);
  }

  RunRecord record;

 private:
  static inline std::unique_ptr<MadeMap> map_;
};

TEST_F(LocalizationRun, KeepsWhatCameBeforeTheInputBreaksOff) {
  ScanList torn(small_scans(8));
  torn.breaks_off_at = 5;
  EXPECT_EQ(run(std::move(torn)), RunEnd::input_broken);
  EXPECT_EQ(record.localization->rows.size(), 5U);
  EXPECT_EQ(record.ended, to_text(RunEnd::input_broken));
  ASSERT_EQ(record.skipped.size(), 1U);
  EXPECT_NE(record.skipped[0].what.find("is torn"), std::string::npos);
}

TEST_F(LocalizationRun, PassesOverAScanThatCannotBeUsed) {
  std::vector<Scan> scans = small_scans(6);
  scans[2].cloud = {};
  EXPECT_EQ(run(ScanList(std::move(scans))), RunEnd::end_of_input);
  EXPECT_EQ(record.localization->rows.size(), 5U);
  EXPECT_EQ(record.skipped.size(), 1U);
}

TEST_F(LocalizationRun, EndsAtSuchAScanWhereItIsStrict) {
  std::vector<Scan> scans = small_scans(6);
  scans[2].cloud = {};
  EXPECT_EQ(run(ScanList(std::move(scans)), {.strict = true}), RunEnd::bad_record);
  EXPECT_EQ(record.localization->rows.size(), 2U);
}

LocalizationRow search_at(double stamp, double scale) {
  LocalizationRow row{.stamp = stamp};
  row.hypotheses.push_back({.scale = scale});
  return row;
}

TEST(ReasonOfFailure, IsTheSizeWhereSearchesAgreeOnIt) {
  LocalizationRecord record;
  for (const double scale : {1.25, 1.251, 1.249, 1.0})
    record.rows.push_back(search_at(double(record.rows.size()), scale));
  const auto reason = reason_of_failure(record, 0.02);
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("the map is 1.25 times as large"), std::string::npos) << *reason;
  record.rows.push_back({.stamp = 9, .state = MapState::located});
  EXPECT_FALSE(reason_of_failure(record, 0.02));
}

TEST(ReasonOfFailure, IsNotTheSizeWhereItIsRightOrVaries) {
  LocalizationRecord right, varying;
  for (const double scale : {1.0, 1.003, 0.995}) right.rows.push_back(search_at(0, scale));
  for (const double scale : {1.3, 0.8, 1.1, 0.9, 1.0}) varying.rows.push_back(search_at(0, scale));
  EXPECT_FALSE(reason_of_failure(right, 0.02));
  EXPECT_FALSE(reason_of_failure(varying, 0.02));
  EXPECT_FALSE(reason_of_failure({}, 0.02));
}

}  // namespace
}  // namespace tilth
