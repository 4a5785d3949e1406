// The track of a run: where it was not what it should be, and the sentence that says so.
#pragma once

#include <string>
#include <vector>

#include <tilth/core/track_state.hpp>
#include <tilth/run/scan_table.hpp>

namespace tilth {

/// Scans in a row with one state and reason; without a scan, a gap between two.
struct TrackInterval {
  Track track;
  double from = 0.0, to = 0.0;  ///< [s] stamps of the first and the last of its poses
  std::size_t first = 0;        ///< number of its first row
  std::size_t scans = 0;
};

/// Of all rows, those that are simply tracked left out.
std::vector<TrackInterval> track_intervals(const ScanTable& table);

/// Of the last row.
TrackState track_at_end(const ScanTable& table);

/// Whether the track was lost in any row or gap, or only predicted in the last row: nobody knows whether it would have
/// been found again.
bool was_lost(const ScanTable& table);

/// Scans in a row that were lost, whatever the reasons, or a gap between two.
struct TrackLoss {
  double from = 0.0, to = 0.0;  ///< [s] stamps of the first and the last of its poses
  std::size_t scans = 0;
  std::vector<TrackReason> reasons;  ///< in the order in which they came up
};

std::vector<TrackLoss> track_losses(const ScanTable& table);

/// "the track was lost from 12.300 s to 13.100 s (9 scans: no scans for too long); ...", stamps as they are; and
/// whether it is known at the end. Empty where it never was lost.
std::string loss_sentence(const ScanTable& table);

}  // namespace tilth
