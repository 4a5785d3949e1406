#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/core/median.hpp>
#include <tilth/sensor/first_packets.hpp>
#include <tilth/sensor/packet_angles.hpp>
#include <tilth/sensor/recognise_packets.hpp>

namespace tilth {
namespace {

using Rows = std::vector<const PacketFormat*>;

/// The rows for which `fits` holds; all where there is none.
template <class F>
Rows narrowed(const Rows& rows, const F& fits) {
  Rows left;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(left), fits);
  return left.empty() ? rows : left;
}

std::string hexadecimal(std::uint8_t value) {
  char text[8];
  std::snprintf(text, sizeof text, "0x%02X", value);
  return text;
}

/// Rows that the name, the length and the model byte allow.
Rows possible_rows(const FirstPackets& first, std::string_view sensor) {
  const DataPacket& packet = first.data.front();
  Rows rows;
  std::string names;
  for (const PacketFormat& row : packet_formats()) {
    names += (names.empty() ? "" : ", ") + row.name;
    if (row.name.starts_with(sensor)) rows.push_back(&row);
  }
  const std::string where = sensor.empty() ? "packets" : "sensor " + std::string(sensor);
  if (rows.empty()) throw Error(where, "is not known for packets; there are " + names);
  std::erase_if(rows, [&](const PacketFormat* row) { return &row->layout() != &packet.layout(); });
  const std::string size = std::to_string(packet.size()) + " bytes";
  if (rows.empty()) throw Error(where, "has no packets of " + size + " as they are here");
  if (packet.layout().model == 0) return rows;
  const Rows told = [&] {
    Rows left;
    for (const PacketFormat* row : rows) {
      if (std::count(row->models.begin(), row->models.end(), packet.model()) > 0) left.push_back(row);
    }
    return left;
  }();
  if (!told.empty()) return told;
  if (!sensor.empty()) return rows;
  std::erase_if(rows, [&](const PacketFormat* row) { return !first.device || !row->models.empty(); });
  if (!rows.empty()) return rows;  // an old Leishen, as its device packets tell
  throw Error(where, "of " + size + " with model byte " + hexadecimal(packet.model()) +
                         " are of no sensor known; name one by --sensor: " + names);
}

/// [s] from packet to packet by the sensor's clock, the median; 0 where it does not tell.
double clock_step(std::span<const DataPacket> data) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < data.size(); ++i) {
    const bool short_ones = !data[i].dated() && !data[i - 1].dated();
    if (short_ones && data[i].microseconds() > data[i - 1].microseconds())
      steps.push_back((data[i].microseconds() - data[i - 1].microseconds()) * 1e-6);
  }
  return steps.empty() ? 0.0 : median(std::move(steps));
}

const PacketFormat& most_likely(Rows rows, const FirstPackets& first) {
  const bool dual = first.data.front().dual();
  if (const double step = clock_step(first.data); step > 0.0) {
    const auto off = [&](const PacketFormat* row) { return std::abs(std::log(row->packet_period(dual) / step)); };
    const auto closest = *std::min_element(rows.begin(), rows.end(), [&](auto a, auto b) { return off(a) < off(b); });
    rows = narrowed(rows, [&](auto row) { return off(row) < off(closest) + 0.05; });
  }
  if (first.robosense && first.robosense->lasers && rows.front()->family == PacketFamily::robosense_helios)
    rows = narrowed(rows, [&](auto row) { return row->channels() == first.robosense->lasers->lasers.size(); });
  if (!first.device || rows.front()->family != PacketFamily::leishen_1206) return *rows.front();
  const std::string generation = "leishen_c16_v" + std::to_string(first.device->generation);
  rows = narrowed(rows, [&](const PacketFormat* row) { return row->name.starts_with(generation); });
  if (!tells_angles(*first.device)) return *rows.front();
  return **std::min_element(rows.begin(), rows.end(), [&](auto a, auto b) {
    return distance_from(*a, *first.device) < distance_from(*b, *first.device);
  });
}

std::string stamped_shot(const PacketFormat& format) {
  switch (format.family) {
    case PacketFamily::velodyne:
    case PacketFamily::velodyne_64:
    case PacketFamily::robosense:
    case PacketFamily::robosense_helios: return "first shot";
    case PacketFamily::velodyne_128: return "fourth group of lasers";
    case PacketFamily::hesai_568:
    case PacketFamily::hesai_xt32:
    case PacketFamily::hesai_64:
    case PacketFamily::hesai_40p: return "last firing";
    case PacketFamily::hesai_qt64: return "first firing";
    default: return "last shot";
  }
}

std::string returns_sentence(const DataPacket& packet) {
  if (packet.dual()) return "returns: two a shot";
  switch (packet.return_mode()) {
    case 0x37: return "returns: one a shot, the strongest";
    case 0x38: return "returns: one a shot, the last";
    default: return "returns: one a shot";
  }
}

}  // namespace

PacketConvention recognise_packets(std::span<const Packet> packets, std::string_view sensor, const SensorFile& file) {
  const FirstPackets first = sorted_packets(packets);
  if (first.data.empty()) throw Error("packets", "none is a data packet of a sensor that `tilth sensors` lists");
  if (file.ouster) throw Error(file.name, "is the metadata of an Ouster sensor, but these packets are of another one");
  PacketConvention convention;
  convention.format = most_likely(possible_rows(first, sensor), first);
  const PacketFormat& format = convention.format;
  convention.dual = first.data.front().dual();
  if (format.channels() == 16 && format.layout().big_endian && first.robosense && first.robosense->dual)
    throw Error("sensor " + format.name, "sends two returns a shot, which are not read; let it send one");
  char step[64];
  std::snprintf(step, sizeof step, "%.1f us", format.packet_period(convention.dual) * 1e6);
  std::string sensor_sentence = "sensor: " + format.title + " (" + format.name + "), by packets of ";
  sensor_sentence += std::to_string(format.layout().size) + " bytes";
  if (format.layout().model != 0) sensor_sentence += " with model byte " + hexadecimal(first.data.front().model());
  sensor_sentence += std::string(", one in ") + step;
  convention.decisions.push_back(std::move(sensor_sentence));
  convention.decisions.push_back(returns_sentence(first.data.front()));
  convention.decisions.push_back(take_angles(convention.format, first, file));
  convention.decisions.push_back("time: of each shot, from the firing table; a packet's time is that of its " +
                                 stamped_shot(format));
  convention.clock = decide_clock(first.data, format, first.mark);
  return convention;
}

}  // namespace tilth
