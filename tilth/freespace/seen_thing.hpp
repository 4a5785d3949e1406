// What beams have said of one thing in one voxel, in the order of the scans: when they met it, and how often they
// passed where it stands before, between and since.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include <tilth/freespace/moving_options.hpp>

namespace tilth {

struct SeenThing {
  Eigen::Vector3f point;                     ///< [m] its first one, in the world
  float seen_from = 0.0F;                    ///< [m] away, then
  std::uint32_t block = 0, block_below = 0;  ///< numbers of those about it and just below it
  std::uint32_t next = 0;                    ///< the thing before it in its cell
  std::uint32_t born = 0;                    ///< scan that saw it first, counted from 1
  std::uint32_t first = 0, last = 0;         ///< scans that met it
  std::uint32_t free_until = 0;              ///< scan that passed last where it was born later
  std::uint8_t voxel = 0;                    ///< of the eight of its cell
  std::uint8_t met = 0;                      ///< scans, 255 at the most
  std::uint8_t before = 0;                   ///< passes before it was met first: as in `since`
  std::uint8_t between = 0, since = 0;  ///< passes between two times that it was met, and since: tenths, by nearness
  bool calm = false;                    ///< nothing speaks for it having moved: it is looked at less often
  bool gone = false;                    ///< passed so often that it can no longer stand

  static constexpr int kPass = 10;  ///< of a beam through the very place

  /// Met by a scan; where what stood there has gone before, the thing begins with it.
  void meet(std::uint32_t scan, const MovingOptions& options) {
    if (met == 0 || vacated(options)) {
      first = scan, before = since, met = 1, between = 0;
    } else {
      between = std::uint8_t(std::min(255, between + since));
      met = std::uint8_t(std::min(255, met + 1));
    }
    since = 0;
    last = scan;
  }

  /// Whether both were there at the same time, or nearly.
  bool together(const SeenThing& other) const {
    constexpr std::uint32_t kScansApart = 3;
    return std::max(first, other.first) <= std::min(last, other.last) + kScansApart;
  }

  void pass(int tenths) { since = std::uint8_t(std::min(255, since + tenths)); }

  /// Whether it has been passed so often since it was last met that it must have gone. While it stood, a scan that came
  /// near met it with the chance met / (met + between).
  bool vacated(const MovingOptions& options) const {
    const double passes = double(since) / kPass;
    if (met == 0 || passes < options.least_passes) return false;
    constexpr double kSurest = 0.9, kThird = 1.0 / 3;
    const double chance = std::min(kSurest, met / (met + double(between) / kPass + kThird));
    return -passes * std::log(1 - chance) >= options.surprise;
  }
};

}  // namespace tilth
