// What a run says of its track.
#include <run/sample_record.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/run/summary_json.hpp>
#include <tilth/run/track_record.hpp>

namespace tilth {
namespace {

TEST(TrackRecord, TellsWhereTheTrackWasLost) {
  EXPECT_FALSE(was_lost(sample_record().scans));
  EXPECT_EQ(loss_sentence(sample_record().scans), "");
  const ScanTable table = lost_record().scans;
  EXPECT_TRUE(was_lost(table));
  EXPECT_EQ(loss_sentence(table),
            "the track was lost from 1.000 s to 1.500 s (2 scans: the scan does not fit the map)");
  const nlohmann::json track = nlohmann::json::parse(summary_json(lost_record()))["track"];
  EXPECT_EQ(track["state"], "lost");
  EXPECT_EQ(track["intervals"].size(), 2U);
  EXPECT_EQ(track["intervals"][0]["state"], "coasting");
  EXPECT_EQ(track["intervals"][1]["from"], 1.0);
  EXPECT_EQ(track["intervals"][1]["scans"], 2);
}

TEST(TrackRecord, ALossOfSeveralReasonsIsOne) {
  ScanTable table = lost_record().scans;
  const std::size_t last = table.rows.size() - 1;
  table.rows[last - 1].track = {TrackState::lost, TrackReason::ambiguous};
  table.rows[last].track = {TrackState::lost, TrackReason::new_map};
  ASSERT_EQ(track_losses(table).size(), 1U);
  EXPECT_EQ(track_losses(table)[0].reasons, (std::vector{TrackReason::ambiguous, TrackReason::new_map}));
  EXPECT_NE(loss_sentence(table).find("(2 scans: several motions fit alike; registered to a map"), std::string::npos)
      << loss_sentence(table);
}

TEST(TrackRecord, AGapIsALossWithoutScans) {
  ScanTable table = sample_record().scans;
  table.rows[2].track = {TrackState::recovered, TrackReason::long_gap};
  EXPECT_TRUE(was_lost(table));
  EXPECT_EQ(track_at_end(table), TrackState::tracking);
  EXPECT_EQ(loss_sentence(table), "the track was lost from 0.500 s to 1.000 s (no scans for too long)");
}

TEST(TrackRecord, ARunThatEndsOnPredictionAloneSaysSo) {
  ScanTable table = sample_record().scans;
  table.rows.back().track = {TrackState::coasting, TrackReason::jump};
  EXPECT_TRUE(was_lost(table));
  EXPECT_TRUE(track_losses(table).empty());
  EXPECT_NE(loss_sentence(table).find("the track is not known at the end (1 scan since "), std::string::npos)
      << loss_sentence(table);
  table.rows.front().track = {TrackState::lost, TrackReason::poor_fit};
  EXPECT_NE(loss_sentence(table).find("); the track is not known at the end"), std::string::npos);
}

}  // namespace
}  // namespace tilth
