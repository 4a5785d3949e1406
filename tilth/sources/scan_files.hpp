// The scan files of a folder and their stamps.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tilth {

/// .pcd, .ply or .bin, in upper or lower case.
bool is_scan_file(const std::filesystem::path& path);

/// "9" before "10": runs of digits compare as numbers.
bool natural_less(std::string_view a, std::string_view b);

/// The scan files of `folder`, or of its scans/, clouds/ or velodyne/, or of a raw recording of KITTI, in natural
/// order; hidden files ("._scan.pcd") are none. Throws Error where there are none.
std::vector<std::filesystem::path> find_scan_files(const std::filesystem::path& folder);

struct ScanStamps {
  std::vector<double> stamps;  ///< [s] one a file
  bool nominal = false;        ///< nobody recorded them: they count from 0 at a stated rate
  std::string decision;
};

/// Stamps from times.txt beside the files or in the folder above (see listed_times.hpp), else KITTI's timestamps.txt,
/// else from their names where those are times (see name_times.hpp), else at `rate` [Hz] or, where that is 0, 10 Hz.
/// Throws Error where the list is much shorter than the files or a line is no number.
ScanStamps stamps_of(const std::vector<std::filesystem::path>& files, double rate);

}  // namespace tilth
