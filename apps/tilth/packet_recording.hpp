// Simulated scans as a network capture of the packets their sensor sends, with Leishen's device packets once a second.
#pragma once

#include <filesystem>

#include <tilth/io/pcap_writer.hpp>
#include <tilth/sensor/packet_encoder.hpp>

namespace tilth::app {

class PacketRecording {
 public:
  /// Throws Error where `lidar` has no packets.
  PacketRecording(const std::filesystem::path& path, const LidarModel& lidar) : stream_(lidar), file_(path) {}

  void write(const Scan& scan);
  void close() { file_.close(); }

 private:
  PacketStream stream_;
  PcapWriter file_;
};

}  // namespace tilth::app
