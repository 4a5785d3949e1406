// A scan as the packets that an Ouster sensor would send: the inverse of ouster_decoder, for simulated recordings.
#pragma once

#include <cstdint>
#include <vector>

#include <tilth/core/lidar_model.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/sensor/encoded_packet.hpp>
#include <tilth/sensor/ouster_metadata.hpp>

namespace tilth {

/// Whether packets of an Ouster hold the scans of `lidar`: all its beams fire at once, 512, 1024 or 2048 times a turn.
bool sends_as_ouster(const LidarModel& lidar);

/// What a sensor with those beams would say of itself.
OusterMetadata ouster_metadata_of(const LidarModel& lidar, OusterProfile profile);

/// The packets of one turn, the number `frame`. The second echo of two is empty. Throws Error where a point has no
/// ring, no time or the time of no column.
std::vector<EncodedPacket> encode_ouster_scan(const Scan& scan, const LidarModel& lidar, const OusterMetadata& metadata,
                                              std::uint16_t frame);

}  // namespace tilth
