// Two simulated rooms of points, one shifted: what a robot's program needs of Tilth, with nothing but tilth::odometry.
#include <tilth/tilth.hpp>

namespace {

/// The walls, floor and ceiling of a room of 10 x 8 x 4 m, as 16 beams see them from `x` [m] ahead of its middle.
tilth::Scan scan_of_room(double stamp, double x) {
  tilth::Scan scan{stamp, {}};
  for (int ring = 0; ring < 16; ++ring) {
    for (int column = 0; column < 1800; ++column) {
      const double azimuth = -column * 2 * M_PI / 1800, elevation = (2 * ring - 15) * M_PI / 180;
      const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                 std::sin(elevation));
      const Eigen::Vector3d ahead =
          (beam.array() > 0).select(Eigen::Vector3d(5 - x, 4, 2), Eigen::Vector3d(5 + x, 4, 2));
      scan.cloud.points.push_back(beam * (ahead.array() / beam.array().abs()).minCoeff());
      scan.cloud.times.push_back(float(column) * 0.1F / 1800);
      scan.cloud.rings.push_back(std::uint16_t(ring));
    }
  }
  return scan;
}

}  // namespace

int main() {
  const tilth::AlignResult found = tilth::align_clouds(scan_of_room(0, 0.3).cloud, scan_of_room(0, 0).cloud);
  const bool aligned = found.converged && std::abs(found.T_target_source.translation().x() - 0.3) < 0.01;
  const auto odometry = tilth::make_odometry("tilth");
  tilth::OdometryResult result;
  for (int i = 0; i < 10; ++i) result = odometry->register_scan(scan_of_room(0.1 * i, 0));
  const bool stands = result.alignment.converged && result.T_world_lidar.translation().norm() < 0.01;
  return aligned && stands ? 0 : 1;
}
