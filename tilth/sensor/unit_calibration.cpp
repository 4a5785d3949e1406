#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sensor/unit_calibration.hpp>

namespace tilth {
namespace {

constexpr double kLargestDifference = 5.0 * std::numbers::pi / 180.0;

}  // namespace

PacketFormat calibrated(PacketFormat format, const UnitCalibration& unit) {
  if (unit.lasers.size() != format.channels()) {
    throw Error(unit.origin, "tells of " + std::to_string(unit.lasers.size()) + " lasers, but a " + format.title +
                                 " has " + std::to_string(format.channels()));
  }
  std::vector<double> elevations;
  std::vector<LaserOffsets> offsets;
  for (std::size_t i = 0; i < unit.lasers.size(); ++i) {
    const double elevation = unit.lasers[i].elevation;
    if (!format.needs_calibration && std::abs(elevation - format.elevations[i]) > kLargestDifference)
      throw Error(unit.origin, "is of another sensor: laser " + std::to_string(i) + " of a " + format.title +
                                   " points elsewhere by more than 5 degrees");
    elevations.push_back(elevation);
    offsets.push_back(unit.lasers[i].offsets);
  }
  format.offsets = std::move(offsets);
  format.needs_calibration = false;
  return with_elevations(std::move(format), std::move(elevations));
}

}  // namespace tilth
