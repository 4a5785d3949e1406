#include <tilth/sensor/clock_convention.hpp>
#include <tilth/sensor/first_packets.hpp>

namespace tilth {

FirstPackets sorted_packets(std::span<const Packet> first) {
  FirstPackets all;
  for (const Packet& packet : first) {
    const PacketKind kind = kind_of(packet.payload);
    const std::size_t before = all.data.empty() ? 0 : all.data.size() - 1;
    if (kind == PacketKind::data) all.data.emplace_back(packet.payload);
    const bool of_robosense = packet.payload.size() == layout_of(PacketFamily::robosense).size;
    if (kind == PacketKind::device && of_robosense) all.robosense = parse_robosense_device(packet.payload);
    if (kind == PacketKind::device && !of_robosense) {
      all.device = parse_device_packet(packet.payload);
      if (all.device->utc && *all.device->utc > kEarliestClock) all.mark = {before, *all.device->utc + 0.5};
    }
    if (kind == PacketKind::position) {
      if (const auto utc = parse_position_packet(packet.payload).utc) all.mark = {before, *utc + 0.5};
    }
  }
  return all;
}

}  // namespace tilth
