#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/io/bin_columns.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSample = 2000;  ///< points, each with the one after it
constexpr std::size_t kFewest = 20;    ///< points that tell columns
constexpr std::size_t kMostColumns = 8;
constexpr double kFarthest = 1e6;       ///< of a coordinate, in whatever unit
constexpr double kFewNegative = 0.005;  ///< of the values of a column beside x y z
constexpr double kSomeNegative = 0.1;   ///< of the intensities of four columns, where nothing else fits
constexpr double kFlatter = 0.5;        ///< of the spread of x and y: that of z, where there are three columns
constexpr double kLargestRing = 1023.0;
constexpr std::size_t kMostRings = 256;
constexpr double kFollows = 0.05;    ///< of the spread of a time: from point to point
constexpr double kMostFollow = 0.8;  ///< of the points

/// Values of one column at evenly spread points, and at the points after these.
struct Column {
  std::vector<double> values, next;
};

float float_at(std::span<const std::byte> bytes, std::size_t i) {
  float value = 0.0F;
  std::memcpy(&value, bytes.data() + i * sizeof(float), sizeof(float));
  return value;
}

std::vector<Column> columns_of(std::span<const std::byte> bytes, std::size_t columns) {
  const std::size_t points = bytes.size() / sizeof(float) / columns;
  const std::size_t step = stride_of(points, kSample) | 1U;  // odd, so that no parity is favoured
  std::vector<Column> all(columns);
  for (std::size_t i = 0; i + 1 < points; i += step) {
    for (std::size_t c = 0; c < columns; ++c) {
      all[c].values.push_back(float_at(bytes, i * columns + c));
      all[c].next.push_back(float_at(bytes, (i + 1) * columns + c));
    }
  }
  return all;
}

double ratio_of(const std::vector<double>& values, const auto& holds) {
  return double(std::count_if(values.begin(), values.end(), holds)) / double(values.size());
}

double negative(const Column& column) {
  return ratio_of(column.values, [](double v) { return v < 0.0; });
}

double spread(const Column& column) {
  std::vector<double> finite;
  std::copy_if(column.values.begin(), column.values.end(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  if (finite.empty()) return 0.0;
  std::sort(finite.begin(), finite.end());
  return finite[finite.size() * 95 / 100] - finite[finite.size() * 5 / 100];
}

/// Coordinates may be NaN, but not enormous.
bool has_coordinates(const std::vector<Column>& columns) {
  return std::all_of(columns.begin(), columns.begin() + 3, [](const Column& column) {
    return ratio_of(column.values, [](double v) { return !(std::abs(v) > kFarthest); }) > 1.0 - kFewNegative;
  });
}

bool is_ring(const Column& column) {
  const std::set<double> distinct(column.values.begin(), column.values.end());
  return distinct.size() > 1 && distinct.size() <= kMostRings &&
         std::all_of(distinct.begin(), distinct.end(),
                     [](double v) { return v >= 0.0 && v <= kLargestRing && v == std::floor(v); });
}

bool is_time(const Column& column) {
  const double most = kFollows * spread(column);
  std::size_t follow = 0;
  for (std::size_t i = 0; i < column.values.size(); ++i) follow += std::abs(column.next[i] - column.values[i]) <= most;
  return most > 0.0 && double(follow) > kMostFollow * double(column.values.size());
}

bool fits(std::span<const std::byte> bytes, std::size_t count, double most_negative) {
  if (bytes.size() % (count * sizeof(float)) != 0) return false;
  const std::vector<Column> columns = columns_of(bytes, count);
  if (!has_coordinates(columns)) return false;
  if (count == 3) return spread(columns[2]) < kFlatter * std::min(spread(columns[0]), spread(columns[1]));
  if (spread(columns[0]) == 0.0 || spread(columns[1]) == 0.0) return false;
  std::size_t times = 0;  // which may count back from the end of a scan
  return std::all_of(columns.begin() + 3, columns.end(), [&](const Column& column) {
    return negative(column) <= most_negative || (&column != &columns[3] && is_time(column) && ++times == 1);
  });
}

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names{"x", "y", "z"};
  if (columns.size() > 3) names.emplace_back("intensity");
  bool ring = false, time = false;
  for (std::size_t c = 4; c < columns.size(); ++c) {
    if (!ring && is_ring(columns[c])) {
      ring = true;
      names.emplace_back("ring");
    } else if (!time && is_time(columns[c])) {
      time = true;
      names.emplace_back("time");
    } else {
      names.push_back("column" + std::to_string(c + 1));
    }
  }
  return names;
}

}  // namespace

std::optional<std::vector<std::string>> bin_columns(std::span<const std::byte> bytes) {
  constexpr std::size_t four = 4 * sizeof(float);
  if (bytes.size() < kFewest * four) {
    if (bytes.size() % four != 0) return std::nullopt;
    return std::vector<std::string>{"x", "y", "z", "intensity"};
  }
  for (std::size_t count = kMostColumns; count > 3; --count) {
    if (fits(bytes, count, kFewNegative)) return names_of(columns_of(bytes, count));
  }
  if (fits(bytes, 4, kSomeNegative)) return names_of(columns_of(bytes, 4));
  if (fits(bytes, 3, 0.0)) return names_of(columns_of(bytes, 3));
  return std::nullopt;
}

}  // namespace tilth
