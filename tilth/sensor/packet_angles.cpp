#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sensor/packet_angles.hpp>

namespace tilth {
namespace {

constexpr double kLargestCorrection = 1.5 * std::numbers::pi / 180.0;
constexpr double kLeastElevation = 1e-9;  ///< [rad] a calibrated angle of 0 was never set

/// The told angles where they lie close to the table; how many do.
std::size_t correct(PacketFormat& format, const DeviceInfo& device) {
  std::vector<double> elevations = format.elevations;
  std::size_t corrected = 0;
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    const double told = device.elevations[i];
    if (std::abs(told) < kLeastElevation || std::abs(told - elevations[i]) > kLargestCorrection) continue;
    elevations[i] = told;
    ++corrected;
  }
  format = with_elevations(std::move(format), std::move(elevations));
  return corrected;
}

std::optional<UnitCalibration> told_calibration(const FirstPackets& first, const PacketFormat& format) {
  const bool robosense = format.family == PacketFamily::robosense || format.family == PacketFamily::robosense_helios;
  if (robosense && first.robosense) {
    const RobosenseDevice& device = *first.robosense;
    const auto& told = format.name == "robosense_rs16" ? device.of_rs16 : device.lasers;
    return told && told->lasers.size() == format.channels() ? told : std::nullopt;
  }
  if (format.family != PacketFamily::velodyne_64) return std::nullopt;
  std::vector<StatusByte> bytes;
  for (const DataPacket& packet : first.data) {
    if (&packet.layout() == &format.layout()) bytes.push_back(packet.status());
  }
  return hdl64_calibration(bytes);
}

[[noreturn]] void refuse_uncalibrated(const PacketFormat& format, const FirstPackets& first) {
  std::string told = "; name the unit's file (.csv of elevations and azimuths) by --sensor-file";
  if (format.family == PacketFamily::velodyne_64) {
    told = ": its packets tell them within " + std::to_string(kPacketsOfCalibration) + ", but not here, in " +
           std::to_string(first.data.size()) + "; name the unit's file (db.xml or .yaml) by --sensor-file";
  }
  if (format.family == PacketFamily::robosense || format.family == PacketFamily::robosense_helios)
    told =
        ": its device packets tell them (port 7788), but there are none here; record them too, or name the unit's "
        "file (.csv of elevations and azimuths) by --sensor-file";
  throw Error("sensor " + format.name, "has angles of its own, without which its points are wrong" + told);
}

}  // namespace

double distance_from(const PacketFormat& row, const DeviceInfo& device) {
  double sum = 0.0;
  for (std::size_t i = 0; i < device.elevations.size(); ++i) sum += std::abs(row.elevations[i] - device.elevations[i]);
  return sum / double(device.elevations.size());
}

bool tells_angles(const DeviceInfo& device) {
  return std::any_of(device.elevations.begin(), device.elevations.end(),
                     [](double angle) { return std::abs(angle) > kLeastElevation; });
}

std::string take_angles(PacketFormat& format, const FirstPackets& first, const SensorFile& file) {
  const std::string rings = "ring: of the channel, 0 the lowest of " + std::to_string(format.channels());
  const std::optional<UnitCalibration> unit = file.unit ? file.unit : told_calibration(first, format);
  if (unit) {
    format = calibrated(std::move(format), *unit);
    return rings + "; angles and offsets of the unit itself, from " + unit->origin;
  }
  if (format.needs_calibration) {
    refuse_uncalibrated(format, first);
  }
  const bool told = first.device && format.family == PacketFamily::leishen_1206 && tells_angles(*first.device);
  const std::size_t corrected = told ? correct(format, *first.device) : 0;
  if (corrected == 0) return rings + "; elevations of the maker's table";
  return rings + "; elevations of " + std::to_string(corrected) + " as calibrated, from the device packets";
}

}  // namespace tilth
