#include <cmath>

#include <Eigen/Eigenvalues>

#include <tilth/calibration/surface_cells.hpp>
#include <tilth/core/median.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kFewest = 20;  // points of a cell
constexpr double kBroad = 0.12;      // [cells] that a cell's points reach along their plane at least
constexpr double kSharp = 0.1;       // of the variance along the plane, across it at most
constexpr double kMargin = 0.15;     // [cells] of a plane from the faces along it at least
constexpr double kRough = 2;         // of the variance that noise explains, at most
constexpr double kFrontal = 0.2;     // squared cosine of incidence from which on noise shows
constexpr double kAlike = 0.97;      // cosine between normals that are taken for one

void find_plane(SurfaceCell& cell, const BeamCalibrationOptions& o) {
  if (cell.count < double(kFewest)) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver((cell.moments / cell.count).matrix());
  const Vector3d& w = solver.eigenvalues();
  cell.flat = w[0] < o.flat * o.flat && w[1] > std::pow(kBroad * o.cell, 2) && w[0] < kSharp * w[1];
  cell.thickness = std::sqrt(std::max(w[0], 0.0));
  cell.normal = solver.eigenvectors().col(0);
  int axis = 0;
  cell.normal.cwiseAbs().maxCoeff(&axis);
  if (cell.normal[axis] < 0) cell.normal = -cell.normal;
}

/// The normal of a cell is that of the flat cells around that face alike: one cell's own is wrong by a degree or two,
/// which would feign information.
void share_normals(std::vector<SurfaceCell>& cells, double block) {
  VoxelTable table;
  std::vector<Vector3d> sums;
  std::vector<std::uint32_t> block_of(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i].flat) continue;
    int axis = 0;
    cells[i].normal.cwiseAbs().maxCoeff(&axis);
    block_of[i] = table.insert(voxel_key(voxel_of(cells[i].mean / block), axis));
    sums.resize(table.size(), Vector3d::Zero());
    sums[block_of[i]] += cells[i].count * cells[i].normal;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i].flat) continue;
    const Vector3d mean = sums[block_of[i]].normalized();
    if (mean.dot(cells[i].normal) > kAlike) cells[i].normal = mean;
    cells[i].along = cells[i].normal.unitOrthogonal();
    cells[i].across = cells[i].normal.cross(cells[i].along);
  }
}

/// A face of the lattice near the plane and along it would cut its points in two, each half with the errors of one
/// sign.
bool centred(const SurfaceCell& cell, const Vector3d& corner, double edge) {
  int axis = 0;
  cell.normal.cwiseAbs().maxCoeff(&axis);
  const double place = (cell.mean - corner)[axis] / edge;
  const double above = place - std::floor(place);
  return above > kMargin && above < 1 - kMargin;
}

/// Puts the points that have no cell yet into those of a lattice with a corner at `corner`; keeps the flat ones.
void add_cells(std::vector<SurfacePoint>& points, std::vector<SurfaceCell>& cells, const Vector3d& corner,
               const BeamCalibrationOptions& o) {
  VoxelTable table;
  std::vector<SurfacePoint*> open;
  std::vector<std::uint32_t> cell_of;
  for (SurfacePoint& p : points) {
    if (p.cell != VoxelTable::kNone) continue;
    open.push_back(&p);
    cell_of.push_back(table.insert(voxel_key(voxel_of((p.point - corner) / o.cell), 0)));
  }
  std::vector<SurfaceCell> found(table.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    found[cell_of[i]].count += open[i]->count, found[cell_of[i]].mean += open[i]->count * open[i]->point;
  }
  for (SurfaceCell& cell : found) cell.mean /= cell.count;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Vector3d d = open[i]->point - found[cell_of[i]].mean;
    found[cell_of[i]].moments += Symmetric3d::product(d, open[i]->count * d);
  }
  std::vector<std::uint32_t> number(found.size(), VoxelTable::kNone);
  for (std::size_t c = 0; c < found.size(); ++c) {
    find_plane(found[c], o);
    if (!found[c].flat || !centred(found[c], corner, o.cell)) continue;
    number[c] = std::uint32_t(cells.size());
    cells.push_back(found[c]);
  }
  for (std::size_t i = 0; i < open.size(); ++i) open[i]->cell = number[cell_of[i]];
}

/// Drops the cells that are thicker than the noise of the ranges explains: two surfaces, or a curved one, of which each
/// beam sees the side that faces it.
void drop_rough(std::vector<SurfacePoint>& points, std::vector<SurfaceCell>& cells, const BeamCalibrationOptions& o) {
  std::vector<double> frontal(cells.size(), 0.0), explained = frontal, usual;  // by noise of unit variance a return
  for (const SurfacePoint& p : points) {
    if (p.cell == VoxelTable::kNone) continue;
    const double share = std::pow(p.by_range.dot(cells[p.cell].normal), 2) / cells[p.cell].count;
    frontal[p.cell] += p.count * share, explained[p.cell] += share;
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (frontal[c] > kFrontal) usual.push_back(std::pow(cells[c].thickness, 2) / explained[c]);
  }
  if (usual.empty()) return;
  const double variance = median(usual);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells[c].flat = std::pow(cells[c].thickness, 2) < kRough * (explained[c] * variance + o.floor * o.floor);
  }
  for (SurfacePoint& p : points) {
    if (p.cell != VoxelTable::kNone && !cells[p.cell].flat) p.cell = VoxelTable::kNone;
  }
}

}  // namespace

std::vector<SurfaceCell> find_surface_cells(std::vector<SurfacePoint>& points, const Vector3d& origin,
                                            const BeamCalibrationOptions& o) {
  std::vector<SurfaceCell> cells;
  add_cells(points, cells, origin, o);
  add_cells(points, cells, origin + Vector3d::Constant(0.5 * o.cell), o);
  share_normals(cells, o.block);
  drop_rough(points, cells, o);
  return cells;
}

}  // namespace tilth
