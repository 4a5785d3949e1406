#include <array>
#include <cstring>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/input_file.hpp>
#include <tilth/io/kitti_bin.hpp>

namespace tilth {
namespace {

TEST(KittiBin, GoldenBytes) {
  // 1.0, -2.0, 0.5, 0.25 as little-endian float32
  const std::array<unsigned char, 16> raw{0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0x3f, 0, 0, 0x80, 0x3e};
  const auto bytes = std::as_bytes(std::span(raw));
  const PointRecords records = parse_kitti_bin({bytes.begin(), bytes.end()}, "a.bin");
  ASSERT_EQ(records.count, 1u);
  EXPECT_EQ(column(records, *records.find("x"))[0], 1.0);
  EXPECT_EQ(column(records, *records.find("y"))[0], -2.0);
  EXPECT_EQ(column(records, *records.find("z"))[0], 0.5);
  EXPECT_EQ(column(records, *records.find("intensity"))[0], 0.25);

  const TemporaryFolder folder;
  write_kitti_bin(folder / "a.bin", records);
  EXPECT_EQ(read_file(folder / "a.bin"), records.bytes);
  EXPECT_EQ(read_kitti_bin(folder / "a.bin").bytes, records.bytes);
}

TEST(KittiBin, EverySizeButWholePointsIsRefused) {
  for (std::size_t size = 0; size <= 64; ++size) {
    const std::vector<std::byte> bytes(size);
    if (size > 0 && size % 16 == 0)
      EXPECT_EQ(parse_kitti_bin(bytes, "a.bin").count, size / 16);
    else
      expect_error([&] { parse_kitti_bin(bytes, "a.bin"); }, {"a.bin", std::to_string(size) + " bytes"});
  }
}

TEST(KittiBin, MissingFieldIsNamed) {
  const TemporaryFolder folder;
  const PointRecords records{{{"x", FieldType::f32, 0}}, 4, 1, std::endian::little, std::vector<std::byte>(4)};
  expect_error([&] { write_kitti_bin(folder / "a.bin", records); }, {"a.bin", "needs the field y"});
}

}  // namespace
}  // namespace tilth
