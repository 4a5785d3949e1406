// Times from a list beside the files (times.txt), which may be in another unit, longer or shorter than the files, or
// too coarse to tell scans apart. Pure. O(n).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilth {

struct ListedTimes {
  std::vector<double> times;  ///< [s] one a file
  std::string decision;       ///< ", in nanoseconds; ...": how the list was understood; empty: as it stands
};

/// The times of the files with `names` (without extension), in their order, out of `list`, the file `where`. Longer
/// lists are matched by the counters in the names; where a few times are missing at the end, they are continued. `rate`
/// [Hz]: the scans', 0: not known. Nothing where the list tells no times. Throws Error where it is shorter than that,
/// and where most of its times are earlier than the one before.
std::optional<ListedTimes> listed_times(const std::vector<double>& list, std::span<const std::string> names,
                                        const std::string& where, double rate);

}  // namespace tilth
