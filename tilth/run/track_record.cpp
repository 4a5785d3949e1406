#include <algorithm>
#include <cstdio>

#include <tilth/run/track_record.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostLosses = 5;  // in a sentence

bool same(const Track& a, const Track& b) {
  return a.state == b.state && a.reason == b.reason;
}

/// Whether nothing was seen for long before this scan, which was found again.
bool ends_gap(const Track& track) {
  return track.state == TrackState::recovered && track.reason == TrackReason::long_gap;
}

std::string words(const TrackInterval& loss) {
  char text[96];
  std::snprintf(text, sizeof text, "from %.3f s to %.3f s (", loss.from, loss.to);
  const std::string scans =
      loss.scans == 0 ? "" : std::to_string(loss.scans) + (loss.scans == 1 ? " scan: " : " scans: ");
  return text + scans + std::string(names_of(loss.track.reason)[std::size_t(loss.track.reason)]) + ")";
}

}  // namespace

std::vector<TrackInterval> track_intervals(const ScanTable& table) {
  std::vector<TrackInterval> intervals;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ScanRow& row = table.rows[i];
    if (row.track.state == TrackState::tracking) continue;
    if (ends_gap(row.track) && i > 0) {
      const Track gap{TrackState::lost, row.track.reason};
      intervals.push_back({gap, table.rows[i - 1].stamp, row.stamp, i, 0});
    }
    const bool goes_on = !intervals.empty() && same(intervals.back().track, row.track) &&
                         intervals.back().first + intervals.back().scans == i;
    if (!goes_on) intervals.push_back({row.track, row.stamp, row.stamp, i, 0});
    intervals.back().to = row.stamp;
    ++intervals.back().scans;
  }
  return intervals;
}

TrackState track_at_end(const ScanTable& table) {
  return table.rows.empty() ? TrackState::tracking : table.rows.back().track.state;
}

bool was_lost(const ScanTable& table) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [](const ScanRow& row) { return row.track.state == TrackState::lost || ends_gap(row.track); });
}

std::string loss_sentence(const ScanTable& table) {
  std::string sentence;
  std::size_t losses = 0;
  for (const TrackInterval& interval : track_intervals(table)) {
    if (interval.track.state != TrackState::lost || ++losses > kMostLosses) continue;
    sentence += (sentence.empty() ? "the track was lost " : ", ") + words(interval);
  }
  if (losses > kMostLosses) sentence += " and " + std::to_string(losses - kMostLosses) + " times more";
  return sentence;
}

}  // namespace tilth
