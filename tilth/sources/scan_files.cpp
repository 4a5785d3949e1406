#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <numeric>
#include <optional>

#include <tilth/core/error.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/times_file.hpp>
#include <tilth/sources/kitti_raw.hpp>
#include <tilth/sources/listed_times.hpp>
#include <tilth/sources/name_times.hpp>
#include <tilth/sources/scan_files.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;
constexpr double kUsualRate = 10.0;  ///< [Hz]

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// The digits at the front of `text`, taken off it; leading zeros left out.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  std::string_view number = text.substr(0, std::size_t(end - text.begin()));
  text.remove_prefix(number.size());
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

std::vector<std::string> stems_of(const std::vector<fs::path>& files) {
  std::vector<std::string> stems;
  for (const fs::path& file : files) stems.push_back(file.stem().string());
  return stems;
}

/// In natural order, or in that of the times in their names ("9.5" before "9.25" as numbers of files, after it as
/// times).
std::vector<fs::path> scan_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && !is_hidden(entry.path()) && is_scan_file(entry.path()))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  if (const std::optional<NameTimes> named = times_in_names(stems_of(files))) {
    const std::vector<double>& times = named->times;
    std::vector<std::size_t> order(files.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    std::vector<fs::path> by_time;
    for (const std::size_t i : order) by_time.push_back(files[i]);
    return by_time;
  }
  return files;
}

std::string hertz(double rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%g Hz", rate);
  return text;
}

/// Of `count` scans at `rate` [Hz], or at the usual one where that is 0.
ScanStamps nominal_stamps(std::size_t count, double rate) {
  const double hz = rate > 0.0 ? rate : kUsualRate;
  ScanStamps nominal{{}, rate <= 0.0, (rate > 0.0 ? "the given rate of " : "a nominal rate of ") + hertz(hz)};
  for (std::size_t i = 0; i < count; ++i) nominal.stamps.push_back(double(i) / hz);
  return nominal;
}

std::optional<ScanStamps> listed_stamps(const std::vector<fs::path>& files, double rate) {
  const fs::path folder = files.front().parent_path();
  for (const fs::path& list : {folder / "times.txt", folder.parent_path() / "times.txt"}) {
    if (!fs::is_regular_file(list)) continue;
    std::optional<ListedTimes> listed = listed_times(read_times(list), stems_of(files), list.string(), rate);
    if (listed) return ScanStamps{std::move(listed->times), false, "stamps: from " + list.string() + listed->decision};
    ScanStamps nominal = nominal_stamps(files.size(), rate);
    nominal.decision = "stamps: " + list.string() + " tells none, its times do not advance, so " + nominal.decision;
    return nominal;
  }
  return std::nullopt;
}

}  // namespace

bool is_scan_file(const fs::path& path) {
  const std::string extension = kind_of_file(path);
  return extension == ".pcd" || extension == ".ply" || extension == ".bin";
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view na = take_number(a), nb = take_number(b);
      if (na.size() != nb.size()) return na.size() < nb.size();
      if (na != nb) return na < nb;
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.empty() == b.empty() ? whole_a < whole_b : a.empty();
}

std::vector<fs::path> find_scan_files(const fs::path& folder) {
  constexpr std::array<const char*, 4> places{"", "scans", "clouds", "velodyne"};
  try {
    for (const char* place : places) {
      if (!fs::is_directory(folder / place)) continue;
      std::vector<fs::path> files = scan_files_in(folder / place);
      if (!files.empty()) return files;
    }
    if (const std::optional<fs::path> raw = kitti_raw_scans(folder)) {
      if (std::vector<fs::path> files = scan_files_in(*raw); !files.empty()) return files;
    }
    if (fs::is_empty(folder)) throw Error(folder.string(), "the folder is empty");
  } catch (const fs::filesystem_error& error) {
    throw Error(folder.string(), error.code().message());
  }
  throw Error(folder.string(),
              "no .pcd, .ply or .bin scans, neither in it nor in scans/, clouds/, velodyne/ or velodyne_points/data/");
}

ScanStamps stamps_of(const std::vector<fs::path>& files, double rate) {
  if (std::optional<ScanStamps> listed = listed_stamps(files, rate)) return *listed;
  if (std::optional<ScanStamps> dated = kitti_raw_stamps(files)) return *dated;
  if (std::optional<NameTimes> named = times_in_names(stems_of(files)))
    return {std::move(named->times), false, std::move(named->decision)};
  ScanStamps nominal = nominal_stamps(files.size(), rate);
  nominal.decision = "stamps: no times.txt and the names are no times, so " + nominal.decision;
  return nominal;
}

}  // namespace tilth
