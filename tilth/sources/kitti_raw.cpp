#include <charconv>

#include <tilth/core/error.hpp>
#include <tilth/io/date_times_file.hpp>
#include <tilth/sources/kitti_raw.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

/// The number that a name is, if it is one.
std::optional<std::size_t> number_of(const fs::path& file) {
  const std::string name = file.stem().string();
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc{} && end == name.data() + name.size() ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<fs::path> kitti_raw_scans(const fs::path& folder) {
  for (const fs::path& place : {folder / "velodyne_points" / "data", folder / "data"}) {
    if (fs::is_directory(place)) return place;
  }
  std::vector<fs::path> drives;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (fs::is_directory(entry.path() / "velodyne_points" / "data")) drives.push_back(entry.path());
  }
  if (drives.size() > 1) {
    throw Error(folder.string(), "holds several drives, " + drives.front().filename().string() + " and " +
                                     std::to_string(drives.size() - 1) + " more: name one of these folders");
  }
  return drives.empty() ? std::nullopt : std::optional(drives.front() / "velodyne_points" / "data");
}

std::optional<ScanStamps> kitti_raw_stamps(const std::vector<fs::path>& files) {
  const fs::path list = files.front().parent_path().parent_path() / "timestamps.txt";
  if (!fs::is_regular_file(list)) return std::nullopt;
  const std::vector<double> times = read_date_times(list);
  ScanStamps stamps{{}, false, "stamps: from " + list.string() + ", by the numbers of the files"};
  for (const fs::path& file : files) {
    const std::optional<std::size_t> number = number_of(file);
    if (!number || *number >= times.size())
      throw Error(list.string(),
                  "has " + std::to_string(times.size()) + " times, none for " + file.filename().string());
    stamps.stamps.push_back(times[*number]);
  }
  return stamps;
}

}  // namespace tilth
