// What is packed for the page comes out again, as the page's script takes it apart.
#include <zlib.h>

#include <gtest/gtest.h>

#include <tilth/report/packed_map.hpp>

namespace tilth {
namespace {

std::vector<std::uint16_t> unpacked(const std::string& stream, std::size_t count) {
  std::vector<unsigned char> bytes(2 * count);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(stream.data()), stream.size()), Z_OK);
  EXPECT_EQ(size, bytes.size());
  std::vector<std::uint16_t> values;
  std::uint16_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned zigzag = bytes[i] | unsigned(bytes[count + i]) << 8U;
    value = std::uint16_t(value + ((zigzag >> 1U) ^ (zigzag & 1U ? 0xffffU : 0U)));
    values.push_back(value);
  }
  return values;
}

std::vector<MapPoint> spiral(std::size_t count, float size) {
  std::vector<MapPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const float t = float(i) / float(count);
    points.push_back({size * t * std::cos(40 * t), size * t * std::sin(40 * t), 3 * t, 100 * t, std::uint32_t(i)});
  }
  return points;
}

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xef"), "/+8=");
}

TEST(PackedMap, EveryPointComesBackToWithinHalfAStep) {
  const std::vector<MapPoint> points = spiral(5000, 400);
  const PackedMap map = pack_map(points, 10000);
  ASSERT_EQ(map.count, points.size());
  EXPECT_LT(map.step, 0.013) << "800 m in 65535 steps";
  ASSERT_EQ(map.layers.size(), 1U);
  const PackedLayer& layer = map.layers.front();
  const auto x = unpacked(layer.x, map.count), y = unpacked(layer.y, map.count), z = unpacked(layer.z, map.count);
  const auto scan = unpacked(layer.scan, map.count);
  for (std::size_t i = 0; i < map.count; ++i) {
    const MapPoint& p = points[scan[i]];
    EXPECT_NEAR(map.origin[0] + map.step * x[i], p.x, 0.51 * map.step + 1e-4);
    EXPECT_NEAR(map.origin[1] + map.step * y[i], p.y, 0.51 * map.step + 1e-4);
    EXPECT_NEAR(map.origin[2] + map.step * z[i], p.z, 0.51 * map.step + 1e-4);
  }
}

TEST(PackedMap, ThinsEvenly) {
  const PackedMap map = pack_map(spiral(5000, 10), 500);
  EXPECT_EQ(map.count, 500U);
  EXPECT_EQ(map.total, 5000U);
  auto scans = unpacked(map.layers.front().scan, map.count);
  std::sort(scans.begin(), scans.end());
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(scans[i], 10 * i);
}

TEST(PackedMap, HasEveryPointInOneLayerAndEachLayerIsEven) {
  constexpr std::size_t kCount = 1'000'000, kSlots = 20;
  std::vector<MapPoint> points = spiral(kCount, 10);
  for (std::size_t i = 0; i < kCount; ++i) points[i].scan = std::uint32_t(i % 60'000);
  const PackedMap map = pack_map(points, kCount);
  ASSERT_EQ(map.layers.size(), 3U) << "150,000, then 600,000 at most";
  std::vector<int> seen(60'000);
  for (const PackedLayer& layer : map.layers) {
    const auto z = unpacked(layer.z, layer.count), scan = unpacked(layer.scan, layer.count);
    for (const std::uint16_t number : scan) ++seen[number];
    std::vector<std::size_t> slots(kSlots);  // z grows with the number of the point
    for (const std::uint16_t value : z) ++slots[std::min(kSlots - 1, std::size_t(value * map.step / 3 * kSlots))];
    for (const std::size_t slot : slots) EXPECT_NEAR(double(slot), double(layer.count) / kSlots, 0.1 * double(slot));
  }
  EXPECT_NEAR(double(map.layers[0].count), 150'000, 100);
  for (std::size_t s = 0; s < seen.size(); ++s) ASSERT_EQ(seen[s], s < kCount % 60'000 ? 17 : 16) << s;
}

TEST(PackedMap, OfNothingIsEmpty) {
  EXPECT_EQ(pack_map({}, 100).count, 0U);
  EXPECT_TRUE(pack_map({}, 100).layers.empty());
  EXPECT_EQ(pack_map(spiral(10, 1), 0).count, 0U);
}

TEST(PackedMap, MoreScansThanNumbersShareThem) {
  std::vector<MapPoint> points = spiral(3, 1);
  points[2].scan = 200'000;
  const PackedMap map = pack_map(points, 100);
  EXPECT_EQ(map.scans_per_number, 4U);
  EXPECT_GE(unpacked(map.layers.front().scan, map.count).size(), 3U);
}

}  // namespace
}  // namespace tilth
