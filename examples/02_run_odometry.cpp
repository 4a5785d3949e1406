// A recording becomes a trajectory.
//
//   02_run_odometry RECORDING > trajectory.tum
#include <iostream>

#include <tilth/io/trajectory_file.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/tilth.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return std::cerr << "usage: 02_run_odometry RECORDING\n", 2;
  const auto source = tilth::open_source(argv[1]);
  const auto odometry = tilth::make_odometry("tilth");
  while (const auto scan = source->next()) {
    const tilth::OdometryResult result = odometry->register_scan(*scan);
    std::cout << tilth::tum_line({result.stamp, result.T_world_lidar});
  }
}
