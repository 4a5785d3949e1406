// tilth score-basin: from how far off GICP and ICP find a scan in the map of the scans before it (Fu et al. 2026,
// section 2.2: "the initial pose has highly low sensitivity").
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "option_arguments.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/fu2026.hpp>
#include <tilth/simulation/counter_random.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFarthest = 2.0, kWidest = 45 * kDegree;     // [m] [rad] of a start
constexpr double kFoundWithin = 0.1, kFoundTurned = kDegree;  // [m] [rad] what counts as found
constexpr std::size_t kBefore = 50;                           // scans that make the map
constexpr int kParts = 4;                                     // of either range, in the table

struct ScoreBasinArguments {
  std::vector<std::string> scenes, settings;
  OptionValues simulation;
  int starts = 200, scan = 250;
};

/// A scan, and the map of those before it, taken at once and put together by the truth.
struct BasinCase {
  PrintedFeatures features;
  Pose T_map_lidar;
  CroppedMap edges, planes;
};

BasinCase basin_case(const std::string& scene, const ScoreBasinArguments& a, const Fu2026Options& options) {
  OptionValues values = a.simulation;
  values.insert({"snapshot", "true"});
  const Simulator simulator(scene, simulation_options(scene, values));
  const auto last = std::size_t(a.scan);
  if (last < kBefore || last >= simulator.size())
    throw Error("--scan",
                "must lie between " + std::to_string(kBefore) + " and " + std::to_string(simulator.size() - 1));
  OutlierFilter filter(options.outliers);
  BasinCase c{{}, Pose::Identity(), CroppedMap(options.edge_map), CroppedMap(options.plane_map)};
  for (std::size_t i = last - kBefore; i <= last; ++i) {
    const Scan scan = simulator.scan(i).scan;
    RingLayout rings;
    arrange(scan.cloud, rings);
    c.features = printed_features(select_kept(scan.cloud, filter.keep(scan.cloud, rings)), options);
    c.T_map_lidar = interpolate(simulator.truth(), scan.stamp);
    if (i == last) break;
    c.edges.insert(moved(c.features.edges, c.T_map_lidar), c.T_map_lidar.translation());
    c.planes.insert(moved(c.features.planes, c.T_map_lidar), c.T_map_lidar.translation());
  }
  return c;
}

/// A start `distance` [m] off in a level direction and turned by `angle` [rad] about the vertical.
struct BasinStart {
  double distance, angle;
  Pose T_map_lidar;
};

