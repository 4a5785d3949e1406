// Which clock the stamps of a recording are taken from: their own, the recorder's where their own does not tell scans
// apart (it stands still, or counts whole seconds), or none, where both do not. O(1), over the first scans only.
#pragma once

#include <span>
#include <string>

#include <tilth/sensor/scan_pace.hpp>

namespace tilth {

enum class StampOrigin {
  own,       ///< as recorded
  recorder,  ///< when the recorder had the scans: soon after their last points
  order,     ///< one after the other, at a nominal rate
};

struct StampOriginDecision {
  StampOrigin origin = StampOrigin::own;
  std::string sentence;  ///< empty: as recorded
};

/// From at least one reading.
StampOriginDecision decide_stamp_origin(std::span<const StampReading> first);

}  // namespace tilth
