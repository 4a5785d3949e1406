// A map packed for a page: thinned, quantised, put into Morton order (G. M. Morton, 1966) so that neighbours follow one
// another, differences of neighbours split into planes of bytes, deflated (RFC 1950). In layers, each an even thinning
// of the whole, so that a page can show the first while it unpacks the others. docs/report.md describes each stream.
// O(n log n).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tilth/run/map_builder.hpp>

namespace tilth {

struct PackedLayer {
  std::size_t count = 0;      ///< points
  std::string x, y, z, scan;  ///< zlib streams: `count` zigzag differences, low bytes, then high bytes
  std::string intensity;      ///< zlib stream: `count` bytes
};

struct PackedMap {
  std::size_t count = 0;               ///< points of all layers
  std::size_t total = 0;               ///< points of the map
  std::array<double, 3> origin{};      ///< [m] of the smallest coordinates
  double step = 0.0;                   ///< [m] of the whole numbers that a coordinate is stored as
  float max_intensity = 0.0F;          ///< that 255 stands for
  std::uint32_t scans_per_number = 1;  ///< the scan numbers are divided by it
  std::vector<PackedLayer> layers;     ///< none where there are no points
};

inline constexpr std::size_t kOneLayer = 150'000;  ///< points of the first layer: what the page draws at first

/// At most `most` of `points`, evenly over their order.
PackedMap pack_map(std::span<const MapPoint> points, std::size_t most);

/// Base64 (RFC 4648) of bytes, padded.
std::string base64(std::string_view bytes);

}  // namespace tilth
