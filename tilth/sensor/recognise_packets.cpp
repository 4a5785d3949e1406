#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/core/median.hpp>
#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/recognise_packets.hpp>

namespace tilth {
namespace {

using Rows = std::vector<const PacketFormat*>;

constexpr double kLargestCorrection = 1.5 * std::numbers::pi / 180.0;
constexpr double kLeastElevation = 1e-9;  ///< [rad] a calibrated angle of 0 was never set

struct FirstPackets {
  std::vector<DataPacket> data;
  std::optional<DeviceInfo> device;
  std::optional<ClockTraits::Mark> mark;
};

FirstPackets sorted(std::span<const Packet> first) {
  FirstPackets all;
  for (const Packet& packet : first) {
    const PacketKind kind = kind_of(packet.payload);
    const std::size_t before = all.data.empty() ? 0 : all.data.size() - 1;
    if (kind == PacketKind::data) all.data.emplace_back(packet.payload);
    if (kind == PacketKind::device) {
      all.device = parse_device_packet(packet.payload);
      if (all.device->utc && *all.device->utc > kEarliestClock) all.mark = {before, *all.device->utc + 0.5};
    }
    if (kind == PacketKind::position) {
      if (const auto utc = parse_position_packet(packet.payload).utc) all.mark = {before, *utc + 0.5};
    }
  }
  return all;
}

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
  std::erase_if(rows, [&](const PacketFormat* row) { return row->layout().size != packet.size(); });
  const std::string size = std::to_string(packet.size()) + " bytes";
  if (rows.empty()) throw Error(where, "has no packets of " + size + " as they are here");
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

/// [rad] mean distance of the told angles from those of the row.
double distance_from(const PacketFormat& row, const DeviceInfo& device) {
  double sum = 0.0;
  for (std::size_t i = 0; i < device.elevations.size(); ++i) sum += std::abs(row.elevations[i] - device.elevations[i]);
  return sum / double(device.elevations.size());
}

bool tells_angles(const DeviceInfo& device) {
  return std::any_of(device.elevations.begin(), device.elevations.end(),
                     [](double angle) { return std::abs(angle) > kLeastElevation; });
}

const PacketFormat& most_likely(Rows rows, const FirstPackets& first) {
  const bool dual = first.data.front().dual();
  if (const double step = clock_step(first.data); step > 0.0) {
    const auto off = [&](const PacketFormat* row) { return std::abs(std::log(row->packet_period(dual) / step)); };
    const auto closest = *std::min_element(rows.begin(), rows.end(), [&](auto a, auto b) { return off(a) < off(b); });
    rows = narrowed(rows, [&](auto row) { return off(row) < off(closest) + 0.05; });
  }
  if (!first.device || rows.front()->tail != PacketTail::leishen_1206) return *rows.front();
  const std::string generation = "leishen_c16_v" + std::to_string(first.device->generation);
  rows = narrowed(rows, [&](const PacketFormat* row) { return row->name.starts_with(generation); });
  if (!tells_angles(*first.device)) return *rows.front();
  return **std::min_element(rows.begin(), rows.end(), [&](auto a, auto b) {
    return distance_from(*a, *first.device) < distance_from(*b, *first.device);
  });
}

/// The told angles where they lie close to the table; how many do.
std::size_t correct(PacketFormat& format, const DeviceInfo& device) {
  std::vector<double> elevations = format.elevations;
  std::size_t corrected = 0;
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    const double told = device.elevations[i];
    if (std::abs(told) < kLeastElevation || std::abs(told - elevations[i]) > kLargestCorrection) continue;
    elevations[i] = told;
    ++corrected;
  }
  format = with_elevations(std::move(format), std::move(elevations));
  return corrected;
}

std::string stamped_shot(const PacketFormat& format) {
  if (format.tail == PacketTail::hesai_568) return "last firing";
  return format.tail == PacketTail::velodyne ? "first shot" : "last shot";
}

std::string angle_sentence(PacketFormat& format, const std::optional<DeviceInfo>& device) {
  const std::string rings = "ring: of the channel, 0 the lowest of " + std::to_string(format.channels());
  const bool calibrated = device && format.tail == PacketTail::leishen_1206 && tells_angles(*device);
  const std::size_t corrected = calibrated ? correct(format, *device) : 0;
  if (corrected == 0) return rings + "; elevations of the maker's table";
  return rings + "; elevations of " + std::to_string(corrected) + " as calibrated, from the device packets";
}

}  // namespace

PacketConvention recognise_packets(std::span<const Packet> packets, std::string_view sensor) {
  const FirstPackets first = sorted(packets);
  if (first.data.empty())
    throw Error("packets", "none is a data packet of a Velodyne VLP-16, HDL-32E, Leishen C16 or Hesai XT16");
  PacketConvention convention;
  convention.format = most_likely(possible_rows(first, sensor), first);
  const PacketFormat& format = convention.format;
  convention.dual = first.data.front().dual();
  char step[64];
  std::snprintf(step, sizeof step, "%.1f us", format.packet_period(convention.dual) * 1e6);
  convention.decisions.push_back("sensor: " + format.title + " (" + format.name + "), by packets of " +
                                 std::to_string(format.layout().size) + " bytes with model byte " +
                                 hexadecimal(first.data.front().model()) + ", one in " + step);
  convention.decisions.emplace_back(convention.dual ? "returns: two a shot" : "returns: one a shot");
  convention.decisions.push_back(angle_sentence(convention.format, first.device));
  convention.decisions.push_back("time: of each shot, from the firing table; a packet's time is that of its " +
                                 stamped_shot(format));
  convention.clock = decide_clock(first.data, format, first.mark);
  return convention;
}

}  // namespace tilth
