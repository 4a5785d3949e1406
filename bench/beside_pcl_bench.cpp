// PCL beside Tilth in the same run, on the scans of the other benchmarks: ten neighbours of all points, outliers by
// distance, and GICP to the map of fifty scans. Built where PCL is found (libpcl-dev). Scenes: 0 corridor, 1 plaza.
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>

#include <benchmark/benchmark.h>

#include "driven_scans.hpp"
#include <tilth/odometry/improved_floam.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace {

using namespace tilth;
using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr int kNeighbors = 10;

PclCloud::Ptr to_pcl(const std::vector<Eigen::Vector3d>& points) {
  PclCloud::Ptr cloud(new PclCloud);
  for (const Eigen::Vector3d& p : points) cloud->push_back({float(p.x()), float(p.y()), float(p.z())});
  return cloud;
}

PointCloud measured_scan(std::int64_t scene) {
  return bench::simulator(scene).scan(bench::kFirst).scan.cloud;
}

void neighbors_by_tilth(benchmark::State& state) {
  const PointCloud scan = measured_scan(state.range(0));
  ScanNeighbors search;
  for (auto _ : state) benchmark::DoNotOptimize(search.compute(scan, kNeighbors).indices.data());
}

void neighbors_by_pcl(benchmark::State& state) {
  const PclCloud::Ptr cloud = to_pcl(measured_scan(state.range(0)).points);
  pcl::Indices indices;
  std::vector<float> squared;
  for (auto _ : state) {
    pcl::KdTreeFLANN<pcl::PointXYZ> tree;
    tree.setInputCloud(cloud);
    for (const pcl::PointXYZ& p : *cloud)
      benchmark::DoNotOptimize(tree.nearestKSearch(p, kNeighbors + 1, indices, squared));
  }
}

void outliers_by_tilth(benchmark::State& state) {
  const PointCloud scan = measured_scan(state.range(0));
  ScanNeighbors search;
  OutlierFilter filter({.method = OutlierMethod::plain, .k = kNeighbors, .per_range = false});
  std::size_t kept = 0;
  for (auto _ : state) {
    const std::vector<std::uint8_t>& keep = filter.keep(scan, search.compute(scan, kNeighbors));
    kept = std::size_t(std::count(keep.begin(), keep.end(), 1));
  }
  state.counters["kept"] = double(kept);
}

void outliers_by_pcl(benchmark::State& state) {
  const PclCloud::Ptr cloud = to_pcl(measured_scan(state.range(0)).points);
  PclCloud kept;
  for (auto _ : state) {
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(cloud);
    filter.setMeanK(kNeighbors);
    filter.setStddevMulThresh(1.0);
    filter.filter(kept);
  }
  state.counters["kept"] = double(kept.size());
}

// The start is 3 cm and half a degree off.
Pose start_of(const bench::RegistrationCase& c) {
  return retract(c.scan.T_world_middle, (Vector6d() << 0.004, -0.004, 0.006, 0.02, -0.02, 0.01).finished());
}

void report(benchmark::State& state, const bench::RegistrationCase& c, const Pose& T_found) {
  state.counters["features"] = double(c.features.size());
  state.counters["map"] = double(c.map.means().size());
  state.counters["mm"] = 1e3 * (T_found.translation() - c.scan.T_world_middle.translation()).norm();
}

void gicp_by_tilth(benchmark::State& state) {
  const bench::RegistrationCase c = bench::registration_case(state.range(0));
  const ImprovedFloamOptions options;
  AlignResult result;
  for (auto _ : state) {
    MatchedPatches<MapSurface> source{c.features};
    result = align(start_of(c), options.align,
                   [&](const Pose& T) { return associate_distributions(source, T, c.map, options.association); });
  }
  report(state, c, result.T_target_source);
}

// The map is prepared: its tree and covariances are worked out before.
void gicp_by_pcl(benchmark::State& state) {
  const bench::RegistrationCase c = bench::registration_case(state.range(0));
  std::vector<Eigen::Vector3d> means;
  for (const SurfacePatch& patch : c.features) means.push_back(patch.mean);
  const PclCloud::Ptr source = to_pcl(means), target = to_pcl(c.map.means());
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
  gicp.setMaxCorrespondenceDistance(1.0);
  gicp.setInputTarget(target);
  PclCloud moved;
  const auto register_source = [&] {
    gicp.setInputSource(source);
    gicp.align(moved, start_of(c).matrix().cast<float>());
  };
  register_source();
  for (auto _ : state) register_source();
  report(state, c, Pose(gicp.getFinalTransformation().cast<double>()));
}

}  // namespace

#define TILTH_SCENES(function) BENCHMARK(function)->ArgName("scene")->DenseRange(0, 1)->Unit(benchmark::kMicrosecond)
TILTH_SCENES(neighbors_by_tilth);
TILTH_SCENES(neighbors_by_pcl);
TILTH_SCENES(outliers_by_tilth);
TILTH_SCENES(outliers_by_pcl);
TILTH_SCENES(gicp_by_tilth);
TILTH_SCENES(gicp_by_pcl);
BENCHMARK_MAIN();
