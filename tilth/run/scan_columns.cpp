#include <numeric>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/run/scan_columns.hpp>

namespace tilth {
namespace {

constexpr std::string_view kWords = "track";  // column that holds no numbers

}  // namespace

ScanColumns read_scan_columns(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  TextLines lines(as_text(bytes));
  std::vector<std::string> names;
  if (const auto header = lines.next()) {
    for (const std::string_view name : words(*header, ",")) names.emplace_back(name);
  }
  std::vector<std::vector<double>> values(names.size());
  while (const auto line = lines.next()) {
    if (line->empty()) continue;
    const std::vector<std::string_view> cells = words(*line, ",");
    if (cells.size() != names.size()) {
      throw Error(lines.where(path.string()),
                  "has " + std::to_string(cells.size()) + " columns, the header " + std::to_string(names.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (names[i] == kWords) continue;
      const std::optional<double> value = to_double(cells[i]);
      if (!value) throw Error(lines.where(path.string()), names[i] + " is no number");
      values[i].push_back(*value);
    }
  }
  ScanColumns columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != kWords) columns[names[i]] = std::move(values[i]);
  }
  return columns;
}

double mean_of(const ScanColumns& columns, const std::string& name) {
  const auto column = columns.find(name);
  if (column == columns.end() || column->second.empty()) return 0;
  return std::accumulate(column->second.begin(), column->second.end(), 0.0) / double(column->second.size());
}

}  // namespace tilth
