#include <algorithm>
#include <cmath>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr float kSteps = 256;  // of a mean, in a cell

Eigen::Vector3f mean_of(const VoxelSight& sight, const Eigen::Vector3i& cell, float edge) {
  const Eigen::Vector3f inside(sight.mean[0], sight.mean[1], sight.mean[2]);
  return edge * (cell.cast<float>() + (inside.array() + 0.5F).matrix() / kSteps);
}

/// Draws the mean towards another point, of which it is the `count`-th.
void add_to_mean(VoxelSight& sight, const Eigen::Vector3f& inside, float count) {
  for (int a = 0; a < 3; ++a) {
    std::uint8_t& mean = sight.mean[std::size_t(a)];
    const float moved = float(mean) + (kSteps * inside[a] - 0.5F - float(mean)) / count;
    mean = std::uint8_t(std::clamp(std::round(moved), 0.0F, kSteps - 1));
  }
}

}  // namespace

MovingPoints::MovingPoints(const MovingOptions& options) : options_(options), edge_(float(2 * options.voxel)) {}

std::vector<std::uint8_t> MovingPoints::add(const SeenScan& scan) {
  ++scan_;
  stamps_.push_back(scan.stamp);
  std::vector<std::uint8_t> anew(scan.points.size(), 0);
  for (std::size_t i = 0; i < scan.points.size(); ++i) anew[i] = std::uint8_t(hit(scan.points[i]));
  for (const SightLine& line : scan.lines) follow(line);
  return anew;
}

MovingPoints::Place MovingPoints::place_of(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f at = point / edge_;
  const Eigen::Vector3i cell = voxel_of(at.cast<double>());
  const Eigen::Vector3f inside = at - cell.cast<float>();
  const auto upper = [&](int axis) { return std::size_t(inside[axis] >= 0.5F); };
  return {cell, inside, upper(0) | upper(1) << 1U | upper(2) << 2U};
}

/// The number of the surface in that block, made where there is none.
std::uint32_t MovingPoints::surface_of(const Eigen::Vector3f& point, const Eigen::Vector3i& block) {
  if (last_surface_ != FreeCells::kNone && block == last_block_) return last_surface_;
  std::uint32_t& number = free_[free_.insert(block)].surfaces;
  if (number == FreeCells::kNone) {
    number = std::uint32_t(surfaces_.size());
    surfaces_.emplace_back(point);
  }
  last_block_ = block;
  return last_surface_ = number;
}

MovingPoints::Cell& MovingPoints::cell_of(std::uint32_t surface, const Eigen::Vector3i& cell) {
  const int bit = FreeCells::bit_of(cell);
  std::uint32_t& number = surfaces_[surface].cells[std::size_t(bit)];
  if (number == SurfaceBlock::kNoCell) {
    number = std::uint32_t(cells_.size());
    cells_.emplace_back().place = cell;
    free_[free_.insert(FreeCells::block_of(cell))].surface |= std::uint64_t{1} << bit;
  }
  return cells_[number];
}

const MovingPoints::Cell* MovingPoints::find(const Eigen::Vector3i& cell) const {
  const FreeCells::Block* block = free_.find(FreeCells::block_of(cell));
  if (block == nullptr || block->surfaces == FreeCells::kNone) return nullptr;
  const std::uint32_t number = surfaces_[block->surfaces].cells[std::size_t(FreeCells::bit_of(cell))];
  return number == SurfaceBlock::kNoCell ? nullptr : &cells_[number];
}

bool MovingPoints::hit(const Eigen::Vector3f& point) {
  if (!(point.cwiseAbs().maxCoeff() < kFarthest)) return false;
  const Place place = place_of(point);
  const std::uint32_t surface = surface_of(point, FreeCells::block_of(place.cell));
  VoxelSight& sight = cell_of(surface, place.cell).voxels[place.voxel];
  if (sight.last == scan_) return sight.gone == scan_;
  const bool again = sight.seen() && !sight.vacated(options_);
  if (again) {
    constexpr float kLongest = 20;
    sight.hit(scan_);
    add_to_mean(sight, place.inside, std::min(kLongest, float(sight.hits)));
  } else {
    if (sight.seen()) sight.gone = scan_;
    sight.begin(scan_,
                std::uint8_t(sight.seen() ? FreeCells::kMostPasses : passes_before(point, place, surfaces_[surface])));
    add_to_mean(sight, place.inside, 1);
  }
  surfaces_[surface].add(point);
  return !again && sight.gone == scan_;
}

