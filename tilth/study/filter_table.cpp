#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

#include <tilth/study/filter_report.hpp>

namespace tilth {
namespace {

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[256];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return std::string(text) + "\n";
}

std::string count_row(const char* name, const KeptCount& count) {
  if (count.before == 0) return line("  %-34s %9s", name, "none");
  return line("  %-34s %9zu %9.2f %9.2f", name, count.before, 100 * count.removed_ratio(), 100 * count.kept_ratio());
}

std::string range_rows(const FilterScore& score) {
  static constexpr std::array<const char*, 6> kNames{"surface, nearer than 2 m", "surface, 2 to 5 m",
                                                     "surface, 5 to 10 m",       "surface, 10 to 20 m",
                                                     "surface, 20 to 40 m",      "surface, farther"};
  std::string text;
  for (std::size_t i = 0; i < kNames.size(); ++i) text += count_row(kNames[i], score.surface_by_range[i]);
  return text;
}

std::string feature_rows(const FilterScore& score) {
  const auto row = [](const char* name, const FeatureCounts& f) {
    return line("  %-34s %9zu %9.2f %9.2f %9zu %9.2f", name, f.edges, 100 * f.false_edge_ratio(),
                100 * f.off_edge_ratio(), f.planes, 100 * f.false_ratio());
  };
  return line("  %-34s %9s %9s %9s %9s %9s", "features", "edges", "false %", "off edge%", "planes", "all false%") +
         row("before the filter", score.features_before) + row("after the filter", score.features_after);
}

std::string claim_row(const char* claim, double figure, double bound) {
  return line("  %-52s %9.2f   %s", claim, 100 * figure, figure > bound ? "holds" : "does not hold");
}

std::string claim_rows(const FilterScore& s) {
  return line("  %-52s %9s", "claims of the paper, section 2.3", "%") +
         claim_row("over 95 % of the points judged rightly", s.accuracy(), 0.95) +
         claim_row("over 90 % of the outliers removed", s.of(PointKind::outlier).removed_ratio(), 0.90) +
         claim_row("over 90 % of the obvious outliers removed", s.obvious.removed_ratio(), 0.90) +
         claim_row("over 92 % of the edge structures kept", s.edges.kept_ratio(), 0.92) +
         claim_row("over 90 % fewer pseudo-features", s.pseudo_reduction(), 0.90) +
         claim_row("over 95 % of the features true", 1 - s.features_after.false_ratio(), 0.95) +
         line("  %-52s %9.2f", "share of what was removed that is false (precision)", 100 * s.precision());
}

std::string value_of(const FilterTrial& trial, const std::string& key) {
  const auto found = std::find_if(trial.options.begin(), trial.options.end(),
                                  [&](const OptionInfo& option) { return option.key == key; });
  return found == trial.options.end() ? "?" : found->value;
}

std::string last_word(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

}  // namespace

std::string filter_table(const FilterTrial& trial) {
  const FilterScore& s = trial.score;
  std::string text = line("%s: %zu scans, outliers.method = %s", trial.recording.c_str(), s.scans,
                          value_of(trial, "outliers.method").c_str());
  text += line("  %-34s %9s %9s %9s", "points", "count", "removed %", "kept %");
  text += count_row("isolated outliers", s.of(PointKind::outlier)) + count_row("mixed pixels", s.of(PointKind::mixed)) +
          count_row("obvious ones of both, 0.3 m clear", s.obvious) +
          count_row("ghosts (mirrors)", s.of(PointKind::ghost)) +
          count_row("moving (people, doors)", s.of(PointKind::moving)) +
          count_row("surface", s.of(PointKind::surface)) + count_row("surface, on edge structures", s.edges);
  return text + range_rows(s) + feature_rows(s) + claim_rows(s);
}

std::string filter_sweep_table(std::span<const FilterTrial> trials, std::span<const std::string> columns) {
  std::string text = "recording ";
  for (const std::string& column : columns) text += line("%11s", last_word(column).c_str()).substr(0, 11);
  text += line(" |%9s%9s%9s%9s%9s |%9s%9s%9s |%9s%9s", "outlier-", "mixed-", "obvious-", "ghost-", "moving-",
               "surface+", "edges+", "accuracy", "pseudo", "false");
  for (const FilterTrial& t : trials) {
    const FilterScore& s = t.score;
    text += line("%-10.10s", t.recording.c_str()).substr(0, 10);
    for (const std::string& column : columns) text += line("%11.10s", value_of(t, column).c_str()).substr(0, 11);
    text +=
        line(" |%9.2f%9.2f%9.2f%9.2f%9.2f |%9.2f%9.2f%9.2f |%9.2f%9.2f", 100 * s.of(PointKind::outlier).removed_ratio(),
             100 * s.of(PointKind::mixed).removed_ratio(), 100 * s.obvious.removed_ratio(),
             100 * s.of(PointKind::ghost).removed_ratio(), 100 * s.of(PointKind::moving).removed_ratio(),
             100 * s.of(PointKind::surface).kept_ratio(), 100 * s.edges.kept_ratio(), 100 * s.accuracy(),
             100 * s.features_after.false_edge_ratio(), 100 * s.features_after.false_ratio());
  }
  return text +
         "-: removed, +: kept, pseudo: false ones among the edge features, false: among all features; all in %\n";
}

}  // namespace tilth
