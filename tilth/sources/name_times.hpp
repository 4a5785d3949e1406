// Times of scans in the names of their files, as recorders and dataset tools write them. Pure. O(n log n).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilth {

struct NameTimes {
  std::vector<double> times;  ///< [s] one a name
  std::string decision;       ///< "stamps: from the names of the files, ..."
};

/// Of file names without their extensions, where every one is a time: seconds with decimals ("12.5", "1700000000.25"),
/// seconds and nano-, micro- or milliseconds with or without leading zeros ("12.43700000", "1700000000_43700000"), or
/// integers of nano-, micro- or milliseconds. Before a time since 1970 other words may stand. Counters ("000123") are
/// no times.
std::optional<NameTimes> times_in_names(std::span<const std::string> names);

/// The counters in names that end in one ("000123", "scan_7"), where all do.
std::optional<std::vector<std::size_t>> counters_in_names(std::span<const std::string> names);

}  // namespace tilth
