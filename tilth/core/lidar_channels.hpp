// The lasers of sensors whose packets are known, in the order in which their packets list them: what the model of the
// sensor and the format of its packets share. Figures after the makers' manuals and the drivers named at each.
#pragma once

#include <vector>

namespace tilth {

struct LidarChannels {
  std::vector<double> elevations;  ///< [deg]
  std::vector<double> azimuths;    ///< [deg] by which each points ahead of the head, clockwise; empty: none does
  std::vector<double> times;       ///< [us] after the head stands where the packet says it does
};

/// Velodyne VLP-32C: pairs of lasers 2.304 us apart (user manual; ros-drivers/velodyne).
LidarChannels vlp32c_channels();

/// Velodyne VLS-128: eight lasers at once, `group_us` [us] apart, a pause as long after the eighth group: 2.665
/// (ros-drivers/velodyne), from firmware 5.2.3 on 2.89 (velodyne_decoder, after the manual's revision 4).
LidarChannels vls128_channels(double group_us);

/// Velodyne HDL-64E, S2 or S3: nominal angles, the lower block of 32 behind the upper one; both blocks fire together,
/// eight groups of four lasers (the "laser firing time tables" of the manuals). A unit's own angles lie up to half a
/// degree off.
LidarChannels hdl64_s2_channels();
LidarChannels hdl64_s3_channels();

/// Hesai PandarXT-32, Pandar64, Pandar40P and PandarQT (user manuals; Hesai's SDKs; tier4/nebula). But for the XT-32
/// these are angles of one unit: others differ by up to half a degree.
LidarChannels hesai_xt32_channels();
LidarChannels hesai_pandar64_channels();
LidarChannels hesai_pandar40p_channels();
LidarChannels hesai_qt64_channels();

/// RoboSense RS-LiDAR-16, RS-Helios 32 (angles of one unit) and RS-LiDAR-32, RS-Helios-16P without angles, which are
/// the unit's own: times after RoboSense's rs_driver and tier4/nebula.
LidarChannels rs16_channels();
LidarChannels rs32_channels();
LidarChannels helios_channels();
LidarChannels helios_16p_channels();

}  // namespace tilth
