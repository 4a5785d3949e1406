#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include <tilth/sensor/packet_format.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMicrosecond = 1e-6;

using Degrees = std::vector<double>;

const Degrees kTwoDegrees{-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
const Degrees kPuckHiRes{-10, 0.67, -8.67, 2, -7.33, 3.33, -6, 4.67, -4.67, 6, -3.33, 7.33, -2, 8.67, -0.67, 10};
const Degrees kNarrowC16{-10, 0.665, -8.665, 2, -7.33, 3.33, -6, 4.665, -4.665, 6, -3.33, 7.33, -2, 8.665, -0.665, 10};
const Degrees kC16V4{-16, 0, -14, 2, -12, 4, -10, 6, -8, 8, -6, 10, -4, 12, -2, 14};
const Degrees kC16Domestic{-16, -8, 0, 8, -14, -6, 2, 10, -12, -4, 4, 12, -10, -2, 6, 14};
const Degrees kC16V5{-16, 0, -8, 8, -14, 2, -6, 10, -12, 4, -4, 12, -10, 6, -2, 14};

const Degrees kPandarXt16{15, 13, 11, 9, 7, 5, 3, 1, -1, -3, -5, -7, -9, -11, -13, -15};

constexpr double kHesaiLead = 6.0;  ///< [us] from the time of the packet to the first shot of its last firing

Degrees hdl32_degrees() {
  Degrees degrees;
  for (int i = 0; i < 16; ++i) degrees.insert(degrees.end(), {(-92.0 + 4 * i) / 3, (-28.0 + 4 * i) / 3});
  return degrees;
}

/// A row but for its angles; times in microseconds, the optical centre in metres and degrees.
struct FormatRow {
  const char *name, *title;
  PacketTail tail;
  std::vector<std::uint8_t> models;
  double channel_us, firing_us, unit, radius, angle;
};

PacketFormat row(const FormatRow& r, const Degrees& degrees) {
  std::vector<double> elevations;
  for (const double angle : degrees) elevations.push_back(angle * kDegree);
  PacketFormat format;
  format.name = r.name, format.title = r.title, format.tail = r.tail, format.models = r.models;
  format.channel_period = r.channel_us * kMicrosecond, format.firing_period = r.firing_us * kMicrosecond;
  format.unit = r.unit, format.centre_radius = r.radius, format.centre_angle = r.angle * kDegree;
  return with_elevations(std::move(format), std::move(elevations));
}

std::vector<PacketFormat> all_rows() {
  constexpr PacketTail velodyne = PacketTail::velodyne;
  constexpr PacketTail old = PacketTail::leishen_1206, dated = PacketTail::leishen_1212;
  return {
      row({"hdl32", "Velodyne HDL-32E", velodyne, {0x21}, 1.152, 46.08, 0.002, 0, 0}, hdl32_degrees()),
      row({"vlp16", "Velodyne VLP-16", velodyne, {0x22, 0x21}, 2.304, 55.296, 0.002, 0, 0}, kTwoDegrees),
      row({"puck_hires", "Velodyne Puck Hi-Res", velodyne, {0x24}, 2.304, 55.296, 0.002, 0, 0}, kPuckHiRes),
      row({"leishen_c16_v3", "Leishen C16 v2.8/v3.0", old, {0x10}, 3.125, 50, 0.0025, 0.0431, 14.68}, kTwoDegrees),
      row({"leishen_c16_v3_narrow",
           "Leishen C16 v2.8/v3.0, 1.33 degrees",
           old,
           {0x10},
           3.125,
           50,
           0.0025,
           0.0431,
           14.68},
          kNarrowC16),
      row({"leishen_c16_v2", "Leishen C16 v2.6", old, {0x10}, 3.125, 50, 0.0025, 0.04319, 14.68}, kTwoDegrees),
      row({"leishen_c16_v2_narrow", "Leishen C16 v2.6, 1.33 degrees", old, {0x10}, 3.125, 50, 0.0025, 0.04319, 14.68},
          kNarrowC16),
      row({"leishen_c16_v1", "Leishen C16 v1/v2.0", old, {}, 3.125, 50, 0.01, 0, 0}, kTwoDegrees),
      row({"leishen_c16_v4", "Leishen C16 v4.0", dated, {0x10}, 3.125, 50, 0.004, 0.0361, 20.25}, kC16V4),
      row({"leishen_c16_v4_domestic", "Leishen C16 v4.0 (domestic)", dated, {0x12}, 3.125, 50, 0.004, 0.0361, 20.25},
          kC16Domestic),
      row({"leishen_c16_v5", "Leishen C16 v5.0", dated, {0x65}, 3.125, 50, 0.004, 0.035, 21.80}, kC16V5),
      row({"hesai_xt16", "Hesai PandarXT-16", PacketTail::hesai_568, {0x10}, 3.024, 50, 0.004, 0, 0}, kPandarXt16),
  };
}

}  // namespace

const PacketLayout& layout_of(PacketTail tail) {
  static constexpr PacketLayout kShort{1206, 0, 12, 32, 4, 3, 1204, 1205, 1200};
  static constexpr PacketLayout kDated{1212, 0, 12, 32, 4, 3, 1210, 1211, 1200};
  static constexpr PacketLayout kHesai{568, 12, 8, 16, 2, 4, 550, 6, 553};
  if (tail == PacketTail::hesai_568) return kHesai;
  return tail == PacketTail::leishen_1212 ? kDated : kShort;
}

double PacketFormat::stamp_offset(bool dual) const {
  if (tail == PacketTail::velodyne) return 0.0;
  if (tail == PacketTail::hesai_568) return packet_period(dual) - block_period() - kHesaiLead * kMicrosecond;
  return last_shot(dual);
}

std::span<const PacketFormat> packet_formats() {
  static const std::vector<PacketFormat> rows = all_rows();
  return rows;
}

PacketFormat with_elevations(PacketFormat format, std::vector<double> elevations) {
  std::vector<std::size_t> order(elevations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return elevations[a] < elevations[b]; });
  format.rings.resize(order.size());
  for (std::size_t ring = 0; ring < order.size(); ++ring) format.rings[order[ring]] = std::uint16_t(ring);
  format.elevations = std::move(elevations);
  return format;
}

}  // namespace tilth
