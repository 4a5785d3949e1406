// Scans of an HDL-64E as range images, the format of the recordings of F. Moosmann (Karlsruhe): a PNG a scan with a
// beam a row and steps of 2 mm, angles in img.cfg, GPS/INS in imu.cfg, the car itself in mask.png.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <png.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <tilth/core/scan.hpp>

namespace tilth {

struct RangeImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> values;  ///< row by row
};

inline RangeImage read_png(const std::filesystem::path& path, std::uint32_t format) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) throw std::runtime_error(path.string() + png.message);
  png.format = format;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0)
    throw std::runtime_error(path.string() + png.message);
  RangeImage image{png.width, png.height, {}};
  const std::size_t size = PNG_IMAGE_PIXEL_COMPONENT_SIZE(format);
  for (std::size_t i = 0; i < bytes.size(); i += size)
    image.values.push_back(size == 1 ? bytes[i] : std::uint16_t(bytes[i] + 256 * bytes[i + 1]));
  return image;
}

/// The numbers of a line, between semicolons.
inline std::vector<double> numbers(const std::string& line) {
  std::istringstream text(line);
  std::vector<double> values;
  for (std::string cell; std::getline(text, cell, ';');) values.push_back(std::atof(cell.c_str()));
  return values;
}

/// The lines of a text file that begin with `start`.
inline std::vector<std::string> lines_of(const std::filesystem::path& path, const std::string& start) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(start)) lines.push_back(line);
  }
  return lines;
}

struct GpsPose {
  double stamp;              ///< [s] of the day
  Eigen::Vector3d position;  ///< [m]
};

inline std::vector<GpsPose> gps_of(const std::filesystem::path& folder) {
  std::vector<GpsPose> poses;
  for (const std::string& line : lines_of(folder / "imu.cfg", "20")) {
    int hour = 0, minute = 0;
    double second = 0;
    std::sscanf(line.c_str(), "%*d-%*d-%*d %d:%d:%lf", &hour, &minute, &second);
    const std::vector<double> v = numbers(line);
    poses.push_back({3600 * hour + 60 * minute + second, {v.at(14), v.at(15), v.at(16)}});
  }
  return poses;
}

/// Reads the `index`-th scan; its first column is behind the car, and its time `period` [s] before the end of the last.
class RangeImages {
 public:
  explicit RangeImages(std::filesystem::path folder)
      : folder_(std::move(folder)), mask_(read_png(folder_ / "mask.png", PNG_FORMAT_GRAY)) {
    const std::string sizes = std::to_string(mask_.width) + ';';
    const std::vector<double> angles = numbers(lines_of(folder_ / "img.cfg", sizes).at(0));
    for (std::size_t row = 0; row < mask_.height; ++row)
      elevations_.push_back(-angles.at(4 + row) * std::numbers::pi / 180);
  }

  Scan scan(std::size_t index, double stamp, double period) const {
    constexpr double kStep = 0.002, kLeast = 0.9;  // [m]
    char name[32];
    std::snprintf(name, sizeof name, "scan%05zu.png", index);
    const RangeImage image = read_png(folder_ / name, PNG_FORMAT_LINEAR_Y);
    Scan scan{stamp, {}};
    for (std::size_t column = 0; column < image.width; ++column) {
      const double ratio = (double(column) + 0.5) / image.width, azimuth = std::numbers::pi * (1 - 2 * ratio);
      for (std::size_t row = 0; row < image.height; ++row) {
        const double range = kStep * image.values[row * image.width + column], elevation = elevations_[row];
        if (range < kLeast || mask_.values[row * image.width + column] == 0) continue;
        scan.cloud.points.emplace_back(range * std::cos(elevation) * std::cos(azimuth),
                                       range * std::cos(elevation) * std::sin(azimuth), range * std::sin(elevation));
        scan.cloud.times.push_back(float(double(column) / image.width * period));
        scan.cloud.rings.push_back(std::uint16_t(image.height - 1 - row));
      }
    }
    return scan;
  }

 private:
  std::filesystem::path folder_;
  RangeImage mask_;
  std::vector<double> elevations_;  // [rad] of the rows
};

}  // namespace tilth
