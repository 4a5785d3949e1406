#include <tilth/study/filter_figures.hpp>

namespace tilth {
namespace {

void add_features(const std::string& when, const FeatureCounts& features, std::vector<FilterFigure>& figures) {
  figures.push_back({"edge_features_" + when, double(features.edges), true});
  figures.push_back({"plane_features_" + when, double(features.planes), true});
  figures.push_back({"false_edge_features_" + when, double(features.false_edges), true});
  figures.push_back({"false_edge_ratio_" + when, features.false_edge_ratio()});
  figures.push_back({"off_edge_ratio_" + when, features.off_edge_ratio()});
  figures.push_back({"false_feature_ratio_" + when, features.false_ratio()});
}

std::string range_name(std::size_t i) {
  const auto& ends = FilterScore::kRanges;
  if (i == ends.size()) return "beyond_" + std::to_string(int(ends.back())) + "m";
  return "to_" + std::to_string(int(ends[i])) + "m";
}

}  // namespace

std::vector<FilterFigure> figures_of(const FilterScore& score) {
  const KeptCount surface = score.of(PointKind::surface);
  std::vector<FilterFigure> figures{{"scans", double(score.scans), true},
                                    {"surface_points", double(surface.before), true},
                                    {"false_points", double(score.false_points().before), true},
                                    {"removed_outlier", score.of(PointKind::outlier).removed_ratio()},
                                    {"removed_mixed", score.of(PointKind::mixed).removed_ratio()},
                                    {"removed_ghost", score.of(PointKind::ghost).removed_ratio()},
                                    {"removed_obvious", score.obvious.removed_ratio()},
                                    {"removed_moving", score.of(PointKind::moving).removed_ratio()},
                                    {"kept_surface", surface.kept_ratio()},
                                    {"kept_edges", score.edges.kept_ratio()},
                                    {"accuracy", score.accuracy()},
                                    {"precision", score.precision()},
                                    {"pseudo_feature_reduction", score.pseudo_reduction()}};
  for (std::size_t i = 0; i < score.surface_by_range.size(); ++i) {
    figures.push_back({"kept_surface_" + range_name(i), score.surface_by_range[i].kept_ratio()});
  }
  add_features("before", score.features_before, figures);
  add_features("after", score.features_after, figures);
  return figures;
}

}  // namespace tilth
