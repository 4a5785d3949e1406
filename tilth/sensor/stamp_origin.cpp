#include <algorithm>
#include <cmath>

#include <tilth/sensor/stamp_origin.hpp>

namespace tilth {
namespace {

constexpr double kStanding = 1.0 / 3.0;  ///< of the steps are 0: the stamps do not tell scans apart
constexpr double kFalling = 0.5;         ///< of the steps lead back: the stamps are of another order

/// Steps from one scan to the next, twins left out.
struct Steps {
  std::size_t all = 0, standing = 0, falling = 0, recorded = 0;  ///< recorded: the recorder's time went on
};

Steps steps_between(std::span<const StampReading> scans) {
  Steps steps;
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const StampReading &a = scans[k - 1], &b = scans[k];
    const bool standing = a.stamp == b.stamp || !std::isfinite(b.stamp);
    if (are_twins(a, b)) continue;
    ++steps.all;
    steps.standing += standing ? 1 : 0;
    steps.falling += b.stamp < a.stamp ? 1 : 0;
    steps.recorded += a.arrival && b.arrival && *b.arrival > *a.arrival ? 1 : 0;
  }
  return steps;
}

bool whole_seconds(std::span<const StampReading> scans) {
  return std::all_of(scans.begin(), scans.end(), [](const StampReading& r) { return r.stamp == std::round(r.stamp); });
}

}  // namespace

StampOriginDecision decide_stamp_origin(std::span<const StampReading> first) {
  const Steps steps = steps_between(first);
  const bool never_set = std::all_of(first.begin(), first.end(), [](const StampReading& r) { return r.stamp == 0.0; });
  const bool lone = steps.all == 0 && never_set && first.front().arrival;
  const bool standing = steps.standing >= 2 && double(steps.standing) >= kStanding * double(steps.all);
  const bool falling = steps.falling >= 2 && double(steps.falling) > kFalling * double(steps.all);
  if (!lone && !standing && !falling) return {};
  const std::string fault = never_set              ? "were never set"
                            : falling              ? "run backwards"
                            : whole_seconds(first) ? "are whole seconds"
                                                   : "stand still between scans";
  if (lone || 2 * steps.recorded > steps.all) {
    return {StampOrigin::recorder,
            "stamps: of the recorder, because those of the scans " + fault + "; it had each scan after its last point"};
  }
  return {StampOrigin::order, "stamps: ASSUMED from the order of the scans at 10 Hz, because they " + fault +
                                  " and no recorder's times tell more"};
}

}  // namespace tilth
