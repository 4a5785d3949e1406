#include <cmath>

#include <tilth/core/turn.hpp>
#include <tilth/slam/scan_context.hpp>

namespace tilth {
namespace {

// 1 - cosine of two columns, averaged over those that hold something in either place (Kim and Kim, eq. 6).
double shifted_distance(const ScanContext& query, const ScanContext& candidate, Eigen::Index shift) {
  const Eigen::Index sectors = query.heights.cols();
  double sum = 0;
  int compared = 0;
  for (Eigen::Index q = 0; q < sectors; ++q) {
    const auto a = query.heights.col(q), b = candidate.heights.col((q + shift) % sectors);
    const double lengths = double(a.norm()) * double(b.norm());
    if (a.isZero() && b.isZero()) continue;
    sum += lengths > 0 ? 1 - double(a.dot(b)) / lengths : 1;
    ++compared;
  }
  return compared > 0 ? sum / compared : 1;
}

}  // namespace

ScanContext describe_place(const PointCloud& cloud, const ScanContextOptions& options) {
  ScanContext context;
  context.heights = Eigen::MatrixXf::Zero(options.rings, options.sectors);
  const double per_ring = std::log(options.max_range / options.min_range) / options.rings;
  for (const Eigen::Vector3d& p : cloud.points) {
    const double range = std::hypot(p.x(), p.y());
    if (!(range >= options.min_range && range < options.max_range && p.z() > options.floor)) continue;
    const auto ring = Eigen::Index(std::log(range / options.min_range) / per_ring);
    const double turned = std::atan2(p.y(), p.x()) / kTurn;
    const auto sector = Eigen::Index((turned < 0 ? turned + 1 : turned) * options.sectors);
    float& height = context.heights(std::min<Eigen::Index>(ring, options.rings - 1),
                                    std::min<Eigen::Index>(sector, options.sectors - 1));
    height = std::max(height, float(p.z() - options.floor));
  }
  context.ring_key = (context.heights.array() > 0).cast<float>().rowwise().mean();
  return context;
}

ContextMatch compare(const ScanContext& query, const ScanContext& candidate) {
  ContextMatch best;
  const Eigen::Index sectors = query.heights.cols();
  for (Eigen::Index shift = 0; shift < sectors; ++shift) {
    const double distance = shifted_distance(query, candidate, shift);
    if (distance >= best.distance) continue;
    const double turns = double(shift) / double(sectors);
    best = {distance, kTurn * (turns > 0.5 ? turns - 1 : turns)};
  }
  return best;
}

}  // namespace tilth
