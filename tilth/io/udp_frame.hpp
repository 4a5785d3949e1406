// The IPv4 packet in a captured frame and the datagram in it. Lengths are believed only as far as there are bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tilth::pcap {

enum class Link : std::uint8_t { ethernet, linux_cooked, linux_cooked_2, raw_ip, loopback, unknown };

struct Ipv4Packet {
  std::uint32_t source = 0, destination = 0;
  std::uint16_t id = 0;
  std::size_t offset = 0;  ///< [bytes] of this fragment in the datagram
  bool more_fragments = false;
  std::span<const std::byte> payload;  ///< UDP header and what follows, or a part of that

  bool is_fragment() const { return more_fragments || offset > 0; }
};

enum class FrameKind : std::uint8_t { udp, other, cut };

struct Frame {
  FrameKind kind = FrameKind::other;
  Ipv4Packet packet;  ///< where `kind` is udp
};

/// Looks into `bytes`, which the result points to.
Frame parse_frame(Link link, std::span<const std::byte> bytes);

struct UdpPart {
  std::uint16_t source_port = 0, destination_port = 0;
  std::span<const std::byte> payload;
};

/// Header and payload of a whole datagram; nothing where it is cut.
std::optional<UdpPart> parse_udp(std::span<const std::byte> bytes);

}  // namespace tilth::pcap
