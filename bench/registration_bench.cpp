// Registration of a scan to the map of the fifty before it, from a start 3 cm and half a degree off: the GICP of
// improved_floam on its features, point to point ICP in the same framework, and `tilth`'s own registration of pose and
// velocity on at most 1,500 patches; and the map's own work. Scenes: 0 corridor, 1 plaza.
#include <benchmark/benchmark.h>

#include "driven_scans.hpp"
#include <tilth/odometry/improved_floam.hpp>
#include <tilth/odometry/tilth_odometry.hpp>

namespace {

using namespace tilth;

const Vector6d kOff = (Vector6d() << 0.004, -0.004, 0.006, 0.02, -0.02, 0.01).finished();  // [rad, m]

void report(benchmark::State& state, const AlignResult& result, const Pose& T_true) {
  const Vector6d error = log(T_true.inverse() * result.T_target_source);
  state.counters["iterations"] = result.iterations;
  state.counters["pairs"] = double(result.matches);
  state.counters["mm"] = 1e3 * error.tail<3>().norm();
  state.counters["mdeg"] = 1e3 * 180 / M_PI * error.head<3>().norm();
}

template <class Associate>
void align_features(benchmark::State& state, const Associate& associate) {
  const bench::RegistrationCase c = bench::registration_case(state.range(0));
  const ImprovedFloamOptions options;
  const Pose T_start = retract(c.scan.T_world_middle, kOff);
  AlignResult result;
  for (auto _ : state) {
    MatchedPatches<MapSurface> source{c.features};
    result =
        align(T_start, options.align, [&](const Pose& T) { return associate(source, T, c.map, options.association); });
  }
  report(state, result, c.scan.T_world_middle);
}

void gicp(benchmark::State& state) {
  align_features(state, [](auto&&... arguments) { return associate_distributions(arguments...); });
}

void point_to_point(benchmark::State& state) {
  align_features(state, [](auto&&... arguments) { return associate_points(arguments...); });
}

void gicp_one_iteration(benchmark::State& state) {
  const bench::RegistrationCase c = bench::registration_case(state.range(0));
  ImprovedFloamOptions options;
  options.align.max_iterations = 1;
  for (auto _ : state) {
    MatchedPatches<MapSurface> source{c.features};
    benchmark::DoNotOptimize(align(c.scan.T_world_middle, options.align, [&](const Pose& T) {
      return associate_distributions(source, T, c.map, options.association);
    }));
  }
}

void pose_and_velocity(benchmark::State& state) {
  bench::RegistrationCase c = bench::registration_case(state.range(0));
  const TilthOptions options;
  const double middle = 0.05, interval = 0.1;  // [s]
  SurfacePatches patches;
  for (std::size_t i = 0, n = c.scan.patches.size(), most = std::size_t(options.max_patches); i < std::min(n, most);
       ++i)
    patches.push_back(c.scan.patches[i * n / std::min(n, most)]);
  const Pose T_start = retract(c.scan.T_world_middle, kOff);
  const MotionPrior prior{.T_map_last = T_start, .interval = interval, .known = true};  // which stands still
  ContinuousTimeAlignment result;
  for (auto _ : state) result = align_continuous_time(patches, middle, prior, c.map, options.align);
  report(state, result.pose, c.scan.T_world_middle);
}

void insertion(benchmark::State& state) {
  const bench::RegistrationCase c = bench::registration_case(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    PatchMap map = c.map;
    state.ResumeTiming();
    map.insert(c.scan.patches, c.scan.T_world_middle);
  }
  state.counters["patches"] = double(c.scan.patches.size());
  state.counters["surfaces"] = double(c.map.surfaces().size());
}

void look_up(benchmark::State& state) {
  const bench::RegistrationCase c = bench::registration_case(state.range(0));
  const Eigen::Matrix3d R = c.scan.T_world_middle.linear();
  for (auto _ : state) {
    for (const SurfacePatch& patch : c.features)
      benchmark::DoNotOptimize(c.map.find(c.scan.T_world_middle * patch.mean, R * patch.normal, patch.flat));
  }
  state.counters["features"] = double(c.features.size());
}

}  // namespace

#define TILTH_SCENES(function) BENCHMARK(function)->ArgName("scene")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond)
TILTH_SCENES(gicp);
TILTH_SCENES(point_to_point);
TILTH_SCENES(gicp_one_iteration);
TILTH_SCENES(pose_and_velocity);
TILTH_SCENES(insertion);
TILTH_SCENES(look_up);
BENCHMARK_MAIN();
