#include <cstdio>

#include <tilth/io/output_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/run/change_record.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {
namespace {

std::string line_of(const Change& change) {
  const Eigen::Vector3f center = change.box.center(), size = change.box.sizes();
  char place[160];
  std::snprintf(place, sizeof place, ",%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%zu,", center.x(), center.y(), center.z(),
                size.x(), size.y(), size.z(), change.points);
  return std::string(name_of(change.stay.kind)) + place + exact_text(change.stay.first_seen) + ',' +
         exact_text(change.stay.last_seen) + '\n';
}

}  // namespace

void write_changes(const std::filesystem::path& path, std::span<const Change> changes) {
  std::string text = "change,x,y,z,size_x,size_y,size_z,points,first_seen,last_seen\n";
  for (const Change& change : changes) text += line_of(change);
  write_text(path, text);
}

std::unique_ptr<Sink> changes_sink(const std::filesystem::path& path) {
  return file_sink(path,
                   [](const std::filesystem::path& to, const RunRecord& run) { write_changes(to, run.map.changes()); });
}

}  // namespace tilth
