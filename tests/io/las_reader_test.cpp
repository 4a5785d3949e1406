// LAS: what write_las wrote comes back, every version and point format is read, and what is damaged is refused.
#include <array>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/las.hpp>
#include <tilth/io/las_reader.hpp>

namespace tilth {
namespace {

using Bytes = std::vector<std::byte>;

template <class T>
void put(Bytes& bytes, std::size_t position, T value) {
  if (bytes.size() < position + sizeof value) bytes.resize(position + sizeof value);
  std::memcpy(bytes.data() + position, &value, sizeof value);
}

/// [bytes] of points of each format, tables 7 to 17 of the specification.
constexpr std::array<std::uint16_t, 11> kSizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// A file of three points, 2 bytes longer than their format asks for: 1.25 m and on, intensity 7, 8, 9.
Bytes made(int minor, int format) {
  Bytes bytes;
  const std::size_t header = minor < 3 ? 227 : minor == 3 ? 235 : 375;
  const auto stride = std::uint16_t(kSizes[std::size_t(format)] + 2);
  std::memcpy((bytes.resize(header + 10), bytes.data()), "LASF", 4);
  put(bytes, 24, std::uint8_t(1)), put(bytes, 25, std::uint8_t(minor));
  put(bytes, 94, std::uint16_t(header));
  put(bytes, 96, std::uint32_t(header + 10));
  put(bytes, 104, std::uint8_t(format)), put(bytes, 105, stride);
  if (minor < 4) put(bytes, 107, std::uint32_t(3));
  if (minor == 4) put(bytes, 247, std::uint64_t(3));
  for (std::size_t axis = 0; axis < 3; ++axis) put(bytes, 131 + 8 * axis, 0.25), put(bytes, 155 + 8 * axis, 0.5);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t at = header + 10 + i * stride;
    for (std::size_t axis = 0; axis < 3; ++axis) put(bytes, at + 4 * axis, std::int32_t(3 + i + axis));
    put(bytes, at + 12, std::uint16_t(7 + i));
    put(bytes, at + stride - 1, std::uint8_t(0));
  }
  return bytes;
}

std::vector<double> values(const PointRecords& records, const std::string& name) {
  return column(records, *records.find(name));
}

TEST(LasReader, ReadsEveryVersionAndPointFormat) {
  for (int minor = 0; minor <= 4; ++minor) {
    for (int format = 0; format <= 10; ++format) {
      const PointRecords records = parse_las(made(minor, format), "a.las");
      ASSERT_EQ(records.count, 3U) << "1." << minor << ", format " << format;
      EXPECT_EQ(values(records, "x"), (std::vector<double>{1.25, 1.5, 1.75}));
      EXPECT_EQ(values(records, "z"), (std::vector<double>{1.75, 2.0, 2.25}));
      EXPECT_EQ(values(records, "intensity"), (std::vector<double>{7, 8, 9}));
    }
  }
}

TEST(LasReader, LeavesOutWhatIsWithheldOrNoise) {
  Bytes old = made(2, 1);
  put(old, 237 + 15, std::uint8_t(0x80 | 2));  // withheld ground
  put(old, 237 + 30 + 15, std::uint8_t(7));    // a low point
  EXPECT_EQ(values(parse_las(old, "a"), "intensity"), (std::vector<double>{9}));
  Bytes wide = made(4, 6);
  put(wide, 385 + 15, std::uint8_t(4));        // withheld
  put(wide, 385 + 32 + 16, std::uint8_t(18));  // high noise
  EXPECT_EQ(values(parse_las(wide, "a"), "intensity"), (std::vector<double>{9}));
}

TEST(LasReader, ReadsWhatIsWritten) {
  const TemporaryFolder folder;
  PointRecords records;
  records.fields = {{"x", FieldType::f64, 0}, {"y", FieldType::f64, 8}, {"z", FieldType::f64, 16}};
  records.stride = 24;
  std::vector<double> expected;
  for (int i = 0; i < 500; ++i) {
    for (const double value : {0.37 * i, -2000.0 + 0.11 * i, 7.0}) {
      put(records.bytes, records.bytes.size(), value);
      if (value != 7.0) continue;
      expected.push_back(0.37 * i), ++records.count;
    }
  }
  write_las(folder / "a.las", records);
  const std::vector<double> x = values(read_las(folder / "a.las"), "x");
  ASSERT_EQ(x.size(), expected.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], expected[i], 0.51 * kLasStep);
}

TEST(LasReader, RefusesEveryTruncation) {
  for (const auto& [minor, format] : {std::pair{2, 3}, {4, 6}})
    expect_truncations_refused(
        made(minor, format), [](const Bytes& bytes) { parse_las(bytes, "a"); }, [](std::size_t) { return false; });
  expect_corruption_survived(made(4, 7), 3000, [](const Bytes& bytes) { parse_las(bytes, "a"); });
}

template <class T>
void expect_refused(std::size_t position, T value, const std::string& what) {
  Bytes bytes = made(2, 3);
  put(bytes, position, value);
  expect_error([&] { parse_las(bytes, "survey.las"); }, {"survey.las", what});
}

TEST(LasReader, SaysWhatIsWrong) {
  expect_refused(0, 'X', "does not begin with LASF");
  expect_refused(25, std::uint8_t(5), "is LAS 1.5, expected 1.0 to 1.4");
  expect_refused(104, std::uint8_t(0x80 | 3), "is compressed (LAZ)");
  expect_refused(104, std::uint8_t(11), "points of format 11");
  expect_refused(105, std::uint16_t(20), "points of 20 bytes, expected at least 34");
  expect_refused(107, std::uint32_t(4'000'000'000), "has 3 of 4000000000 points (truncated)");
  expect_refused(96, std::uint32_t(100), "begin within its header");
  expect_refused(131, 0.0, "scale that is not above 0");
  expect_refused(163, std::nan(""), "offset that is not finite");
}

}  // namespace
}  // namespace tilth
