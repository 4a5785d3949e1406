#include <array>

#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/run/scan_columns.hpp>
#include <tilth/study/sweep.hpp>

namespace tilth {
namespace {

/// Shares of score.json that are shown in percent.
constexpr std::array<std::array<const char*, 2>, 6> kRatios{{{"removed_obvious", "removed_obvious_percent"},
                                                             {"kept_edges", "kept_edges_percent"},
                                                             {"kept_surface", "kept_surface_percent"},
                                                             {"accuracy", "filter_accuracy_percent"},
                                                             {"pseudo_feature_reduction", "pseudo_reduction_percent"},
                                                             {"false_edge_ratio_after", "pseudo_ratio_percent"}}};

void take_scans(const std::filesystem::path& file, StudyFigures& figures) {
  const ScanColumns columns = read_scan_columns(file);
  const double points = mean_of(columns, "points_in");
  if (points > 0) figures["removed_percent"] = 100 * mean_of(columns, "outliers") / points;
  figures["edges"] = mean_of(columns, "edges");
  figures["planes"] = mean_of(columns, "planes");
  figures["outliers_ms"] = mean_of(columns, "ms_outliers");
}

void take_score(const std::filesystem::path& file, StudyFigures& figures) {
  const std::vector<std::byte> bytes = read_file(file);
  try {
    const nlohmann::json score = nlohmann::json::parse(as_text(bytes)).at(0);
    for (const auto& [name, key] : kRatios) figures[key] = 100 * score.at(name).get<double>();
  } catch (const nlohmann::json::exception& e) {
    throw Error(file.string(), std::string("is no score: ") + e.what());
  }
}

}  // namespace

StudyFigures study_figures(const std::filesystem::path& folder) {
  StudyFigures figures;
  if (std::filesystem::exists(folder / "scans.csv")) take_scans(folder / "scans.csv", figures);
  if (std::filesystem::exists(folder / "score.json")) take_score(folder / "score.json", figures);
  return figures;
}

}  // namespace tilth
