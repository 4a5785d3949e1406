#include <tilth/io/udp_frame.hpp>

namespace tilth::pcap {
namespace {

constexpr std::uint16_t kIpv4 = 0x0800, kVlan = 0x8100, kServiceVlan = 0x88A8, kOldServiceVlan = 0x9100;
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kIpHeader = 20, kUdpHeader = 8;

std::uint16_t u16(std::span<const std::byte> bytes, std::size_t at) {
  return std::uint16_t(std::to_integer<unsigned>(bytes[at]) << 8 | std::to_integer<unsigned>(bytes[at + 1]));
}

std::uint32_t u32(std::span<const std::byte> bytes, std::size_t at) {
  return std::uint32_t(u16(bytes, at)) << 16 | u16(bytes, at + 2);
}

std::uint8_t u8(std::span<const std::byte> bytes, std::size_t at) {
  return std::to_integer<std::uint8_t>(bytes[at]);
}

/// Where the IPv4 packet begins; nothing where there is none.
std::optional<std::size_t> ip_begin(Link link, std::span<const std::byte> bytes) {
  struct Header {
    std::size_t size, type_at;
  };
  Header header{14, 12};
  if (link == Link::raw_ip) return 0;
  if (link == Link::loopback) return 4;  // the version in the packet tells more than the family before it
  if (link == Link::linux_cooked) header = {16, 14};
  if (link == Link::linux_cooked_2) header = {20, 0};
  if (bytes.size() < header.size) return std::nullopt;
  std::uint16_t type = u16(bytes, header.type_at);
  while (type == kVlan || type == kServiceVlan || type == kOldServiceVlan) {
    if (bytes.size() < header.size + 4) return std::nullopt;
    type = u16(bytes, header.size + 2);
    header.size += 4;
  }
  return type == kIpv4 ? std::optional(header.size) : std::nullopt;
}

}  // namespace

Frame parse_frame(Link link, std::span<const std::byte> bytes) {
  const std::optional<std::size_t> begin = ip_begin(link, bytes);
  if (!begin) return {FrameKind::other, {}};
  if (bytes.size() < *begin + kIpHeader) return {FrameKind::cut, {}};
  const std::span<const std::byte> ip = bytes.subspan(*begin);
  if (u8(ip, 0) >> 4 != 4 || u8(ip, 9) != kUdp) return {FrameKind::other, {}};
  const std::size_t header = std::size_t(u8(ip, 0) & 0x0F) * 4;
  const std::size_t declared = u16(ip, 2);
  const std::size_t length = declared == 0 ? ip.size() : declared;  // 0 where the network card cuts packets
  if (header < kIpHeader || length < header || length > ip.size()) return {FrameKind::cut, {}};
  const std::uint16_t fragment = u16(ip, 6);
  Ipv4Packet packet;
  packet.source = u32(ip, 12), packet.destination = u32(ip, 16), packet.id = u16(ip, 4);
  packet.offset = std::size_t(fragment & 0x1FFF) * 8;
  packet.more_fragments = (fragment & 0x2000) != 0;
  packet.payload = ip.subspan(header, length - header);
  return {FrameKind::udp, packet};
}

std::optional<UdpPart> parse_udp(std::span<const std::byte> bytes) {
  if (bytes.size() < kUdpHeader) return std::nullopt;
  const std::size_t length = u16(bytes, 4);
  if (length < kUdpHeader || length > bytes.size()) return std::nullopt;
  return UdpPart{u16(bytes, 0), u16(bytes, 2), bytes.subspan(kUdpHeader, length - kUdpHeader)};
}

}  // namespace tilth::pcap
