#include <algorithm>

#include <tilth/report/run_sections.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/level_floor.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostSkipped = 50;

Table changed_options(const RunRecord& record) {
  Table table{"Options that differ from the defaults", {"option", "value", "default", "unit", "meaning"}, {}, false};
  for (const OptionInfo& option : record.options) {
    const auto standard = std::find_if(record.defaults.begin(), record.defaults.end(),
                                       [&](const OptionInfo& other) { return other.key == option.key; });
    const bool known = standard != record.defaults.end();
    if (known && standard->value == option.value) continue;
    table.rows.push_back({option.key, option.value, known ? standard->value : "", option.unit, option.meaning});
  }
  if (table.rows.empty()) table.rows.push_back({"none", "", "", "", ""});
  return table;
}

Table run_table(const RunRecord& record) {
  Table table{"The run", {"", ""}, {}, false};
  table.rows = {{"source", record.source},
                {"pipeline", record.pipeline},
                {"ended", record.ended},
                {"Tilth", record.version},
                {"poses of", body_of(record.T_base_lidar)},
                {"machine", record.machine}};
  if (record.floor) table.rows.push_back({"levelled", floor_sentence(*record.floor)});
  return table;
}

Table decisions_table(const RunRecord& record) {
  Table table{"What was worked out of the data", {""}, {}, false};
  for (const std::string& decision : record.decisions) table.rows.push_back({decision});
  return table;
}

Table skipped_table(const RunRecord& record) {
  Table table{"Records without a pose", {"number", "where", "why"}, {}, false};
  for (const SkippedScan& s : record.skipped) {
    if (table.rows.size() == kMostSkipped) break;
    table.rows.push_back({std::to_string(s.index), s.where, s.what});
  }
  if (record.skipped.size() > kMostSkipped) {
    table.rows.push_back({"", "", std::to_string(record.skipped.size() - kMostSkipped) + " more in summary.json"});
  }
  return table;
}

}  // namespace

Section setup_section(const RunRecord& record) {
  Section section{"setup", "Input and options", "", {run_table(record), changed_options(record)}, {}};
  if (!record.decisions.empty()) section.tables.push_back(decisions_table(record));
  if (!record.skipped.empty()) section.tables.push_back(skipped_table(record));
  return section;
}

}  // namespace tilth
