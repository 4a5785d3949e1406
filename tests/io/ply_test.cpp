#include <cmath>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/ply.hpp>

namespace tilth {
namespace {

std::string header(const std::string& format, const std::string& points) {
  return "ply\nformat " + format +
         " 1.0\ncomment by hand\nelement camera 1\nproperty uchar id\nelement face 2\n"
         "property list uchar int vertex_indices\nproperty ushort flags\nelement vertex " +
         points +
         "\nproperty float x\nproperty double y\nproperty uint8 ring\nelement edge 1\nproperty int a\nend_header\n";
}

template <class T>
void put(std::string& text, T value, bool big_endian) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof(value));
  text += big_endian ? std::string(raw.rbegin(), raw.rend()) : raw;
}

std::string binary(bool big_endian) {
  std::string text = header(big_endian ? "binary_big_endian" : "binary_little_endian", "2");
  put(text, std::uint8_t{9}, big_endian);
  for (const int corners : {3, 4}) {
    put(text, std::uint8_t(corners), big_endian);
    for (int i = 0; i < corners; ++i) put(text, i, big_endian);
    put(text, std::uint16_t{1}, big_endian);
  }
  for (const double value : {1.5, -2.25}) {
    put(text, float(value), big_endian);
    put(text, 2 * value, big_endian);
    put(text, std::uint8_t(value > 0 ? 7 : 255), big_endian);
  }
  put(text, 5, big_endian);
  return text;
}

const std::string kAscii = header("ascii", "2") + "9\n3 0 1 2 1\r\n4 0 1 2 3 1\n1.5 3 7\n\n-2.25 -4.5 255\n5\n";

PointRecords parsed(const std::string& text) {
  return parse_ply(bytes_of(text), "a.ply");
}

std::vector<double> values(const PointRecords& records, const std::string& name) {
  const PointField* field = records.find(name);
  EXPECT_NE(field, nullptr) << name;
  return field ? column(records, *field) : std::vector<double>();
}

void expect_two_points(const PointRecords& records) {
  ASSERT_EQ(records.count, 2u);
  ASSERT_EQ(records.fields.size(), 3u);
  EXPECT_EQ(values(records, "x"), (std::vector<double>{1.5, -2.25}));
  EXPECT_EQ(values(records, "y"), (std::vector<double>{3, -4.5}));
  EXPECT_EQ(values(records, "ring"), (std::vector<double>{7, 255}));
}

TEST(Ply, AllFormatsGiveTheSamePoints) {
  expect_two_points(parsed(kAscii));
  expect_two_points(parsed(binary(false)));
  expect_two_points(parsed(binary(true)));
}

TEST(Ply, WriteThenReadIsBitEqual) {
  const TemporaryFolder folder;
  const PointRecords points = parsed(binary(true));
  write_ply(folder / "a.ply", points);
  const PointRecords back = read_ply(folder / "a.ply");
  expect_two_points(back);
  EXPECT_EQ(back.bytes, packed(points).bytes);
}

TEST(Ply, NotANumberPasses) {
  const PointRecords records =
      parsed("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\nnan -inf\n");
  EXPECT_TRUE(std::isnan(values(records, "x")[0]));
  EXPECT_EQ(values(records, "y")[0], -INFINITY);
}

TEST(Ply, CarriageReturnsInTheHeader) {
  const PointRecords records =
      parsed("ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty uchar i\r\nend_header\r\n\x05");
  EXPECT_EQ(values(records, "i")[0], 5);
}

TEST(Ply, EveryTruncationIsRefused) {
  const auto parse = [](const std::vector<std::byte>& bytes) { parse_ply(bytes, "a.ply"); };
  for (const bool big_endian : {false, true}) {  // the edge after the vertices is not looked at
    const std::string text = binary(big_endian);
    expect_truncations_refused(bytes_of(text), parse, [&](std::size_t n) { return n >= text.size() - 4; });
  }
  expect_truncations_refused(bytes_of(kAscii), parse, [](std::size_t n) { return n >= kAscii.size() - 5; });
}

TEST(Ply, CorruptionNeverCrashes) {
  for (const std::string& text : {kAscii, binary(false), binary(true)}) {
    expect_corruption_survived(bytes_of(text), 5000, [](const auto& bytes) { parse_ply(bytes, "a.ply"); });
  }
}

