// From a scan to its features, stage by stage and together, as improved_floam makes them. Scenes: 0 corridor, 1 plaza,
// 2 street (64 beams).
#include <benchmark/benchmark.h>

#include "driven_scans.hpp"

namespace {

using namespace tilth;

struct Prepared {
  PointCloud cloud;
  RingLayout rings;
  std::vector<std::uint8_t> keep;

  explicit Prepared(std::int64_t scene) : cloud(bench::simulator(scene).scan(bench::kFirst).scan.cloud) {
    arrange(cloud, rings);
    keep = ring_support(rings, cloud.size(), RingSupportOptions()).value();
  }
};

void layout_of_rings(benchmark::State& state) {
  const Prepared scan(state.range(0));
  RingLayout rings;
  for (auto _ : state) benchmark::DoNotOptimize(arrange(scan.cloud, rings));
  state.counters["points"] = double(scan.cloud.size());
}

void outliers_by_support(benchmark::State& state) {
  const Prepared scan(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(ring_support(scan.rings, scan.cloud.size(), RingSupportOptions()));
}

void segments_of_rings(benchmark::State& state) {
  const Prepared scan(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(ring_segments(scan.cloud, scan.rings, scan.keep, SegmentOptions()).segments.data());
}

void patches_of_scan(benchmark::State& state) {
  const Prepared scan(state.range(0));
  std::size_t patches = 0;
  for (auto _ : state) patches = surface_patches(scan.cloud, scan.rings, scan.keep, PatchOptions()).size();
  state.counters["patches"] = double(patches);
}

void features_of_patches(benchmark::State& state) {
  const Prepared scan(state.range(0));
  const SurfacePatches patches = surface_patches(scan.cloud, scan.rings, scan.keep, PatchOptions());
  std::size_t features = 0;
  for (auto _ : state) {
    const PatchFeatures found = patch_features(patches, FeatureOptions());
    features = found.edges.size() + found.planes.size();
  }
  state.counters["features"] = double(features);
}

void features_of_scan(benchmark::State& state) {
  const Prepared scan(state.range(0));
  for (auto _ : state) {
    const SurfacePatches patches = surface_patches(scan.cloud, scan.rings, scan.keep, PatchOptions());
    benchmark::DoNotOptimize(patch_features(patches, FeatureOptions()).planes.data());
  }
}

}  // namespace

#define TILTH_SCENES(function) BENCHMARK(function)->ArgName("scene")->DenseRange(0, 2)->Unit(benchmark::kMicrosecond)
TILTH_SCENES(layout_of_rings);
TILTH_SCENES(outliers_by_support);
TILTH_SCENES(segments_of_rings);
TILTH_SCENES(patches_of_scan);
TILTH_SCENES(features_of_patches);
TILTH_SCENES(features_of_scan);
BENCHMARK_MAIN();
