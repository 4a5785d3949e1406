// Simulated scans as a network capture of the packets their sensor sends, with Leishen's device packets once a second,
// and beside it the JSON that an Ouster's packets need.
#pragma once

#include <filesystem>

#include <tilth/io/pcap_writer.hpp>
#include <tilth/sensor/packet_encoder.hpp>

namespace tilth::app {

class PacketRecording {
 public:
  /// Throws Error where `lidar` has no packets.
  PacketRecording(const std::filesystem::path& path, const LidarModel& lidar);

  void write(const Scan& scan);
  void close() { file_.close(); }

 private:
  LidarModel lidar_;
  PacketStream stream_;
  PcapWriter file_;
};

}  // namespace tilth::app