TEST(Ply, ErrorsNameFileLineAndBound) {
  const std::string head = "ply\nformat ascii 1.0\n";
  expect_error([] { parsed(""); }, {"a.ply", "empty"});
  expect_error([] { parsed("plx\n"); }, {"a.ply", "no PLY file"});
  expect_error([&] { parsed(head); }, {"a.ply", "no end_header"});
  expect_error([&] { parsed("ply\nelement vertex 0\nproperty float x\nend_header\n"); }, {"a.ply", "no format"});
  expect_error([&] { parsed(head + "element face 0\nend_header\n"); }, {"a.ply", "no element vertex"});
  expect_error([&] { parsed(head + "element vertex -1\nend_header\n"); },
               {"a.ply, line 3", "has '-1', expected a count"});
  expect_error([&] { parsed(head + "element vertex 1\nproperty half x\n"); }, {"line 4", "'half'"});
  expect_error([&] { parsed(head + "property float x\n"); }, {"line 3", "an element before"});
  expect_error([&] { parsed(head + "vertices 1\n"); }, {"line 3", "'vertices'"});
  expect_error([] { parsed("ply\nformat binary 1.0\n"); }, {"line 2", "'binary'"});
  expect_error([&] { parsed(head + "element vertex 1\nproperty list uchar int a\nend_header\n1 1\n"); },
               {"without properties that are numbers"});
  const std::string one = head + "element vertex 1\nproperty uchar r\nend_header\n";
  expect_error([&] { parsed(one + "300\n"); }, {"a.ply, line 6", "property r is '300'"});
  expect_error([&] { parsed(one + "3 4\n"); }, {"line 6", "has 2 of 1 values"});
  expect_error([&] { parsed(one); }, {"has 0 of 1 points (truncated)"});
  expect_error([] { parsed(binary(false).substr(0, binary(false).size() - 5)); }, {"has 1 of 2 points (truncated)"});
  expect_error([] { read_ply("/nowhere/a.ply"); }, {"/nowhere/a.ply", "No such file"});
  expect_error([] { write_ply("/dev/full", parsed(kAscii)); }, {"/dev/full", "No space left on device"});
}

TEST(Ply, AbsurdCountsAllocateNothing) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string count : {"4000000000", "18446744073709551615", "99999999999999999999"}) {
      EXPECT_THROW(parsed(header(format, count) + std::string(100, '\0')), Error) << format << " " << count;
    }
  }
  const std::string lists =
      "ply\nformat binary_little_endian 1.0\nelement face 4000000000\nproperty list int double a\n"
      "element vertex 0\nproperty float x\nend_header\n";
  expect_error([&] { parsed(lists + "\xff\xff\xff\x7f"); }, {"elements face (truncated)"});
  expect_error([&] { parsed(lists + "\xff\xff\xff\xff"); }, {"list a of face has a negative size"});
}

TEST(Ply, WideIntegersCannotBeWritten) {
  const TemporaryFolder folder;
  const PointRecords records{{{"t", FieldType::u64, 0}}, 8, 1, std::endian::little, std::vector<std::byte>(8)};
  expect_error([&] { write_ply(folder / "a.ply", records); }, {"field t", "64-bit"});
}

const std::string kListed =
    " 1.0\nelement vertex 3\nproperty list uchar short seen_by\nproperty float x\nproperty list int float weights\n"
    "property float y\nproperty double z\nend_header\n";

TEST(Ply, ListsOnVerticesArePassedOver) {
  const std::vector<int> lists{0, 2, 5};
  std::string ascii = "ply\nformat ascii" + kListed;
  std::vector<std::string> binary{"ply\nformat binary_little_endian" + kListed,
                                  "ply\nformat binary_big_endian" + kListed};
  for (int i = 0; i < 3; ++i) {
    ascii += std::to_string(lists[std::size_t(i)]);
    for (int n = 0; n < lists[std::size_t(i)]; ++n) ascii += " 9";
    ascii += " " + std::to_string(i) + " 1 0.5 " + std::to_string(i + 10) + " " + std::to_string(i + 20) + "\n";
    for (const bool big : {false, true}) {
      std::string& text = binary[big ? 1 : 0];
      put(text, std::uint8_t(lists[std::size_t(i)]), big);
      for (int n = 0; n < lists[std::size_t(i)]; ++n) put(text, std::int16_t{9}, big);
      put(text, float(i), big), put(text, std::int32_t{1}, big), put(text, 0.5F, big);
      put(text, float(i + 10), big), put(text, double(i + 20), big);
    }
  }
  for (const std::string& text : {ascii, binary[0], binary[1]}) {
    const PointRecords records = parsed(text);
    EXPECT_EQ(records.fields.size(), 3u);
    EXPECT_EQ(values(records, "x"), (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(values(records, "y"), (std::vector<double>{10, 11, 12}));
    EXPECT_EQ(values(records, "z"), (std::vector<double>{20, 21, 22}));
  }
  expect_error([&] { parsed(binary[0].substr(0, binary[0].size() - 1)); }, {"has 2 of 3 points (truncated)"});
  expect_error([&] { parsed("ply\nformat ascii" + kListed + "4 9 9 1 1\n"); },
               {"a.ply, line 10", "has 5 values, not those of its 5 properties"});
}

}  // namespace
}  // namespace tilth
