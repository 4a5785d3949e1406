// Points of things that moved, found by the beams that passed where they had been: before they came, or after they had
// gone. docs/clean_map.md has the rules. A voxel with a thing costs 70 bytes, a block of space 0.5 kB, a scan that is
// kept six bytes a beam; about 2 us a voxel.
//
//   MovingPoints moving(options);
//   const auto things = moving.add(scan, points);   // scan after scan; those of its points that are to be judged
//   moving.judge(place, distance);                  // now and then
//   if (moving.moved(things[i])) ...                // points[i] is of something that moved
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tilth/core/voxel_table.hpp>
#include <tilth/freespace/changes.hpp>
#include <tilth/freespace/moving_options.hpp>
#include <tilth/freespace/scan_view.hpp>
#include <tilth/freespace/seen_thing.hpp>
#include <tilth/freespace/surface_block.hpp>

namespace tilth {

class MovingPoints {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  explicit MovingPoints(const MovingOptions& options);

  /// The next scan, whose pose must be right. Returns for each of `points`, which are of the scan, the number of the
  /// thing that it belongs to, or kNone farther out than 100 km.
  std::vector<std::uint32_t> add(const SeenScan& scan, std::span<const Eigen::Vector3f> points);

  std::uint32_t scans() const { return scan_; }  ///< added

  /// Says what things are that are left behind: farther than `distance` [m] from `place`, and farther than they were
  /// when they were seen first. From then on moved() holds for them. With distance 0, of all things.
  void judge(const Eigen::Vector3f& place, float distance);

  /// Whether a thing moved: as far as is known of itself, or after judge() as far as its neighbours tell as well.
  bool moved(std::uint32_t thing) const;

  /// Whether judge() has said what it is; true for kNone.
  bool judged(std::uint32_t thing) const;

  /// When a thing was there that stood still and then left, or came where beams had passed and stayed; nothing for all
  /// others. After judge().
  std::optional<Stay> changed(std::uint32_t thing) const;

  /// Whether beams have passed where it was since: what is seen there later is another thing.
  bool gone(std::uint32_t thing) const { return thing != kNone && things_[thing].gone; }

  /// Forgets what was judged, and scans seen from farther than `distance` [m] from `place`. Returns the new number of
  /// each thing, kNone for those that are forgotten.
  std::vector<std::uint32_t> forget(const Eigen::Vector3f& place, float distance);

  std::size_t bytes() const;  ///< held

 private:
  enum class Verdict : std::uint8_t { stands, moved, open };

  struct Judgement {
    Verdict verdict = Verdict::open;
    bool judged = false;
    bool came = false;  ///< where nothing was before, and stays
  };

  /// Of space, four cells an edge: what is known of its surface, and its things by their cells.
  struct Block {
    Eigen::Vector3i place;  ///< in blocks
    SurfaceBlock surface;
    std::array<std::uint32_t, 64> heads;  ///< thing of each cell that came last
  };
  using Around = std::array<const Block*, 27>;

  struct KeptView {
    std::uint32_t scan = 0;
    ScanView view;
  };

  std::uint32_t watch(const Eigen::Vector3f& point, const Eigen::Vector3f& place);
  std::uint32_t insert(const SeenThing& thing);
  std::uint32_t block_of(const Eigen::Vector3f& point);
  void find_surfaces(const SeenScan& scan);
  ScanView& next_view();
  void catch_up(std::uint32_t scan);
  void look(const KeptView& kept, std::uint32_t from, std::uint32_t to);
  void note(SeenThing& thing, std::uint32_t scan, const Glimpse& seen);
  bool grazes(const SeenThing& thing, const Eigen::Vector3f& direction) const;
  bool on_old_plane(const SeenThing& thing) const;

  Verdict verdict_alone(const SeenThing& thing) const;
  Verdict verdict_among(std::uint32_t number, std::span<const std::uint32_t> near, bool first) const;
  Around around(const Block& block) const;
  void gather(const Around& around, int cell, std::vector<std::uint32_t>& near) const;
  void vote(bool first);
  bool stayed(const SeenThing& thing) const;
  bool may_have_come(std::uint32_t number) const;
  bool came_with_others(std::uint32_t number, std::span<const std::uint32_t> near) const;
  void find_arrivals();

  MovingOptions options_;
  float edge_;  // [m] of a cell: two voxels
  std::uint32_t scan_ = 0;
  std::vector<double> stamps_;                // of each scan
  std::vector<std::uint32_t> first_of_scan_;  // thing of each scan
  std::vector<SeenThing> things_;             // in the order in which they were seen first
  std::vector<Judgement> judgements_;
  std::uint32_t looked_ = 0;  // things that were looked at in scans before them
  VoxelTable table_;
  std::vector<Block> blocks_;
  std::vector<KeptView> views_;  // by scan
  ViewWorkspace workspace_;
};

}  // namespace tilth
