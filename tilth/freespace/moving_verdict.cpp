#include <algorithm>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr int kRounds = 3;
constexpr std::uint32_t kScansApart = 3;  // that two things seen together may be
constexpr int kFewest = 2;                // neighbours that moved, for one that says nothing itself
constexpr double kOpenWeight = 0.5;       // of a neighbour that says nothing against one that moved
constexpr int kOutnumbered = 3;           // so many times must what stands outnumber what moved to keep it

bool together(const VoxelSight& a, const VoxelSight& b) {
  return std::max(a.first, b.first) <= std::min(a.last, b.last) + kScansApart;
}

}  // namespace

MovingPoints::Verdict MovingPoints::verdict_alone(const VoxelSight& sight) const {
  if (!sight.seen()) return Verdict::unseen;
  if (sight.vacated(options_)) return Verdict::moved;
  const double stay = stamps_[sight.last - 1] - stamps_[sight.first - 1];
  const bool came = sight.before >= FreeCells::kMostPasses && 2 * sight.between < sight.hits + 2;
  if (came && stay < options_.stay) return Verdict::moved;
  const bool firm = sight.hits >= options_.firm_hits && stay >= options_.firm_stay && sight.between <= sight.hits;
  return firm ? Verdict::stands : Verdict::open;
}

/// As most of those say that were seen at the same time close by.
MovingPoints::Verdict MovingPoints::verdict_among(const Cell& cell, std::size_t voxel,
                                                  std::span<const Cell* const> near, bool first) const {
  const Verdict alone = cell.verdicts[voxel];
  if (alone != Verdict::open && !(first && alone == Verdict::moved)) return alone;
  const VoxelSight& sight = cell.voxels[voxel];
  int moved = alone == Verdict::moved ? -1 : 0, stands = 0, open = alone == Verdict::open ? -1 : 0;  // not itself
  for (const Cell* beside : near) {
    for (std::size_t i = 0; i < 8; ++i) {
      const Verdict verdict = beside->verdicts[i];
      if (verdict == Verdict::unseen || !together(sight, beside->voxels[i])) continue;
      ++(verdict == Verdict::moved ? moved : verdict == Verdict::stands ? stands : open);
    }
  }
  if (alone == Verdict::moved) return stands > kOutnumbered * moved + 1 ? Verdict::stands : Verdict::moved;
  return moved >= kFewest && moved > stands + kOpenWeight * open ? Verdict::moved : Verdict::open;
}

void MovingPoints::vote(bool first) {
  std::vector<Verdicts> next(cells_.size());
  std::vector<const Cell*> near;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    next[c] = cell.verdicts;
    const bool settled = std::all_of(cell.verdicts.begin(), cell.verdicts.end(), [&](Verdict v) {
      return v == Verdict::unseen || v == Verdict::stands || (v == Verdict::moved && !first);
    });
    if (settled || !cell.judged) continue;
    near.clear();
    for (int i = 0; i < 27; ++i) {
      const Cell* beside = find(cell.place + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
      if (beside != nullptr) near.push_back(beside);
    }
    for (std::size_t voxel = 0; voxel < 8; ++voxel) next[c][voxel] = verdict_among(cell, voxel, near, first);
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) cells_[c].verdicts = next[c];
}

void MovingPoints::judge(const Eigen::Vector3f& place, float distance) {
  for (Cell& cell : cells_) {
    cell.judged = is_far(FreeCells::block_of(cell.place), place, distance);
    for (std::size_t i = 0; i < 8; ++i) cell.verdicts[i] = verdict_alone(cell.voxels[i]);
  }
  for (int round = 0; round < kRounds; ++round) vote(round == 0);
}

bool MovingPoints::judged(const Eigen::Vector3f& point) const {
  if (!(point.cwiseAbs().maxCoeff() < kFarthest)) return true;
  const Cell* cell = find(place_of(point).cell);
  return cell == nullptr || cell->judged;
}

void MovingPoints::forget(const Eigen::Vector3f& place, float distance) {
  FreeCells old_free;
  std::vector<SurfaceBlock> old_surfaces;
  std::vector<Cell> old_cells;
  std::swap(old_free, free_), std::swap(old_surfaces, surfaces_), std::swap(old_cells, cells_);
  last_surface_ = FreeCells::kNone;
  for (const FreeCells::Block& block : old_free.blocks()) {
    if (is_far(block.place, place, distance)) continue;
    FreeCells::Block& kept = free_[free_.insert(block.place)];
    kept = block;
    if (block.surfaces == FreeCells::kNone) continue;
    kept.surfaces = std::uint32_t(surfaces_.size());
    SurfaceBlock& surface = surfaces_.emplace_back(old_surfaces[block.surfaces]);
    for (std::uint32_t& cell : surface.cells) {
      if (cell == SurfaceBlock::kNoCell) continue;
      cells_.push_back(old_cells[cell]);
      cell = std::uint32_t(cells_.size() - 1);
    }
  }
}

bool MovingPoints::is_far(const Eigen::Vector3i& block, const Eigen::Vector3f& place, float distance) const {
  const Eigen::Vector3f middle = 4 * edge_ * (block.cast<float>().array() + 0.5F);
  return (middle - place).norm() >= distance;
}

}  // namespace tilth
