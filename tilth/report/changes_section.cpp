#include <cstdio>

#include <tilth/report/run_sections.hpp>

namespace tilth {
namespace {

std::string numbers(const char* format, const Eigen::Vector3f& v) {
  char text[96];
  std::snprintf(text, sizeof text, format, v.x(), v.y(), v.z());
  return text;
}

std::string seconds(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", time);
  return text;
}

}  // namespace

Section changes_section(const RunRecord& record) {
  const std::vector<Change> changes = record.map.changes();
  const double begin = record.trajectory.empty() ? 0 : record.trajectory.front().stamp;
  Table table{"Things", {"change", "place [m]", "extent [m]", "first seen", "last seen"}, {}, false};
  for (const Change& change : changes) {
    table.rows.push_back({std::string(name_of(change.stay.kind)), numbers("%.2f %.2f %.2f", change.box.center()),
                          numbers("%.2f x %.2f x %.2f", change.box.sizes()), seconds(change.stay.first_seen - begin),
                          seconds(change.stay.last_seen - begin)});
  }
  Section section{
      "changes", "What left or came while it was mapped", "Nothing that stood for a while left or came.", {}, {}};
  if (changes.empty()) return section;
  section.note = "The map shows the newest state: without what left, with what came.";
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace tilth
