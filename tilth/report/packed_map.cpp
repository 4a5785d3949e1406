#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <zlib.h>

#include <tilth/core/error.hpp>
#include <tilth/core/evenly_chosen.hpp>
#include <tilth/report/packed_map.hpp>

namespace tilth {
namespace {

constexpr std::size_t kLargestLayer = 600'000;  // points of another: unpacked at a stretch
constexpr double kFinestStep = 0.005;           // [m] well below what an eye sees in a whole map
constexpr double kLargestNumber = std::numeric_limits<std::uint16_t>::max();
constexpr double kBrightest = 0.995;  // share of the points that must be darker than white

struct QuantisedPoint {
  std::array<std::uint16_t, 3> at{};
  std::uint16_t scan = 0;
  std::uint8_t intensity = 0;
  std::uint64_t order = 0;
};

/// The bits of `value`, two places between each.
std::uint64_t spread(std::uint64_t value) {
  value = (value | value << 32) & 0x001f00000000ffffU;
  value = (value | value << 16) & 0x001f0000ff0000ffU;
  value = (value | value << 8) & 0x100f00f00f00f00fU;
  value = (value | value << 4) & 0x10c30c30c30c30c3U;
  return (value | value << 2) & 0x1249249249249249U;
}

float brightest(const std::vector<MapPoint>& points) {
  std::vector<float> values(points.size());
  std::transform(points.begin(), points.end(), values.begin(), [](const MapPoint& p) { return p.intensity; });
  const auto at = values.begin() + std::ptrdiff_t(kBrightest * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return std::max(*at, 1e-6F);
}

/// Sets the box, the step and the scales that all of `points` fit in.
void fit(PackedMap& map, const std::vector<MapPoint>& points) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  std::uint32_t last_scan = 0;
  for (const MapPoint& p : points) {
    const double at[] = {p.x, p.y, p.z};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], at[a]);
      high[a] = std::max(high[a], at[a]);
    }
    last_scan = std::max(last_scan, p.scan);
  }
  map.origin = low;
  map.step = kFinestStep;
  for (std::size_t a = 0; a < 3; ++a) map.step = std::max(map.step, (high[a] - low[a]) / kLargestNumber);
  map.max_intensity = brightest(points);
  map.scans_per_number = last_scan / (1U + std::uint32_t(kLargestNumber)) + 1;
}

QuantisedPoint quantised(const MapPoint& point, const PackedMap& map) {
  QuantisedPoint q;
  const double at[] = {point.x, point.y, point.z};
  for (std::size_t a = 0; a < 3; ++a) {
    q.at[a] = std::uint16_t(std::clamp(std::round((at[a] - map.origin[a]) / map.step), 0.0, kLargestNumber));
  }
  q.scan = std::uint16_t(point.scan / map.scans_per_number);
  q.intensity = std::uint8_t(255 * std::clamp(point.intensity / map.max_intensity, 0.0F, 1.0F));
  q.order = spread(q.at[0]) | spread(q.at[1]) << 1 | spread(q.at[2]) << 2;
  return q;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_DEFAULT_COMPRESSION);
  if (result != Z_OK) throw Error("map", "cannot be deflated (zlib " + std::to_string(result) + ")");
  out.resize(size);
  return out;
}

/// The zlib stream of the differences of value(point) from point to point; 16 bits that wrap round.
template <class F>
std::string packed_differences(const std::vector<QuantisedPoint>& points, const F& value) {
  std::string bytes(2 * points.size(), '\0');
  std::uint16_t last = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint16_t now = value(points[i]);
    const auto difference = std::int16_t(std::uint16_t(now - last));
    const auto zigzag = std::uint16_t((unsigned(difference) << 1U) ^ (difference < 0 ? 0xffffU : 0U));
    bytes[i] = char(zigzag & 0xffU);
    bytes[points.size() + i] = char(zigzag >> 8U);
    last = now;
  }
  return deflated(bytes);
}

/// The points of each layer: of neighbours in `points` every layer has its share.
std::vector<std::vector<QuantisedPoint>> dealt(const std::vector<QuantisedPoint>& points) {
  const std::size_t left = points.size() > kOneLayer ? points.size() - kOneLayer : 0;
  const std::size_t others = (left + kLargestLayer - 1) / kLargestLayer;
  const double first = std::min(1.0, double(kOneLayer) / double(points.size()));
  std::vector<std::vector<QuantisedPoint>> layers(1 + others);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double whole = 0.0;
    const double place = std::modf(double(i) * std::numbers::phi, &whole);  // even over 0 to 1, any run of i
    const double beyond = (place - first) / (1.0 - first) * double(others);
    const std::size_t layer = place < first ? 0 : 1 + std::min(std::size_t(beyond), others - 1);
    layers[layer].push_back(points[i]);
  }
  return layers;
}

PackedLayer pack_layer(std::vector<QuantisedPoint> points) {
  std::sort(points.begin(), points.end(), [](const QuantisedPoint& a, const QuantisedPoint& b) {
    return a.order != b.order ? a.order < b.order : a.scan < b.scan;
  });
  PackedLayer layer;
  layer.count = points.size();
  layer.x = packed_differences(points, [](const QuantisedPoint& p) { return p.at[0]; });
  layer.y = packed_differences(points, [](const QuantisedPoint& p) { return p.at[1]; });
  layer.z = packed_differences(points, [](const QuantisedPoint& p) { return p.at[2]; });
  layer.scan = packed_differences(points, [](const QuantisedPoint& p) { return p.scan; });
  std::string intensity(points.size(), '\0');
  std::transform(points.begin(), points.end(), intensity.begin(),
                 [](const QuantisedPoint& p) { return char(p.intensity); });
  layer.intensity = deflated(intensity);
  return layer;
}

}  // namespace

PackedMap pack_map(std::span<const MapPoint> points, std::size_t most) {
  PackedMap map;
  map.total = points.size();
  const std::vector<MapPoint> kept = evenly_chosen(points, most);
  map.count = kept.size();
  if (kept.empty()) return map;
  fit(map, kept);
  std::vector<QuantisedPoint> small(kept.size());
  std::transform(kept.begin(), kept.end(), small.begin(), [&](const MapPoint& p) { return quantised(p, map); });
  for (std::vector<QuantisedPoint>& layer : dealt(small)) map.layers.push_back(pack_layer(std::move(layer)));
  return map;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kLetters[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

}  // namespace tilth
