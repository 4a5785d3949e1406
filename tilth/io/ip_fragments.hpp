// Datagrams put together from their fragments, which may come in any order. At most 16 are open at a time (1 MB): the
// oldest gives way.
#pragma once

#include <cstddef>
#include <list>
#include <optional>
#include <vector>

#include <tilth/io/udp_frame.hpp>

namespace tilth::pcap {

class IpFragments {
 public:
  /// The whole datagram (UDP header and payload), where this is the fragment that completes it.
  std::optional<std::vector<std::byte>> add(const Ipv4Packet& fragment);

 private:
  struct Datagram {
    std::uint32_t source = 0, destination = 0;
    std::uint16_t id = 0;
    std::vector<std::byte> bytes;
    std::vector<bool> there;          // of every 8 bytes
    std::optional<std::size_t> size;  // once the last fragment came
  };
  std::list<Datagram>::iterator find(const Ipv4Packet& fragment);

  std::list<Datagram> open_;  // oldest first
};

}  // namespace tilth::pcap
