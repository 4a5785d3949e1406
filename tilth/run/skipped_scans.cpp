#include <utility>

#include <tilth/run/skipped_scans.hpp>

namespace tilth {

void keep_skipped(SkippedScan skipped, RunObserver& observer, RunRecord& record) {
  constexpr std::size_t kMostWarnings = 10;
  if (record.skipped.size() < kMostWarnings) observer.warn("skipped: " + skipped.where + ": " + skipped.what);
  if (record.skipped.size() == kMostWarnings) observer.warn("more was skipped; all of it stands in summary.json");
  record.skipped.push_back(std::move(skipped));
}

}  // namespace tilth
