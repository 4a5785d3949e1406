// Recorded packets of one sensor as scans: network captures, files of bare payloads, packet messages of bags. The
// sensor is recognised from the first two thousand packets (2 MB); after that one packet and one scan are in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tilth/sensor/packet_decoder.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

struct ReceivedPacket {
  std::optional<double> arrival;  ///< [s] since 1970
  std::uint32_t sender = 0;       ///< IPv4 address; 0 where nobody wrote it down
  std::vector<std::byte> payload;
};

/// Where packets come from. What it captures it owns.
struct PacketFeed {
  std::string name;                                     ///< of the file, or the topic in it
  std::vector<std::string> contents;                    ///< of the file, see ScanSource::contents()
  std::function<std::optional<ReceivedPacket>()> next;  ///< nothing at the end
  std::function<std::vector<std::string>()> notices;    ///< of the format, see ScanSource::notices()
  std::function<std::string()> problem;                 ///< what is damaged; empty: nothing
  std::filesystem::path file = {};                      ///< beside which the sensor's own file may stand; empty: none
};

struct PacketSourceOptions {
  PacketOptions decoder;
  std::string sensor_file, host;
};

template <class V>
void visit(PacketSourceOptions& o, V&& v) {
  visit(o.decoder, v);
  v("sensor_file", o.sensor_file,
    "[-] file of the unit: Ouster's metadata (.json), a Velodyne's db.xml or .yaml, another's .csv of angles");
  v("host", o.host, "[-] address of the sensor, as 192.168.1.200; empty: of the one that sends most");
}

/// Throws Error where no packet is a known sensor's.
std::unique_ptr<ScanSource> open_packets(PacketFeed feed, const PacketSourceOptions& options);

}  // namespace tilth
