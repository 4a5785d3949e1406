// tilth evaluate-map: a map against the scene that it was made of.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "option_flags.hpp"
#include <tilth/core/error.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/simulation/map_truth.hpp>
#include <tilth/sources/world_scene.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

struct EvaluateMapArguments {
  std::string map, mesh, truth, json;
  Alignment align = Alignment::se3;
  OptionValues values;
};

/// A map in the frame of the mesh, and where the LiDAR was.
struct PlacedMap {
  std::vector<Eigen::Vector3d> points;
  std::vector<Pose> poses;
};

std::vector<Eigen::Vector3d> cloud_in(const fs::path& file) {
  const std::string kind = kind_of_file(file.string());
  if (kind != ".pcd" && kind != ".ply") throw Error(file.string(), "is neither a run's folder nor a .pcd or .ply file");
  const PointRecords records = kind == ".pcd" ? read_pcd(file) : read_ply(file);
  std::vector<Eigen::Vector3d> points = positions_of(records, file.string());
  std::erase_if(points, [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  return points;
}

/// True poses at least half a metre or a turn of 30 degrees apart: more see nothing new.
std::vector<Pose> views_of(const Trajectory& truth) {
  std::vector<Pose> views;
  for (const StampedPose& pose : truth) {
    const Pose& T = pose.T_world_lidar;
    if (!views.empty()) {
      const Pose moved = views.back().inverse() * T;
      if (moved.translation().norm() < 0.5 && angle_of(moved) < 0.5) continue;
    }
    views.push_back(T);
  }
  return views;
}

/// The map of a run is moved as its trajectory is onto the truth; a bare file is taken where it is.
PlacedMap placed_map(const EvaluateMapArguments& a) {
  const bool is_run = fs::is_directory(a.map);
  const fs::path beside_scene = fs::path(a.mesh).parent_path().parent_path() / "truth.tum";
  const fs::path truth_file = a.truth.empty() ? beside_scene : fs::path(a.truth);
  if (a.truth.empty() && !fs::exists(truth_file)) {
    throw Error(truth_file.string(), "is not there: name the true trajectory with --truth");
  }
  const Trajectory truth = read_tum(truth_file);
  PlacedMap map{cloud_in(is_run ? fs::path(a.map) / "map.pcd" : fs::path(a.map)), views_of(truth)};
  if (!is_run) return map;
  EvaluationOptions options;
  options.align = a.align;
  options.association.interpolate = true;
  const Similarity S = evaluate(truth, read_tum(fs::path(a.map) / "trajectory.tum"), options).alignment;
  for (Eigen::Vector3d& p : map.points) p = S.scale * (S.rotation * p) + S.translation;
  return map;
}

void print(const MapTruth& t, const MapTruthOptions& options) {
  std::printf("points of the map    %zu\n", t.points);
  std::printf("distance to surface  mean %.4f m, median %.4f, RMSE %.4f, 95th percentile %.4f, max %.4f\n", t.mean,
              t.median, t.rmse, t.p95, t.max);
  std::printf("on a surface         %.2f %% of the points lie within %g m; RMSE of those %.4f m\n", 100 * t.on_surface,
              options.reach, t.rmse_on_surface);
  std::printf("completeness         %.2f %% of %zu points of surface seen have a point of the map within %g m\n",
              100 * t.completeness, t.seen, options.reach);
}

std::string json_of(const MapTruth& t) {
  const nlohmann::ordered_json json{{"points", t.points},
                                    {"distance_mean_m", t.mean},
                                    {"distance_median_m", t.median},
                                    {"distance_rmse_m", t.rmse},
                                    {"distance_p95_m", t.p95},
                                    {"distance_max_m", t.max},
                                    {"on_surface_percent", 100 * t.on_surface},
                                    {"distance_rmse_on_surface_m", t.rmse_on_surface},
                                    {"seen", t.seen},
                                    {"completeness_percent", 100 * t.completeness}};
  return json.dump(2) + "\n";
}

void evaluate_map(const EvaluateMapArguments& a) {
  const auto options = with<MapTruthOptions>(a.values);
  const PlacedMap map = placed_map(a);
  const MapTruth truth = judge_map(map.points, MeshWorld(scene_mesh(a.mesh), {}), map.poses, options);
  if (!a.json.empty()) write_text(a.json, json_of(truth));
  print(truth, options);
}

}  // namespace

void add_evaluate_map(CLI::App& app, int&) {
  const auto a = std::make_shared<EvaluateMapArguments>();
  CLI::App* command = app.add_subcommand("evaluate-map", "Compare a map with the scene that it was made of");
  command->add_option("MAP", a->map, "folder of a run, moved onto the truth; or a .pcd or .ply in the mesh's frame")
      ->required();
  command->add_option("MESH", a->mesh, "true surfaces: scene/mesh.ply of `tilth simulate`, or what assimp reads")
      ->required();
  command->add_option("--truth", a->truth, "true trajectory, TUM (truth.tum beside the folder of the mesh)");
  command->add_option("--align", a->align, "how a run's trajectory is moved onto the truth: origin or se3 (se3)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Alignment>{{"origin", Alignment::origin}, {"se3", Alignment::se3}}));
  add_option_flags(*command, describe(MapTruthOptions{}), a->values);
  command->add_option("--json", a->json, "file to write every figure to");
  command->callback([a] { evaluate_map(*a); });
}

}  // namespace tilth::app