std::vector<BasinStart> starts_of(const BasinCase& c, int count) {
  std::vector<BasinStart> starts;
  CounterRandom random(1, 0);
  for (int i = 0; i < count; ++i) {
    const double distance = random.uniform(0, kFarthest), angle = random.uniform(0, kWidest);
    const double way = random.uniform(0, 2 * std::numbers::pi), sign = random.chance(0.5) ? 1 : -1;
    Pose T = c.T_map_lidar;
    T.translation() += distance * Eigen::Vector3d(std::cos(way), std::sin(way), 0);
    T.linear() = T.linear() * Eigen::AngleAxisd(sign * angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    starts.push_back({distance, angle, T});
  }
  return starts;
}

bool is_found(const BasinCase& c, const Pose& T) {
  const Pose off = c.T_map_lidar.inverse() * T;
  return off.translation().norm() < kFoundWithin && angle_of(off) < kFoundTurned;
}

/// How many of the starts end at the truth, by how far off they are.
struct BasinTable {
  std::string name;
  int tried[kParts][kParts] = {}, found[kParts][kParts] = {};
  int all = 0, iterations = 0;

  void add(const BasinStart& start, bool is_there, int needed) {
    const int i = std::min(kParts - 1, int(kParts * start.distance / kFarthest));
    const int j = std::min(kParts - 1, int(kParts * start.angle / kWidest));
    ++tried[i][j], found[i][j] += is_there, all += is_there, iterations += needed;
  }

  void print(int starts) const {
    std::printf("  %-5s found %d of %d, %.1f iterations in the mean\n    distance [m]", name.c_str(), all, starts,
                double(iterations) / starts);
    for (int j = 0; j < kParts; ++j) std::printf("  %5.1f deg", kWidest / kDegree * (j + 1) / kParts);
    for (int i = 0; i < kParts; ++i) {
      std::printf("\n    up to %-6.1f", kFarthest * (i + 1) / kParts);
      for (int j = 0; j < kParts; ++j) std::printf("  %3d of %2d", found[i][j], tried[i][j]);
    }
    std::printf("\n");
  }
};

template <class Associate>
BasinTable basin_of(const std::string& name, const BasinCase& c, const std::vector<BasinStart>& starts,
                    const Fu2026Options& options, const Associate& associate) {
  NeighborhoodGaussians edges(c.edges.cloud(), options.neighbors, options.lambda);
  NeighborhoodGaussians planes(c.planes.cloud(), options.neighbors, options.lambda);
  BasinTable table{.name = name};
  for (const BasinStart& start : starts) {
    const AlignResult result = align(
        start.T_map_lidar, options.align, [&](const Pose& T) { return associate(c.features.edges, T, edges); },
        [&](const Pose& T) { return associate(c.features.planes, T, planes); });
    table.add(start, is_found(c, result.T_target_source), result.iterations);
  }
  return table;
}

void score_scene(const std::string& scene, const ScoreBasinArguments& a, const Fu2026Options& options) {
  const BasinCase c = basin_case(scene, a, options);
  const std::vector<BasinStart> starts = starts_of(c, a.starts);
  const auto gicp = [&](const GaussianPoints& source, const Pose& T, NeighborhoodGaussians& target) {
    return associate_gaussians(source, T, target, options.max_distance);
  };
  const auto icp = [&](const GaussianPoints& source, const Pose& T, NeighborhoodGaussians& target) {
    return associate_nearest(source, T, target.cloud(), options.max_distance);
  };
  std::printf("%s, scan %d, %zu edges and %zu planes\n", scene.c_str(), a.scan, c.features.edges.means.size(),
              c.features.planes.means.size());
  basin_of("GICP", c, starts, options, gicp).print(a.starts);
  basin_of("ICP", c, starts, options, icp).print(a.starts);
}

void score_basin(const ScoreBasinArguments& a) {
  OptionValues values{{"outliers.per_range", "true"}, {"outliers.density_min", "0"}, {"outliers.density_max", "1"}};
  for (const auto& [key, value] : parse_settings(a.settings)) values[key] = value;
  const auto options = with<Fu2026Options>(values);
  for (const std::string& scene : a.scenes) score_scene(scene, a, options);
}

}  // namespace

void add_score_basin(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("score-basin", "From how far off GICP and ICP find a scan in a map");
  const auto a = std::make_shared<ScoreBasinArguments>();
  command->add_option("scenes", a->scenes, "scenes of `tilth simulate`, their scans taken at once")->required();
  for (const char* key : {"seed", "sensor", "noise"}) {
    command->add_option_function<std::string>(
        std::string("--") + key, [a, key](const std::string& text) { a->simulation[key] = text; },
        "as `tilth simulate` takes it");
  }
  command->add_option("--starts", a->starts, "up to 2 m and 45 degrees off (200)")->check(CLI::Range(1, 1000000));
  command->add_option("--scan", a->scan, "number of the scan; the fifty before it are the map (250)");
  add_settings(*command, a->settings, "options of the pipeline fu2026, such as max_distance=5");
  command->footer(
      "Found: within 0.1 m and 1 degree of the truth. Features and covariances are those of the pipeline\n"
      "fu2026, the outlier filter bounded and by range, so that it works. Same starts for both.");
  command->callback([a] { score_basin(*a); });
}

}  // namespace tilth::app
