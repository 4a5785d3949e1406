// The angles of the lasers of the one unit that sent the packets: of its file, of the packets, else of the maker's
// table.
#pragma once

#include <string>

#include <tilth/sensor/first_packets.hpp>
#include <tilth/sensor/sensor_file.hpp>

namespace tilth {

/// Whether the device packets tell angles, and their mean distance [rad] from those of `format`.
bool tells_angles(const DeviceInfo& device);
double distance_from(const PacketFormat& format, const DeviceInfo& device);

/// Puts the unit's own angles into `format`; one sentence about where they are from. Throws Error where `file` is of
/// another sensor, or the sensor means nothing without a file that is not there.
std::string take_angles(PacketFormat& format, const FirstPackets& first, const SensorFile& file);

}  // namespace tilth
