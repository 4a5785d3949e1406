// What beams have said of one voxel: when it was hit, and how often it was seen through before, between and since.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include <tilth/freespace/moving_options.hpp>

namespace tilth {

struct VoxelSight {
  std::uint32_t first = 0, last = 0;    ///< scans that hit it, counted from 1; 0: none yet
  std::uint32_t gone = 0;               ///< points of scans before this one have gone; 0: none has
  std::uint16_t last_pass = 0;          ///< low bits of the last scan whose beam passed
  std::uint8_t hits = 0;                ///< scans that hit it since it was free
  std::uint8_t before = 0;              ///< beams that passed before that
  std::uint8_t between = 0, since = 0;  ///< scans whose beams passed between two hits, and since the last one
  std::array<std::uint8_t, 3> mean{};   ///< of its points: 256 steps of a cell from the cell's corner

  bool seen() const { return first != 0; }

  void begin(std::uint32_t scan, std::uint8_t passes_before) {
    first = last = scan;
    hits = 1, between = since = 0;
    before = passes_before;
  }

  /// Hit again, by another scan.
  void hit(std::uint32_t scan) {
    between = std::uint8_t(std::min(255, between + since));
    since = 0;
    hits = std::uint8_t(std::min(255, hits + 1));
    last = scan;
  }

  void pass(std::uint32_t scan) {
    if (last == scan || last_pass == std::uint16_t(scan)) return;
    last_pass = std::uint16_t(scan);
    since = std::uint8_t(std::min(255, since + 1));
  }

  /// Whether it has been passed so often since its last hit that what was hit must have gone. While it stood, a scan
  /// that came near hit it with the chance hits / (hits + between).
  bool vacated(const MovingOptions& options) const {
    if (since < options.least_passes) return false;
    constexpr double kSurest = 0.9, kThird = 1.0 / 3;
    const double chance = std::min(kSurest, hits / (hits + between + kThird));
    return -since * std::log(1 - chance) >= options.surprise;
  }
};

}  // namespace tilth
