#include <tilth/registration/scan_to_scan.hpp>

namespace tilth {

AlignResult align_scan_to_scan(const TimedFeatures& scan, const ScanTargets& targets, const Pose& T_init,
                               const ScanToScanOptions& options) {
  AlignResult result{.T_target_source = T_init};
  LinearSystem system;
  if (targets.edges.size() >= std::size_t(options.min_edges) &&
      targets.planes.size() >= std::size_t(options.min_planes)) {
    ScanPairs<PointToPlane> planes({&scan.planes, scan.period}, targets.planes, options.matches);
    ScanPairs<PointToLine> lines({&scan.edges, scan.period}, targets.edges, options.matches);
    const auto planes_at = [&](const Pose& T) { return planes(T); };
    const auto lines_at = [&](const Pose& T) { return lines(T); };
    const AlignResult ground = align(T_init, options.ground_step, planes_at);
    result = align(ground.T_target_source, options.edge_step, lines_at);
    const auto add = [&](const auto& pairs) {
      accumulate(system, std::span(pairs.data(), pairs.size()), result.T_target_source, RobustKernel());
    };
    add(planes_at(result.T_target_source));
    add(lines_at(result.T_target_source));
    result.converged &= ground.converged;
    result.iterations += ground.iterations;
  }
  result.candidates = scan.edges.size() + scan.planes.size();
  diagnose(system, options.edge_step.degeneracy_ratio, result);
  return result;
}

}  // namespace tilth
