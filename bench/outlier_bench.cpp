// Outlier removal by each of its methods, given neighbours. Places: 0 room, 1 corridor, 2 open ground. And with the
// search of neighbours, of a simulated scan (scene 0 corridor, 1 plaza).
#include <benchmark/benchmark.h>

#include "driven_scans.hpp"
#include "search/generated_scans.hpp"
#include <tilth/preprocess/outlier_removal.hpp>

namespace {

void remove_outliers(benchmark::State& state) {
  const tilth::generated::Place places[] = {tilth::generated::kRoom, tilth::generated::kCorridor,
                                            tilth::generated::kOpenGround};
  const tilth::PointCloud scan = tilth::generated::make_scan({.place = places[state.range(0)]}, 1);
  const tilth::OutlierOptions options{.method = tilth::OutlierMethod(state.range(1))};
  const tilth::NeighborTable table = tilth::scan_neighbors(scan, std::size_t(options.k));
  tilth::OutlierFilter filter(options);
  for (auto _ : state) benchmark::DoNotOptimize(filter.keep(scan, table).data());
  state.SetLabel(std::string(names_of(options.method)[std::size_t(options.method)]));
  state.counters["points"] = double(scan.size());
}

void find_and_remove_outliers(benchmark::State& state) {
  const tilth::PointCloud scan = tilth::bench::simulator(state.range(0)).scan(tilth::bench::kFirst).scan.cloud;
  const tilth::OutlierOptions options{.method = tilth::OutlierMethod(state.range(1))};
  tilth::ScanNeighbors search;
  tilth::OutlierFilter filter(options);
  for (auto _ : state) {
    const tilth::NeighborTable& table = search.compute(scan, std::size_t(options.k));
    benchmark::DoNotOptimize(filter.keep(scan, table).data());
  }
  state.SetLabel(std::string(names_of(options.method)[std::size_t(options.method)]));
}

}  // namespace

BENCHMARK(find_and_remove_outliers)
    ->ArgNames({"scene", "method"})
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(remove_outliers)
    ->ArgNames({"place", "method"})
    ->ArgsProduct({{0, 1, 2}, {1, 2, 3}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_MAIN();
