// Two clouds, seen from two places: how lies one in the other?
//
//   01_align_two_clouds TARGET.pcd SOURCE.pcd
#include <iostream>

#include <tilth/sources/open_source.hpp>
#include <tilth/tilth.hpp>

int main(int argc, char** argv) {
  if (argc != 3) return std::cerr << "usage: 01_align_two_clouds TARGET SOURCE\n", 2;
  const tilth::PointCloud target = tilth::open_source(argv[1])->next().value().cloud;
  const tilth::PointCloud source = tilth::open_source(argv[2])->next().value().cloud;

  const tilth::AlignResult found = tilth::align_clouds(source, target);

  if (!found.converged) return std::cerr << "the clouds do not match\n", 1;
  std::cout << "T_target_source =\n"
            << found.T_target_source.matrix()
            << "\nstandard deviations [rad, m]: " << found.covariance.diagonal().cwiseSqrt().transpose() << '\n';
}
