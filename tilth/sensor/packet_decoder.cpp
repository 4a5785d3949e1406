#include <algorithm>
#include <array>

#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>
#include <tilth/sensor/ouster_decoder.hpp>
#include <tilth/sensor/packet_decoder.hpp>

namespace tilth {
namespace {

constexpr std::array<std::string_view, 3> kEchoes{"both", "strongest", "farthest"};

}  // namespace

std::span<const std::string_view> names_of(Echoes) {
  return kEchoes;
}

EchoChoice choose_echoes(Echoes wanted, const MeasuredEcho& first, const MeasuredEcho& second) {
  const bool differ = first.range != 0 && second.range != 0 && first.range != second.range;
  const bool second_wins = wanted == Echoes::farthest ? second.range > first.range : second.intensity > first.intensity;
  const bool all = !differ || wanted == Echoes::both;
  return {first.range != 0 && (all || !second_wins),
          second.range != 0 && second.range != first.range && (all || second_wins)};
}

std::unique_ptr<PacketDecoder> make_packet_decoder(std::span<const Packet> first, const PacketOptions& options,
                                                   const SensorFile& file) {
  const auto is_ouster = [](const Packet& packet) { return kind_of(packet.payload) == PacketKind::ouster; };
  if (std::none_of(first.begin(), first.end(), is_ouster)) return std::make_unique<BlockDecoder>(first, options, file);
  if (!std::string_view("ouster").starts_with(options.sensor))
    throw Error("sensor " + options.sensor, "sends no such packets: they are an Ouster's");
  if (!file.ouster) {
    throw Error(file.name.empty() ? "packets of an Ouster sensor" : file.name,
                "mean nothing without the sensor's metadata: put its .json beside the recording, with the same name or "
                "as the only one there, or name it by --sensor-file (`ouster-cli source SENSOR metadata` writes it)");
  }
  return std::make_unique<OusterDecoder>(first, options, file);
}

}  // namespace tilth
