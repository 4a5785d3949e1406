#include <cmath>
#include <string>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/pcap_writer.hpp>

namespace tilth {
namespace {

constexpr std::size_t kUdp = 8, kIp = 20, kEthernet = 14;
constexpr std::size_t kMostPayload = 65535 - kUdp - kIp - kEthernet;  // fragments are captured put together

using Bytes = std::vector<std::byte>;

template <class T>
void put_little(Bytes& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(std::byte(std::uint64_t(value) >> 8 * i & 0xFF));
}

template <class T>
void put_big(Bytes& bytes, T value) {
  for (std::size_t i = sizeof(T); i-- > 0;) bytes.push_back(std::byte(std::uint64_t(value) >> 8 * i & 0xFF));
}

/// The Internet checksum (RFC 1071) of a header.
std::uint16_t checksum(std::span<const std::byte> header) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i + 1 < header.size(); i += 2)
    sum += std::to_integer<std::uint32_t>(header[i]) << 8 | std::to_integer<std::uint32_t>(header[i + 1]);
  while (sum >> 16 != 0) sum = (sum & 0xFFFF) + (sum >> 16);
  return std::uint16_t(~sum);
}

Bytes ip_header(const UdpRoute& route, std::uint16_t id, std::size_t payload) {
  Bytes header;
  put_big(header, std::uint16_t(0x4500));
  put_big(header, std::uint16_t(kIp + kUdp + payload));
  put_big(header, id);
  put_big(header, std::uint16_t(0x4000));  // not to be fragmented
  put_big(header, std::uint16_t(0xFF11));  // time to live, UDP
  put_big(header, std::uint16_t(0));
  put_big(header, route.source);
  put_big(header, route.destination);
  const std::uint16_t sum = checksum(header);
  header[10] = std::byte(sum >> 8), header[11] = std::byte(sum & 0xFF);
  return header;
}

}  // namespace

PcapWriter::PcapWriter(const std::filesystem::path& path) : file_(path) {
  Bytes header;
  put_little(header, std::uint32_t(0xA1B2C3D4));
  put_little(header, std::uint16_t(2));
  put_little(header, std::uint16_t(4));
  put_little(header, std::uint64_t(0));
  put_little(header, std::uint32_t(65535));
  put_little(header, std::uint32_t(1));
  file_.write(header);
}

void PcapWriter::write(double arrival, const UdpRoute& route, std::span<const std::byte> payload) {
  if (payload.size() > kMostPayload)
    throw Error("payload", "of " + std::to_string(payload.size()) + " bytes does not fit into a frame");
  if (!(arrival >= 0.0 && arrival < 4294967295.0))
    throw Error("arrival", "cannot be written: it must lie in 0 .. 2^32 s");
  const double whole = std::floor(arrival);
  const auto us = std::uint32_t(std::llround((arrival - whole) * 1e6));
  const auto frame = std::uint32_t(kEthernet + kIp + kUdp + payload.size());
  Bytes bytes;
  put_little(bytes, std::uint32_t(whole) + us / 1'000'000);
  put_little(bytes, us % 1'000'000);
  put_little(bytes, frame);
  put_little(bytes, frame);
  bytes.insert(bytes.end(), 6, std::byte(0xFF));
  put_big(bytes, std::uint16_t(0x0200));  // an address of no maker
  put_big(bytes, route.source);
  put_big(bytes, std::uint16_t(0x0800));
  const Bytes header = ip_header(route, id_++, payload.size());
  bytes.insert(bytes.end(), header.begin(), header.end());
  put_big(bytes, route.source_port);
  put_big(bytes, route.destination_port);
  put_big(bytes, std::uint16_t(kUdp + payload.size()));
  put_big(bytes, std::uint16_t(0));  // no checksum, which UDP allows
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  file_.write(bytes);
}

}  // namespace tilth
