#include <tilth/run/scan_row.hpp>

namespace tilth {

ScanRow row_of(const Scan& scan, const OdometryResult& result) {
  ScanRow row;
  row.stamp = result.stamp;
  row.points_read = scan.cloud.size();
  row.points_in = result.counts.points_in;
  row.outliers = result.counts.outliers;
  row.edges = result.counts.edges;
  row.planes = result.counts.planes;
  row.candidates = result.alignment.candidates;
  row.matches = result.alignment.matches;
  row.weight = result.alignment.weight;
  row.iterations = result.alignment.iterations;
  row.converged = result.alignment.converged;
  row.error = result.alignment.error;
  row.degenerate_directions = result.alignment.degenerate_directions;
  row.track = result.track;
  row.covariance = result.covariance.value_or(result.alignment.covariance);
  return row;
}

}  // namespace tilth
