#include <chrono>
#include <optional>

#include <tilth/core/error.hpp>
#include <tilth/io/date_times_file.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

/// [s] since 1970 of the date.
std::optional<double> days_in(std::string_view date) {
  const std::vector<std::string_view> parts = words(date, "-/");
  if (parts.size() != 3) return std::nullopt;
  const auto year = to_count(parts[0]), month = to_count(parts[1]), day = to_count(parts[2]);
  if (!year || !month || !day || *year > 9999 || *month > 12 || *day > 31) return std::nullopt;
  const std::chrono::year_month_day civil{std::chrono::year(int(*year)), std::chrono::month(unsigned(*month)),
                                          std::chrono::day(unsigned(*day))};
  if (!civil.ok()) return std::nullopt;
  return 86400.0 * double(std::chrono::sys_days(civil).time_since_epoch().count());
}

/// [s] since midnight.
std::optional<double> time_of_day(std::string_view clock) {
  const std::vector<std::string_view> parts = words(clock, ":");
  if (parts.size() != 3) return std::nullopt;
  const auto hour = to_count(parts[0]), minute = to_count(parts[1]);
  const auto second = to_double(parts[2]);
  if (!hour || !minute || !second || *hour > 23 || *minute > 59 || !(*second >= 0.0 && *second < 61.0))
    return std::nullopt;
  return 3600.0 * double(*hour) + 60.0 * double(*minute) + *second;
}

}  // namespace

std::vector<double> parse_date_times(std::string_view text, const std::string& name) {
  std::vector<double> times;
  TextLines lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::vector<std::string_view> parts = words(*line);
    if (parts.empty()) continue;
    const std::optional<double> days = parts.size() == 2 ? days_in(parts[0]) : std::nullopt;
    const std::optional<double> seconds = days ? time_of_day(parts[1]) : std::nullopt;
    if (!seconds) {
      throw Error(lines.where(name),
                  "'" + std::string(line->substr(0, 40)) + "' is no date and time such as 2011-09-26 13:02:25.95");
    }
    times.push_back(*days + *seconds);
  }
  if (times.empty()) throw Error(name, "holds no times");
  return times;
}

std::vector<double> read_date_times(const std::filesystem::path& path) {
  return parse_date_times(as_text(read_file(path)), path.string());
}

}  // namespace tilth
