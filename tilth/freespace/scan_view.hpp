// A scan as its sensor saw it: what the beams say of places, which are found by their directions. Six bytes a beam.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/freespace/moving_options.hpp>

namespace tilth {

struct SeenScan {
  double stamp = 0.0;                    ///< [s]
  std::vector<Eigen::Vector3f> points;   ///< [m] in the world
  std::vector<Eigen::Vector3f> origins;  ///< [m] in the world, where the sensor was at up to 256 times of the scan
  std::vector<std::uint8_t> origin_of;   ///< number of the origin that each point was seen from

  const Eigen::Vector3f& place() const { return origins[origins.size() / 2]; }  ///< [m] of the sensor, about midway
};

/// What a scan says of a place.
struct Glimpse {
  enum class Kind : std::uint8_t { nothing, met, passed };
  Kind kind = Kind::nothing;
  float miss = 0.0F;                                    ///< [m] from the nearest beam that passed
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< of that beam, of length 1
};

/// A beam in 65536ths of a turn by the square that stands in for the circle, from straight down; range in 4 mm.
struct PackedBeam {
  std::uint16_t azimuth, elevation, range;
};

/// Room that is needed to make views one after the other.
struct ViewWorkspace {
  std::vector<PackedBeam> beams, sorted;
};

class ScanView {
 public:
  static constexpr std::size_t kBatch = 64;  ///< places that are looked at in one go

  /// Takes the beams of another scan. Points that are not finite or farther out than 260 m are passed over.
  void take(const SeenScan& scan, const MovingOptions& options, ViewWorkspace& workspace);

  /// Says of up to kBatch `places` [m]: met where a beam ends there, passed where the nearest one goes on behind it.
  void look(std::span<const Eigen::Vector3f> places, std::span<Glimpse> seen) const;

  const Eigen::Vector3f& place() const { return place_; }  ///< [m] of the sensor
  std::size_t bytes() const { return sizeof(ScanView) + beams_.capacity() * sizeof(PackedBeam); }

 private:
  static constexpr int kCells = 1024;  // of azimuth in a turn
  static constexpr int kWords = 2;     // of 64 levels of elevation

  struct Aims;
  struct Search;

  int level_of(float elevation) const;
  void index_levels();
  void fill_origins(const std::array<bool, kCells>& known);
  void aim(std::span<const Eigen::Vector3f> places, Aims& aims) const;
  Glimpse look(const Search& sought) const;
  bool has_beams(std::size_t cell, int low, int high) const;
  void search(const Search& sought, std::size_t cell, Glimpse& best) const;

  float radius_ = 0, near_ = 0, reach_ = 0, margin_ = 0, met_ = 0;  // [m]
  Eigen::Vector3f place_ = Eigen::Vector3f::Zero();
  std::vector<Eigen::Vector3f> origins_;
  std::array<std::uint8_t, kCells> origin_of_{};
  std::array<std::uint32_t, kCells + 1> begins_{};
  std::array<std::array<std::uint64_t, kWords>, kCells> occupied_{};  // levels with a beam, a bit each
  float lowest_ = 0, levels_a_unit_ = 1;                              // elevation of the first level
  std::vector<PackedBeam> beams_;                                     // by cell of azimuth, then by elevation
};

}  // namespace tilth
