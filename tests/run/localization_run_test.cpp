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
    return localize(scans, localizer, {options, 0}, nobody, record);
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

}  // namespace
}  // namespace tilth
