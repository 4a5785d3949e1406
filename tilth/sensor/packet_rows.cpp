#include <tilth/sensor/packet_rows.hpp>

namespace tilth {
namespace {

using Degrees = std::vector<double>;

const Degrees kTwoDegrees{-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
const Degrees kPuckHiRes{-10, 0.67, -8.67, 2, -7.33, 3.33, -6, 4.67, -4.67, 6, -3.33, 7.33, -2, 8.67, -0.67, 10};
const Degrees kNarrowC16{-10, 0.665, -8.665, 2, -7.33, 3.33, -6, 4.665, -4.665, 6, -3.33, 7.33, -2, 8.665, -0.665, 10};
const Degrees kC16V4{-16, 0, -14, 2, -12, 4, -10, 6, -8, 8, -6, 10, -4, 12, -2, 14};
const Degrees kC16Domestic{-16, -8, 0, 8, -14, -6, 2, 10, -12, -4, 4, 12, -10, -2, 6, 14};
const Degrees kC16V5{-16, 0, -8, 8, -14, 2, -6, 10, -12, 4, -4, 12, -10, 6, -2, 14};

const Degrees kPandarXt16{15, 13, 11, 9, 7, 5, 3, 1, -1, -3, -5, -7, -9, -11, -13, -15};

Degrees hdl32_degrees() {
  Degrees degrees;
  for (int i = 0; i < 16; ++i) degrees.insert(degrees.end(), {(-92.0 + 4 * i) / 3, (-28.0 + 4 * i) / 3});
  return degrees;
}

PacketFormat leishen(const FormatRow& row, const Degrees& elevations) {
  return format_of(row, evenly_fired(elevations, 3.125));
}

PacketFormat calibrated(PacketFormat format) {
  format.needs_calibration = true;
  return format;
}

}  // namespace

std::vector<PacketFormat> velodyne_rows() {
  constexpr PacketFamily usual = PacketFamily::velodyne, two_banks = PacketFamily::velodyne_64,
                         four_banks = PacketFamily::velodyne_128;
  return {
      format_of({"hdl32", "Velodyne HDL-32E", usual, {0x21}, 46.08, 0.002}, evenly_fired(hdl32_degrees(), 1.152)),
      format_of({"vlp16", "Velodyne VLP-16", usual, {0x22, 0x21}, 55.296, 0.002}, evenly_fired(kTwoDegrees, 2.304)),
      format_of({"puck_hires", "Velodyne Puck Hi-Res", usual, {0x24}, 55.296, 0.002}, evenly_fired(kPuckHiRes, 2.304)),
      format_of({"vlp32c", "Velodyne VLP-32C", usual, {0x28}, 55.296, 0.004}, vlp32c_channels()),
      format_of({"vls128", "Velodyne VLS-128", four_banks, {0xA1}, 53.3, 0.004}, vls128_channels(2.665)),
      format_of({"vls128_2020", "Velodyne VLS-128, firmware from 5.2.3", four_banks, {0xA1}, 57.8, 0.004},
                vls128_channels(2.89)),
      calibrated(format_of({"hdl64_s3", "Velodyne HDL-64E S3", two_banks, {}, 57.6, 0.002}, hdl64_s3_channels())),
      calibrated(format_of({"hdl64_s2", "Velodyne HDL-64E S2", two_banks, {}, 48, 0.002}, hdl64_s2_channels())),
  };
}

std::vector<PacketFormat> leishen_rows() {
  constexpr PacketFamily old = PacketFamily::leishen_1206, dated = PacketFamily::leishen_1212;
  return {
      leishen({"leishen_c16_v3", "Leishen C16 v2.8/v3.0", old, {0x10}, 50, 0.0025, 0.0431, 14.68}, kTwoDegrees),
      leishen({"leishen_c16_v3_narrow", "Leishen C16 v2.8/v3.0, 1.33 degrees", old, {0x10}, 50, 0.0025, 0.0431, 14.68},
              kNarrowC16),
      leishen({"leishen_c16_v2", "Leishen C16 v2.6", old, {0x10}, 50, 0.0025, 0.04319, 14.68}, kTwoDegrees),
      leishen({"leishen_c16_v2_narrow", "Leishen C16 v2.6, 1.33 degrees", old, {0x10}, 50, 0.0025, 0.04319, 14.68},
              kNarrowC16),
      leishen({"leishen_c16_v1", "Leishen C16 v1/v2.0", old, {}, 50, 0.01}, kTwoDegrees),
      leishen({"leishen_c16_v4", "Leishen C16 v4.0", dated, {0x10}, 50, 0.004, 0.0361, 20.25}, kC16V4),
      leishen({"leishen_c16_v4_domestic", "Leishen C16 v4.0 (domestic)", dated, {0x12}, 50, 0.004, 0.0361, 20.25},
              kC16Domestic),
      leishen({"leishen_c16_v5", "Leishen C16 v5.0", dated, {0x65}, 50, 0.004, 0.035, 21.80}, kC16V5),
  };
}

std::vector<PacketFormat> hesai_rows() {
  using enum PacketFamily;
  return {
      format_of({"hesai_xt16", "Hesai PandarXT-16", hesai_568, {0x10}, 50, 0.004}, evenly_fired(kPandarXt16, 3.024)),
      format_of({"hesai_xt32", "Hesai PandarXT-32", hesai_xt32, {0x20}, 50, 0.004}, hesai_xt32_channels()),
      calibrated(
          format_of({"hesai_pandar64", "Hesai Pandar64", hesai_64, {0x40}, 55.56, 0.004}, hesai_pandar64_channels())),
      calibrated(
          format_of({"hesai_pandar40p", "Hesai Pandar40P", hesai_40p, {}, 55.56, 0.004}, hesai_pandar40p_channels())),
      calibrated(
          format_of({"hesai_qt64", "Hesai PandarQT", hesai_qt64, {0x40}, 500.0 / 3.0, 0.004}, hesai_qt64_channels())),
  };
}

std::vector<PacketFormat> robosense_rows() {
  using enum PacketFamily;
  return {
      format_of({"robosense_rs16", "RoboSense RS-LiDAR-16", robosense, {0x01}, 55.5, 0.005, 0.03825}, rs16_channels()),
      calibrated(format_of({"robosense_rs32", "RoboSense RS-LiDAR-32", robosense, {0x02}, 55.52, 0.005, 0.03997},
                           rs32_channels())),
      calibrated(format_of({"robosense_helios", "RoboSense RS-Helios", robosense_helios, {}, 55.56, 0.0025, 0.03498},
                           helios_channels())),
      calibrated(
          format_of({"robosense_helios_16p", "RoboSense RS-Helios-16P", robosense_helios, {}, 55.56, 0.0025, 0.03498},
                    helios_16p_channels())),
  };
}

}  // namespace tilth
