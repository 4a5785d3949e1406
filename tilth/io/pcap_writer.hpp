// Datagrams written as a pcap file (microseconds, Ethernet, IPv4), as a sensor's network card would have sent them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include <tilth/io/output_file.hpp>

namespace tilth {

struct UdpRoute {
  std::uint32_t source = 0, destination = 0;  ///< IPv4 addresses, the first number in the highest byte
  std::uint16_t source_port = 0, destination_port = 0;
};

class PcapWriter {
 public:
  explicit PcapWriter(const std::filesystem::path& path);

  /// `arrival` [s] since 1970; `payload` at most 65493 bytes: fragments are captured put together.
  void write(double arrival, const UdpRoute& route, std::span<const std::byte> payload);
  void close() { file_.close(); }

 private:
  OutputFile file_;
  std::uint16_t id_ = 0;
};

}  // namespace tilth
