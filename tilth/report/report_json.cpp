#include <algorithm>
#include <bit>

#include <nlohmann/json.hpp>

#include <tilth/evaluation/distribution.hpp>
#include <tilth/plot/curve_thinning.hpp>
#include <tilth/report/report_json.hpp>

namespace tilth {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPoints = 20'000;  // of a curve
static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

/// Arrays that the rest refers to by number; equal ones (the time axis of every curve) are kept once.
class Arrays {
 public:
  std::size_t number_of(std::vector<float> values) {
    const auto found = std::find(all_.begin(), all_.end(), values);
    if (found != all_.end()) return std::size_t(found - all_.begin());
    all_.push_back(std::move(values));
    return all_.size() - 1;
  }

  Json json() const {
    Json list = Json::array();
    for (const std::vector<float>& values : all_) {
      list.push_back(base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)}));
    }
    return list;
  }

 private:
  std::vector<std::vector<float>> all_;
};

Json axis_json(const Axis& axis) {
  return {{"label", axis.label}, {"unit", axis.unit}};
}

const char* name_of(PlotKind kind) {
  switch (kind) {
    case PlotKind::lines: return "lines";
    case PlotKind::path: return "path";
    case PlotKind::boxes: return "boxes";
    case PlotKind::bars: return "bars";
    case PlotKind::histogram: return "histogram";
    case PlotKind::heat: return "heat";
  }
  return "";
}

Json box_json(const BoxFigures& box) {
  return {{"p01", box.p01}, {"q1", box.q1},   {"median", box.median},
          {"q3", box.q3},   {"p99", box.p99}, {"mean", box.mean}};
}

Json curve_json(const Curve& whole, PlotKind kind, Arrays& arrays) {
  if (kind == PlotKind::boxes) return {{"name", whole.name}, {"box", box_json(box_figures(whole.y))}};
  const Curve curve = thinned(whole, kMostPoints, kind);
  Json json{{"name", curve.name}, {"y", arrays.number_of(curve.y)}};
  if (!curve.x.empty()) json["x"] = arrays.number_of(curve.x);
  if (curve.truth) json["truth"] = true;
  if (curve.behind) json["behind"] = true;
  if (!curve.shade.empty()) json["shade"] = arrays.number_of(curve.shade);
  return json;
}

/// Points of a path that stand for themselves: none is left out.
Json places_json(const Curve& places, Arrays& arrays) {
  return {{"name", places.name}, {"x", arrays.number_of(places.x)}, {"y", arrays.number_of(places.y)}};
}

Json plot_json(const Plot& plot, Arrays& arrays) {
  Json json{{"kind", name_of(plot.kind)}, {"title", plot.title}, {"x", axis_json(plot.x)}, {"y", axis_json(plot.y)}};
  if (!plot.shade.label.empty()) json["shade"] = axis_json(plot.shade);
  json["over_time"] = plot.over_time;
  json["categories"] = plot.categories;
  json["curves"] = Json::array();
  for (const Curve& curve : plot.curves) json["curves"].push_back(curve_json(curve, plot.kind, arrays));
  json["marks"] = Json::array();
  for (const Mark& mark : plot.marks) json["marks"].push_back({{"name", mark.name}, {"value", mark.value}});
  for (const auto& [name, places] : {std::pair("links", &plot.links), std::pair("dots", &plot.dots)}) {
    if (*places) json[name] = places_json(**places, arrays);
  }
  if (plot.alarm) json["alarm"] = {{"name", plot.alarm->name}, {"spans", plot.alarm->spans}};
  if (plot.band) json["band"] = {{"name", plot.band->name}, {"low", plot.band->low}, {"high", plot.band->high}};
  return json;
}

Json path_json(const MapPath& path, double start, Arrays& arrays) {
  std::vector<float> columns[8];  // t x y z qx qy qz qw
  for (const StampedPose& pose : path.poses) {
    const Eigen::Vector3d p = pose.T_world_lidar.translation();
    const Eigen::Quaterniond q(pose.T_world_lidar.rotation());
    const double values[8] = {pose.stamp - start, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
    for (std::size_t i = 0; i < 8; ++i) columns[i].push_back(float(values[i]));
  }
  Json json{{"name", path.name}, {"truth", path.truth}};
  const char* const names[8] = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
  for (std::size_t i = 0; i < 8; ++i) json[names[i]] = arrays.number_of(std::move(columns[i]));
  return json;
}

Json layer_json(const PackedLayer& layer) {
  return {{"count", layer.count}, {"x", base64(layer.x)},       {"y", base64(layer.y)},
          {"z", base64(layer.z)}, {"scan", base64(layer.scan)}, {"intensity", base64(layer.intensity)}};
}

/// With its first layer, where it has points.
Json points_json(const PackedMap& points) {
  Json json{{"count", points.count},
            {"total", points.total},
            {"origin", points.origin},
            {"step", points.step},
            {"max_intensity", points.max_intensity},
            {"scans_per_number", points.scans_per_number}};
  if (!points.layers.empty()) json["first"] = layer_json(points.layers.front());
  return json;
}

Json map_json(const MapView& map, Arrays& arrays) {
  Json json = points_json(map.points);
  if (!map.moving.layers.empty()) json["moving"] = points_json(map.moving);
  const bool empty = map.paths.empty() || map.paths.front().poses.empty();
  const double start = empty ? 0.0 : map.paths.front().poses.front().stamp;
  json["paths"] = Json::array();
  for (const MapPath& path : map.paths) json["paths"].push_back(path_json(path, start, arrays));
  json["keyframes"] = map.keyframes;
  json["closures"] = map.closures;
  return json;
}

}  // namespace

std::string report_json(const Report& report) {
  Arrays arrays;
  Json plots = Json::object();
  for (const Section& section : report.sections) {
    for (const Plot& plot : section.plots) plots[plot.id] = plot_json(plot, arrays);
  }
  Json json{{"title", report.title}, {"plots", std::move(plots)}};
  if (report.map) json["map"] = map_json(*report.map, arrays);
  json["arrays"] = arrays.json();
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

std::vector<std::string> later_layers_json(const Report& report) {
  std::vector<std::string> layers;
  if (!report.map) return layers;
  const std::vector<PackedLayer>& all = report.map->points.layers;
  for (std::size_t i = 1; i < all.size(); ++i) layers.push_back(layer_json(all[i]).dump());
  return layers;
}

}  // namespace tilth
