// tilth map: what saved maps hold, and files of them for others.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "option_arguments.hpp"
#include "option_flags.hpp"
#include <tilth/atlas/map_folder.hpp>
#include <tilth/atlas/map_writer.hpp>
#include <tilth/atlas/merge_maps.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/las_reader.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/localization/cloud_origin.hpp>
#include <tilth/localization/virtual_places.hpp>
#include <tilth/run/file_sinks.hpp>
#include <tilth/run/grid_sink.hpp>
#include <tilth/run/localization_run.hpp>
#include <tilth/run/output_options.hpp>
#include <tilth/run/saved_plan.hpp>

namespace tilth::app {
namespace {

struct MapArguments {
  std::string map, later, out, origin;
  bool grid = false;
  std::vector<std::string> settings;  // of LocalizationOptions
  OptionValues thinning;              // of MapOptions
  OptionValues plan;                  // of OccupancyOptions
  OptionValues places;                // of VirtualPlaceOptions
};

double length_of(const MapFolder& map) {
  double length = 0;
  for (std::size_t i = 1; i < map.places().size(); ++i)
    length += (map.places()[i].T_map_lidar.translation() - map.places()[i - 1].T_map_lidar.translation()).norm();
  return length;
}

int print_info(const MapArguments& a) {
  const MapFolder map(a.map);
  Eigen::AlignedBox3d box;
  for (const MapPlace& place : map.places()) box.extend(place.T_map_lidar.translation());
  std::size_t patches = 0, closures = 0;
  for (std::size_t i = 0; i < map.places().size(); ++i) patches += map.patches(i).size();
  for (const Constraint& constraint : map.graph().constraints) closures += constraint.closure;
  const double length = length_of(map), megabytes = 1e-6 * double(map.bytes());
  std::printf("made of       %s\nby            tilth %s\n", map.origin().source.c_str(), map.origin().program.c_str());
  std::printf("places        %zu on %.1f m of way, %zu loop closures\n", map.places().size(), length, closures);
  std::printf("extent        %.1f x %.1f x %.1f m\n", box.sizes().x(), box.sizes().y(), box.sizes().z());
  std::printf("patches       %zu, all whole\n", patches);
  std::printf("upright cells %zu\n", map.uprights().size());
  std::printf("beams         %s\n", map.beams() ? "corrected" : "as they are");
  std::printf("size          %.1f MB, %.1f MB a km\n", megabytes, 1e3 * megabytes / std::max(length, 1.0));
  return 0;
}

/// Image and description of the floor plan, side by side.
int export_plan(const MapArguments& a) {
  std::filesystem::path image(a.out), text(a.out);
  if (image.extension() != ".pgm" && image.extension() != ".yaml")
    throw Error(a.out, "is no name for a floor plan: it must end with .pgm or .yaml; both are written");
  image.replace_extension(".pgm"), text.replace_extension(".yaml");
  const OccupancyGrid grid = occupancy_of(MapFolder(a.map), with<OccupancyOptions>(a.plan));
  write_plan_image(image, grid);
  write_plan_yaml(text, grid, image.filename().string());
  std::printf("%d x %d cells in %s, %s\n", grid.columns, grid.rows, image.string().c_str(), text.string().c_str());
  return 0;
}

int export_map(const MapArguments& a) {
  const std::string kind = kind_of_file(a.out);
  if (!a.origin.empty() && kind != ".las") throw Error("option origin", "is for a map as .las alone, not for " + a.out);
  if (a.grid) return export_plan(a);
  if (kind == ".pgm" || kind == ".yaml") throw Error(a.out, "is the name of a floor plan: add --grid");
  const MapFolder map(a.map);
  RunRecord record;
  record.map = MapBuilder(with<MapOptions>(a.thinning));
  const auto origin = a.origin.empty() ? std::nullopt : std::optional(parse_utm_origin(a.origin));
  const std::unique_ptr<Sink> sink = map_sink(a.out, origin);
  show_map(map, record);
  sink->finish(record);
  std::printf("%zu points in %s\n", record.map.size(), a.out.c_str());
  return 0;
}

std::vector<Eigen::Vector3d> points_of(const std::string& file) {
  const std::string kind = kind_of_file(file);
  if (kind == ".pcd") return positions_of(read_pcd(file), file);
  if (kind == ".ply") return positions_of(read_ply(file), file);
  if (kind == ".las") return positions_of(read_las(file), file);
  throw Error(file, "is no cloud that can be read: it must end with .pcd, .ply or .las");
}

/// Places one after another have no motion between them that was measured: the graph has none either.
int import_map(const MapArguments& a) {
  MapWriter writer(a.out);
  PoseGraph graph;
  std::vector<Eigen::Vector3d> points = points_of(a.map);
  const Eigen::Vector3d origin = cloud_origin(points);
  std::string source = a.map;
  if (!origin.isZero()) {
    for (Eigen::Vector3d& point : points) point -= origin;
    char shift[64];
    std::snprintf(shift, sizeof shift, "%.0f %.0f 0 m", origin.x(), origin.y());
    std::printf("the map's frame is that of the cloud, less %s\n", shift);
    source += std::string(", less ") + shift;
  }
  make_virtual_places(points, with<VirtualPlaceOptions>(a.places), [&](const VirtualPlace& place) {
    writer.add({.stamp = double(graph.poses.size()), .T_map_lidar = place.T_map_lidar}, place.patches);
    graph.poses.push_back(place.T_map_lidar);
  });
  writer.finish({TILTH_VERSION, source}, graph, std::nullopt);
  std::printf("%zu places in %s\n", graph.poses.size(), a.out.c_str());
  return 0;
}

int merge(const MapArguments& a) {
  const MapFolder map(a.map), later(a.later);
  const auto options = with<LocalizationOptions>(parse_settings(a.settings));
  const MergedMaps merged = merge_maps(map, later, options.localize, a.out);
  std::printf("%zu places of %s found in %s; %zu places replaced, %zu patches gone, %zu places in %s\n", merged.ties,
              a.later.c_str(), a.map.c_str(), merged.replaced, merged.gone, merged.places, a.out.c_str());
  for (const Change& change : merged.changes) {
    const Eigen::Vector3f at = change.box.center(), size = change.box.sizes();
    std::printf("%s at %.2f %.2f %.2f, %.2f x %.2f x %.2f m\n", std::string(name_of(change.stay.kind)).c_str(), at.x(),
                at.y(), at.z(), size.x(), size.y(), size.z());
  }
  return 0;
}

}  // namespace

void add_map(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("map", "What saved maps hold, and files of them for others");
  command->require_subcommand(1);
  const auto a = std::make_shared<MapArguments>();
  CLI::App* info = command->add_subcommand("info", "Check a map as a whole and tell what it holds");
  info->add_option("MAP", a->map, "folder of the map")->required();
  info->callback([a, &exit_code] { exit_code = print_info(*a); });
  CLI::App* exported = command->add_subcommand("export", "Write the points of a map as a cloud, or its floor plan");
  exported->add_option("MAP", a->map, "folder of the map")->required();
  exported->add_option("OUT", a->out, "file to write: .pcd, .ply or .las; with --grid .pgm or .yaml")->required();
  exported->add_flag("--grid", a->grid, "the floor plan instead, as map_server and nav2 read it: .pgm and .yaml");
  exported->add_option("--origin", a->origin, "of a .las: UTM zone,easting,northing,height[,degrees from east to x]");
  add_option_flags(*exported, describe(MapOptions{}), a->thinning);
  add_option_flags(*exported, describe(OccupancyOptions{}), a->plan);
  exported->callback([a, &exit_code] { exit_code = export_map(*a); });
  CLI::App* imported = command->add_subcommand("import", "Make a map of a bare cloud");
  imported->add_option("CLOUD", a->map, "file of points, z up, in metres: .pcd, .ply or .las")->required();
  imported->add_option("--out", a->out, "folder for the map")->required();
  add_option_flags(*imported, describe(VirtualPlaceOptions{}), a->places);
  CLI::App* merged = command->add_subcommand("merge", "Make one map of two that overlap, in the frame of the first");
  merged->add_option("MAP", a->map, "folder of the first map")->required();
  merged->add_option("LATER", a->later, "folder of the map that was made later")->required();
  merged->add_option("--out", a->out, "folder for the map of both; may be one of them")->required();
  add_settings(*merged, a->settings, "options localize.* (see `tilth config`)");
  merged->callback([a, &exit_code] { exit_code = merge(*a); });
  imported->callback([a, &exit_code] { exit_code = import_map(*a); });
}

}  // namespace tilth::app
