// All scans that a decoder makes of packets.
#pragma once

#include <utility>
#include <vector>

#include <tilth/sensor/packet_decoder.hpp>

namespace tilth {

inline std::vector<Scan> scans_of(PacketDecoder& decoder, const std::vector<Packet>& packets, PacketCounts* counts) {
  std::vector<Scan> scans;
  for (const Packet& packet : packets) {
    if (auto scan = decoder.decode(packet)) scans.push_back(std::move(*scan));
  }
  if (auto scan = decoder.finish()) scans.push_back(std::move(*scan));
  if (counts != nullptr) *counts = decoder.counts();
  return scans;
}

}  // namespace tilth
