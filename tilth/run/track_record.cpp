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

std::string counted_scans(std::size_t scans) {
  return std::to_string(scans) + (scans == 1 ? " scan" : " scans");
}

std::string words(const TrackLoss& loss) {
  char text[96];
  std::snprintf(text, sizeof text, "from %.3f s to %.3f s (", loss.from, loss.to);
  std::string sentence = text;
  if (loss.scans > 0) sentence += counted_scans(loss.scans) + ": ";
  for (std::size_t i = 0; i < loss.reasons.size(); ++i)
    sentence.append(i == 0 ? "" : "; ").append(names_of(TrackReason{})[std::size_t(loss.reasons[i])]);
  return sentence + ")";
}

std::string words_of_end(const TrackInterval& coasting) {
  char since[32];
  std::snprintf(since, sizeof since, "%.3f", coasting.from);
  return "the track is not known at the end (" + counted_scans(coasting.scans) + " since " + since +
         " s: " + std::string(names_of(TrackReason{})[std::size_t(coasting.track.reason)]) + ")";
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
  if (track_at_end(table) == TrackState::coasting) return true;
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [](const ScanRow& row) { return row.track.state == TrackState::lost || ends_gap(row.track); });
}

std::vector<TrackLoss> track_losses(const ScanTable& table) {
  std::vector<TrackLoss> losses;
  std::size_t next = 0;  // row after the last loss
  for (const TrackInterval& interval : track_intervals(table)) {
    if (interval.track.state != TrackState::lost) continue;
    const bool goes_on = !losses.empty() && interval.first == next && interval.scans > 0 && losses.back().scans > 0;
    if (!goes_on) losses.emplace_back().from = interval.from;
    TrackLoss& loss = losses.back();
    loss.to = interval.to;
    loss.scans += interval.scans;
    if (std::find(loss.reasons.begin(), loss.reasons.end(), interval.track.reason) == loss.reasons.end())
      loss.reasons.push_back(interval.track.reason);
    next = interval.first + interval.scans;
  }
  return losses;
}

std::string loss_sentence(const ScanTable& table) {
  const std::vector<TrackLoss> losses = track_losses(table);
  std::string sentence;
  for (std::size_t i = 0; i < std::min(losses.size(), kMostLosses); ++i)
    sentence += (i == 0 ? "the track was lost " : ", ") + words(losses[i]);
  if (losses.size() > kMostLosses) sentence += " and " + std::to_string(losses.size() - kMostLosses) + " times more";
  if (track_at_end(table) == TrackState::coasting)
    sentence += (sentence.empty() ? "" : "; ") + words_of_end(track_intervals(table).back());
  return sentence;
}

}  // namespace tilth
