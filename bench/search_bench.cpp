// Neighbours of every point of a scan: the search along rings beside nanoflann (tree and queries), and local
// covariances. Places: 0 room, 1 corridor, 2 open ground, made for tests; 3 corridor, 4 plaza as simulated;
// 5 a street, seen by 64 beams.
#include <vector>

#include <benchmark/benchmark.h>

#include "driven_scans.hpp"
#include "search/generated_scans.hpp"
#include <tilth/search/kdtree.hpp>
#include <tilth/search/neighbor_moments.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace {

using tilth::generated::make_scan;

tilth::PointCloud scan_of(std::int64_t place) {
  const tilth::generated::Place places[] = {tilth::generated::kRoom, tilth::generated::kCorridor,
                                            tilth::generated::kOpenGround};
  if (place >= 3) return tilth::bench::simulator(place - 3).scan(tilth::bench::kFirst).scan.cloud;
  return make_scan({.place = places[place]}, 1);
}

void along_rings(benchmark::State& state) {
  const tilth::PointCloud scan = scan_of(state.range(0));
  tilth::ScanNeighbors search;
  for (auto _ : state) benchmark::DoNotOptimize(search.compute(scan, std::size_t(state.range(1))).indices.data());
  state.counters["points"] = double(scan.size());
}

void by_nanoflann(benchmark::State& state) {
  const tilth::PointCloud scan = scan_of(state.range(0));
  std::vector<tilth::Neighbor> found;
  for (auto _ : state) {
    const tilth::KdTree tree(scan.points);
    for (const Eigen::Vector3d& p : scan.points) {
      tree.knn(p, std::size_t(state.range(1)) + 1, found);
      benchmark::DoNotOptimize(found.data());
    }
  }
}

void covariances(benchmark::State& state) {
  const tilth::PointCloud scan = scan_of(state.range(0));
  const tilth::NeighborTable table = tilth::scan_neighbors(scan, std::size_t(state.range(1)));
  tilth::NeighborMoments moments;
  for (auto _ : state) benchmark::DoNotOptimize(moments.compute(scan, table).xx.data());
}

}  // namespace

BENCHMARK(along_rings)
    ->ArgNames({"place", "k"})
    ->ArgsProduct({{0, 1, 2, 3, 4, 5}, {10, 20, 30}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(by_nanoflann)
    ->ArgNames({"place", "k"})
    ->ArgsProduct({{0, 1, 2, 3, 4, 5}, {10, 20, 30}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(covariances)
    ->ArgNames({"place", "k"})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {10, 20}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_MAIN();
