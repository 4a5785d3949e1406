// Uses one function of every installed library; ends with zero where all of them answer as they should.
#include <tilth/core/trajectory.hpp>
#include <tilth/evaluation/distribution.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/simulation/scenes.hpp>

int main() {
  const tilth::Trajectory trajectory{{0.0, tilth::Pose::Identity()}, {1.0, tilth::Pose(Eigen::Translation3d(3, 4, 0))}};
  tilth::write_tum("trajectory.tum", trajectory);
  const bool read_back = tilth::path_length(tilth::read_tum("trajectory.tum")) == 5.0;
  const bool registers = tilth::make_odometry(tilth::pipelines().front().name, {}) != nullptr;
  const bool median = tilth::distribution_of({1.0, 2.0, 9.0}).median == 2.0;
  return read_back && registers && median ? 0 : 1;
}