/// Beams that passed all about the voxel, as nothing that stands lets them; off a plane, the cell itself suffices.
int MovingPoints::passes_before(const Eigen::Vector3f& point, const Place& place, const SurfaceBlock& surface) const {
  int passes = free_.passes(place.cell);
  if (passes == 0) return 0;
  constexpr float kWellOff = 1.5F;
  const auto clearance = float(options_.clearance);
  if (surface.planar() && std::abs(surface.offset(point)) > kWellOff * clearance) return passes;
  for (int side = 0; side < 6 && passes > 0; ++side) {
    Eigen::Vector3i beside = place.cell;
    beside[side / 2] += side % 2 == 0 ? -1 : 1;
    passes = std::min(passes, free_.passes(beside));
  }
  return passes;
}

void MovingPoints::follow(const SightLine& line) {
  const Eigen::Vector3f way = line.point - line.origin;
  const float length = way.norm();
  if (!(length < kFarthest) || !(line.origin.cwiseAbs().maxCoeff() < kFarthest)) return;
  const BeamStretch beam{line.origin, way / length, float(options_.near),
                         std::min(length - float(options_.margin), float(options_.reach))};
  Eigen::Vector3i last = Eigen::Vector3i::Constant(std::numeric_limits<int>::max());
  std::uint32_t number = 0;
  bool blind = false;
  walk(beam, edge_, [&](const Eigen::Vector3i& cell, float along) {
    const Eigen::Vector3i place = FreeCells::block_of(cell);
    if (place != last) {
      last = place;
      number = free_.insert(place);
      blind = tells_nothing(free_[number], beam, along);
    }
    FreeCells::Block& block = free_[number];
    const int bit = FreeCells::bit_of(cell);
    block.pass(std::uint64_t{1} << bit);
    if (blind || (block.surface >> bit & 1U) == 0) return;
    pass(cells_[surfaces_[block.surfaces].cells[std::size_t(bit)]], beam);
  });
}

/// Whether the beam, which enters the block at `along`, has nothing to say of the voxels in it: it grazes their plane.
bool MovingPoints::tells_nothing(const FreeCells::Block& block, const BeamStretch& beam, float along) {
  if (block.surfaces == FreeCells::kNone) return true;
  SurfaceBlock& surface = surfaces_[block.surfaces];
  surface.refresh(float(options_.thickness));
  if (!surface.planar()) return false;
  const float sine = surface.sine(beam.direction);
  if (std::abs(sine) >= float(options_.grazing)) return false;
  const float in = surface.offset(beam.origin) + sine * along, out = in + sine * 4 * edge_;
  return in * out <= 0 || std::min(std::abs(in), std::abs(out)) < float(options_.clearance);
}

void MovingPoints::pass(Cell& cell, const BeamStretch& beam) const {
  const auto radius = float(options_.beam_radius);
  for (VoxelSight& sight : cell.voxels) {
    if (!sight.seen() || sight.last == scan_) continue;
    const Eigen::Vector3f mean = mean_of(sight, cell.place, edge_) - beam.origin;
    const float along = mean.dot(beam.direction);
    if (along < beam.end && (mean - along * beam.direction).squaredNorm() < radius * radius) sight.pass(scan_);
  }
}

bool MovingPoints::moved(const Eigen::Vector3f& point, std::uint32_t scan) const {
  if (!(point.cwiseAbs().maxCoeff() < kFarthest)) return false;
  const Place place = place_of(point);
  const Cell* cell = find(place.cell);
  if (cell == nullptr) return false;
  const VoxelSight& sight = cell->voxels[place.voxel];
  if (scan < sight.gone) return true;
  return cell->judged ? cell->verdicts[place.voxel] == Verdict::moved : sight.vacated(options_);
}

std::size_t MovingPoints::bytes() const {
  constexpr std::size_t kTable = 2 * (sizeof(std::int64_t) + sizeof(std::uint64_t));
  return free_.blocks().size() * (sizeof(FreeCells::Block) + kTable) + surfaces_.size() * sizeof(SurfaceBlock) +
         cells_.size() * sizeof(Cell);
}

}  // namespace tilth
