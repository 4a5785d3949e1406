#include <cstddef>

#include <tilth/core/lidar_channels.hpp>

namespace tilth {
namespace {

using Numbers = std::vector<double>;

const Numbers kRs16Elevations{-15, -13, -11, -9, -7, -5, -3, -1, 15, 13, 11, 9, 7, 5, 3, 1};
const Numbers kRs32Times{0.00,  2.88,  5.76,  8.64,  11.52, 14.40, 17.28, 20.16, 23.04, 25.92, 28.80,
                         31.68, 34.56, 37.44, 40.32, 44.64, 1.44,  4.32,  7.20,  10.08, 12.96, 15.84,
                         18.72, 21.60, 24.48, 27.36, 30.24, 33.12, 36.00, 38.88, 41.76, 46.08};
const Numbers kHeliosTimes{0.00,  1.57,  3.15,  4.72,  6.30,  7.87,  9.45,  11.36, 13.26, 15.17, 17.08,
                           18.99, 20.56, 22.14, 23.71, 25.29, 26.53, 29.01, 27.77, 30.25, 31.49, 33.98,
                           32.73, 35.22, 36.46, 37.70, 38.94, 40.18, 41.42, 42.67, 43.91, 45.15};
const Numbers kHelios16pTimes{0.00,  3.15,  6.30,  9.45,  13.26, 17.08, 20.56, 23.71,
                              26.53, 27.77, 31.49, 32.73, 36.46, 38.94, 41.42, 43.91};

const Numbers kHeliosElevations{14.94,  13.03,  10.92,  8.89,   6.96,   5.46,   3.98,   2.67,   1.33,   0.00,   -1.33,
                                -2.67,  -3.96,  -5.13,  -6.53,  -7.91,  -9.89,  -15.97, -12.90, -19.08, -22.02, -27.97,
                                -25.16, -31.15, -34.09, -37.29, -40.25, -43.71, -46.70, -49.75, -52.70, -54.60};
const Numbers kHeliosAzimuths{-4.07, 3.63,  -4.02, 3.60,  -3.99, 3.58,  -3.98, 3.57,  -3.97, 3.57,  -3.97,
                              3.57,  -3.98, 3.58,  -3.99, 3.59,  -4.01, 3.66,  -4.04, 3.70,  -4.19, 3.88,
                              -4.26, 3.97,  -4.52, 4.14,  -4.76, 4.38,  -5.03, 4.61,  -5.32, 4.80};

}  // namespace

LidarChannels rs16_channels() {
  LidarChannels channels{kRs16Elevations, {}, {}};
  for (std::size_t i = 0; i < channels.elevations.size(); ++i) channels.times.push_back(2.8 * double(i));
  return channels;
}

LidarChannels rs32_channels() {
  return {Numbers(32), {}, kRs32Times};
}

LidarChannels helios_channels() {
  return {kHeliosElevations, kHeliosAzimuths, kHeliosTimes};
}

LidarChannels helios_16p_channels() {
  return {Numbers(16), {}, kHelios16pTimes};
}

}  // namespace tilth
