// UDP datagrams of a captured network, pcap or pcapng (by libpcap): Ethernet with VLAN tags, Linux cooked, raw IP,
// loopback; IPv4, fragments put together. Everything else in the file is counted and passed over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilth {

struct Datagram {
  double arrival = 0.0;      ///< [s] since 1970
  std::uint32_t source = 0;  ///< IPv4 address, its first number in the highest byte
  std::uint16_t source_port = 0, destination_port = 0;
  std::vector<std::byte> payload;
};

std::string address_text(std::uint32_t address);  ///< "192.168.1.200"

struct PcapCounts {
  std::size_t frames = 0, datagrams = 0;
  std::size_t other = 0;      ///< frames that are no UDP over IPv4
  std::size_t cut = 0;        ///< frames captured in part, or whose lengths lie
  std::size_t fragments = 0;  ///< frames of datagrams that need others: put together where all came
};

class PcapReader {
 public:
  /// Throws Error where the file cannot be read, is no capture or of an unknown link.
  explicit PcapReader(const std::filesystem::path& path);
  PcapReader(std::span<const std::byte> memory, const std::string& name);  ///< `memory` must outlive this
  ~PcapReader();
  PcapReader(PcapReader&&) noexcept;

  /// The next datagram; nothing at the end, or where the file breaks off: see problem().
  std::optional<Datagram> next();

  const PcapCounts& counts() const;
  const std::string& problem() const;  ///< where and why reading ended early; empty: it did not

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tilth
