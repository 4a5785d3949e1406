// How long the head takes for one turn, measured from the stamps of consecutive scans and the angle it turned between
// them.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <tilth/sensor/firing_order.hpp>

namespace tilth {

struct SpinDecision {
  std::optional<double> period;  ///< [s] of one turn; none: nothing tells it, point times cannot be derived
  std::optional<double>
      cut;  ///< [rad] azimuth where every scan begins and its stamp stands, if they all begin at the same
  std::string sentence;
};

/// What else tells how long a turn takes.
struct SpinHints {
  std::optional<double> column_step = {};  ///< [rad] between two points of a beam
  std::optional<double> about = {};        ///< [s] as other scans of the recording tell
};

/// `rotations[k]` is the rotation of the scan stamped `stamps[k]` [s]; consecutive scans, at least one. Stamps are
/// nominal where nobody recorded them.
SpinDecision measure_spin(std::span<const HeadRotation> rotations, std::span<const double> stamps, bool nominal_stamps,
                          const SpinHints& hints);

/// [s] from the stamp to the first point: more than 0 where the first returns after a fixed cut are missing.
double delay_of_first(const HeadRotation& rotation, double cut, double period);

}  // namespace tilth
