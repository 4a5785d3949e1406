#include <algorithm>
#include <functional>
#include <numeric>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/run/scan_columns.hpp>

namespace tilth {
namespace {

constexpr std::string_view kTrack = "track";  // column that holds no numbers

using Cells = std::vector<std::string_view>;

/// Calls `f` for every row with its cells, as many as there are names, and where it stands; returns the names.
std::vector<std::string> for_each_row(
    const std::filesystem::path& path,
    const std::function<void(const std::vector<std::string>& names, const Cells&, const std::string& where)>& f) {
  const std::vector<std::byte> bytes = read_file(path);
  TextLines lines(as_text(bytes));
  std::vector<std::string> names;
  if (const auto header = lines.next()) {
    for (const std::string_view name : words(*header, ",")) names.emplace_back(name);
  }
  while (const auto line = lines.next()) {
    if (line->empty()) continue;
    const Cells cells = words(*line, ",");
    if (cells.size() != names.size()) {
      throw Error(lines.where(path.string()),
                  "has " + std::to_string(cells.size()) + " columns, the header " + std::to_string(names.size()));
    }
    f(names, cells, lines.where(path.string()));
  }
  return names;
}

TrackState state_of(std::string_view word, const std::string& where) {
  const auto names = names_of(TrackState{});
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end())
    throw Error(where, "has the track '" + std::string(word) + "', which is no state of a track");
  return TrackState(found - names.begin());
}

}  // namespace

ScanColumns read_scan_columns(const std::filesystem::path& path) {
  std::vector<std::vector<double>> values;
  const std::vector<std::string> names =
      for_each_row(path, [&](const std::vector<std::string>& of, const Cells& cells, const std::string& where) {
        values.resize(of.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
          if (of[i] == kTrack) continue;
          const std::optional<double> value = to_double(cells[i]);
          if (!value) throw Error(where, of[i] + " is no number");
          values[i].push_back(*value);
        }
      });
  values.resize(names.size());
  ScanColumns columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != kTrack) columns[names[i]] = std::move(values[i]);
  }
  return columns;
}

std::vector<TrackState> read_track_states(const std::filesystem::path& path) {
  std::vector<TrackState> states;
  const std::vector<std::string> names =
      for_each_row(path, [&](const std::vector<std::string>& of, const Cells& cells, const std::string& where) {
        const auto track = std::find(of.begin(), of.end(), kTrack);
        if (track != of.end()) states.push_back(state_of(cells[std::size_t(track - of.begin())], where));
      });
  if (std::find(names.begin(), names.end(), kTrack) == names.end())
    throw Error(path.string(), "has no column " + std::string(kTrack) + ": is it the table of a run?");
  return states;
}

double mean_of(const ScanColumns& columns, const std::string& name) {
  const auto column = columns.find(name);
  if (column == columns.end() || column->second.empty()) return 0;
  return std::accumulate(column->second.begin(), column->second.end(), 0.0) / double(column->second.size());
}

}  // namespace tilth
