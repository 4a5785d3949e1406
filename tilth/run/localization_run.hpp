// A recording localised in a saved map: scan after scan into a record, whose trajectory has the scans that were
// located.
#pragma once

#include <memory>
#include <span>

#include <tilth/localization/localizer.hpp>
#include <tilth/run/run_observer.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/session.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

struct LocalizationRunOptions {
  SessionOptions session;
  std::size_t restart_every = 0;    ///< [scans] after which all is forgotten, and found anew; 0: never
  bool restart_when_found = false;  ///< the same after every scan whose place is known
  std::span<const std::unique_ptr<Sink>> sinks = {};  ///< take every scan, whether its place is known or not
};

/// Localises what `source` has. `record.localization` tells of every scan, all else in `record` of those whose pose is
/// known; it says what is run (new_record) and gets no map. Throws Error where a sink refuses a scan.
RunEnd localize(ScanSource& source, Localizer& localizer, const LocalizationRunOptions& options, RunObserver& observer,
                RunRecord& record);

/// Puts the patches of a saved map into the map of a record.
void show_map(const PlaceMap& map, RunRecord& record);

}  // namespace tilth
