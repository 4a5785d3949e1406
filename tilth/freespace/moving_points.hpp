// Points of things that moved, found by the beams that passed where they had been: before they came, or after they had
// gone. docs/clean_map.md has the rules. A voxel of a surface costs 24 bytes, a block of free space 72; about 0.1 us a
// point.
//
//   MovingPoints moving(options);
//   moving.add(scan);                  // scan after scan, in the world
//   moving.judge();                    // now and then, then
//   if (moving.moved(point, scan)) ...
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tilth/freespace/beam_walk.hpp>
#include <tilth/freespace/free_cells.hpp>
#include <tilth/freespace/moving_options.hpp>
#include <tilth/freespace/surface_block.hpp>
#include <tilth/freespace/voxel_sight.hpp>

namespace tilth {

/// A beam of a scan that is followed: from the sensor, where it was at that time, to the point [m], in the world.
struct SightLine {
  Eigen::Vector3f origin, point;
};

struct SeenScan {
  double stamp = 0.0;                   ///< [s]
  std::vector<Eigen::Vector3f> points;  ///< [m] in the world
  std::vector<SightLine> lines;         ///< of one in MovingOptions::every of the points
};

class MovingPoints {
 public:
  explicit MovingPoints(const MovingOptions& options);

  /// The next scan, whose pose must be right. Points farther out than 100 km are passed over. Of each point whether it
  /// is the first thing seen where something else has gone.
  std::vector<std::uint8_t> add(const SeenScan& scan);

  std::uint32_t scans() const { return scan_; }  ///< added

  /// Says what voxels farther than `distance` [m] from `place` are: from then on moved() holds for their points.
  void judge(const Eigen::Vector3f& place, float distance);

  /// Whether a point that was the scans()-th when it was added moved: as far as its voxel alone tells, or after judge()
  /// as far as its neighbours tell as well.
  bool moved(const Eigen::Vector3f& point, std::uint32_t scan) const;

  /// Whether judge() has said what the voxel of the point is; true where nothing is known of it.
  bool judged(const Eigen::Vector3f& point) const;

  /// Forgets all voxels farther than `distance` [m] from `place`.
  void forget(const Eigen::Vector3f& place, float distance);

  std::size_t bytes() const;  ///< held

 private:
  static constexpr float kFarthest = 1e5F;  // [m]

  enum class Verdict : std::uint8_t { unseen, stands, moved, open };
  using Verdicts = std::array<Verdict, 8>;
  using Sights = std::array<VoxelSight, 8>;

  struct Cell {
    Eigen::Vector3i place;
    Sights voxels;
    Verdicts verdicts{};
    bool judged = false;
  };

  struct Place {
    Eigen::Vector3i cell;
    Eigen::Vector3f inside;  ///< in cells, from the cell's corner
    std::size_t voxel;       ///< of the eight
  };

  Place place_of(const Eigen::Vector3f& point) const;
  std::uint32_t surface_of(const Eigen::Vector3f& point, const Eigen::Vector3i& block);
  Cell& cell_of(std::uint32_t surface, const Eigen::Vector3i& cell);
  const Cell* find(const Eigen::Vector3i& cell) const;
  bool hit(const Eigen::Vector3f& point);
  int passes_before(const Eigen::Vector3f& point, const Place& place, const SurfaceBlock& surface) const;
  void follow(const SightLine& line);
  bool tells_nothing(const FreeCells::Block& block, const BeamStretch& beam, float along);
  void pass(Cell& cell, const BeamStretch& beam) const;
  Verdict verdict_alone(const VoxelSight& sight) const;
  Verdict verdict_among(const Cell& cell, std::size_t voxel, std::span<const Cell* const> near, bool first) const;
  void vote(bool first);
  bool is_far(const Eigen::Vector3i& block, const Eigen::Vector3f& place, float distance) const;

  MovingOptions options_;
  float edge_;  // [m] of a cell: two voxels
  std::uint32_t scan_ = 0;
  std::vector<double> stamps_;  // of each scan
  FreeCells free_;
  std::vector<SurfaceBlock> surfaces_;
  std::vector<Cell> cells_;
  Eigen::Vector3i last_block_;  // of hit(): points of a beam lie close together
  std::uint32_t last_surface_ = FreeCells::kNone;
};

}  // namespace tilth
