#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/lzf.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>

namespace tilth {
namespace {

std::string header(const std::string& points, const std::string& encoding) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _ intensity ring\nSIZE 4 4 4 1 1 2\nTYPE F F F U U U\nCOUNT 1 1 1 3 1 "
         "1\n"
         "WIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + encoding + "\n";
}

template <class T>
void put(std::string& text, T value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::string record(float x, float y, float z, std::uint8_t intensity, std::uint16_t ring) {
  std::string text;
  for (const float value : {x, y, z}) put(text, value);
  text += "abc";
  put(text, intensity);
  put(text, ring);
  return text;
}

PointRecords parsed(const std::string& text) {
  return parse_pcd(bytes_of(text), "a.pcd");
}

std::vector<double> values(const PointRecords& records, const std::string& name) {
  const PointField* field = records.find(name);
  EXPECT_NE(field, nullptr) << name;
  return field ? column(records, *field) : std::vector<double>();
}

void expect_two_points(const PointRecords& records) {
  ASSERT_EQ(records.count, 2u);
  EXPECT_EQ(records.find("_"), nullptr);
  EXPECT_EQ(values(records, "x"), (std::vector<double>{1.5, -1}));
  EXPECT_EQ(values(records, "y"), (std::vector<double>{2.5, -2}));
  EXPECT_EQ(values(records, "z"), (std::vector<double>{3.5, -3}));
  EXPECT_EQ(values(records, "intensity"), (std::vector<double>{255, 7}));
  EXPECT_EQ(values(records, "ring"), (std::vector<double>{15, 65535}));
}

const std::string kBinary = header("2", "binary") + record(1.5F, 2.5F, 3.5F, 255, 15) + record(-1, -2, -3, 7, 65535);

// The same two points column by column: literal runs of LZF only.
std::string compressed(bool padding) {
  std::string columns;
  for (const float value : {1.5F, -1.F, 2.5F, -2.F, 3.5F, -3.F}) put(columns, value);
  if (padding) columns += "abcabc";
  columns += "\xff\x07";
  for (const std::uint16_t ring : {15, 65535}) put(columns, ring);
  std::string stream;
  for (std::size_t i = 0; i < columns.size(); i += 32) {
    const std::string run = columns.substr(i, 32);
    stream += char(run.size() - 1) + run;
  }
  std::string text = header("2", "binary_compressed");
  put(text, std::uint32_t(stream.size()));
  put(text, std::uint32_t(columns.size()));
  return text + stream;
}

const std::string kAscii = header("2", "ascii") + "1.5 2.5 3.5 9 9 9 255 15\r\n\n-1 -2.0e0 -3 0 0 0 7 65535.0\n";

TEST(Pcd, BinaryAsciiAndCompressedGiveTheSamePoints) {
  expect_two_points(parsed(kBinary));
  expect_two_points(parsed(kAscii));
  expect_two_points(parsed(compressed(true)));
  expect_two_points(parsed(compressed(false)));
}

TEST(Pcd, NotANumberPasses) {
  const PointRecords records = parsed("FIELDS x y\nSIZE 4 8\nTYPE F F\nPOINTS 2\nDATA ascii\nnan inf\n1e-60 -nan\n");
  EXPECT_TRUE(std::isnan(values(records, "x")[0]));
  EXPECT_EQ(values(records, "x")[1], 0);
  EXPECT_EQ(values(records, "y")[0], std::numeric_limits<double>::infinity());
}

TEST(Pcd, OldHeadersAndSeveralElements) {
  const PointRecords records = parsed(
      "VERSION .5\nCOLUMNS x h y\nSIZE 4 4 1\nTYPE F F I\nCOUNT 1 3 1\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3 4 -5\n");
  EXPECT_EQ(values(records, "h")[0], 2);
  EXPECT_EQ(values(records, "y")[0], -5);
}

TEST(Pcd, WidthAndHeightLeftZero) {
  const std::string head = "FIELDS x\nSIZE 4\nTYPE F\nWIDTH 0\nHEIGHT 0\nPOINTS 2\nDATA ascii\n";
  EXPECT_EQ(values(parsed(head + "3\n4\n"), "x"), (std::vector<double>{3, 4}));
  expect_error([&] { parsed(head + "3\n"); }, {"has 1 of 2 points (truncated)"});
}

TEST(Pcd, WriteThenReadIsBitEqual) {
  const TemporaryFolder folder;
  const PointRecords points = parsed(kBinary);
  write_pcd(folder / "a.pcd", points);
  const PointRecords back = read_pcd(folder / "a.pcd");
  expect_two_points(back);
  EXPECT_EQ(back.stride, 15u);
  EXPECT_EQ(back.bytes, packed(points).bytes);
}

TEST(Pcd, CloudBecomesRecords) {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}, {4, 5, 6}};
  cloud.rings = {3, 4};
  cloud.times = {0, 0.25F};
  const PointRecords records = to_records(cloud);
  EXPECT_EQ(records.find("intensity"), nullptr);
  EXPECT_EQ(values(records, "z"), (std::vector<double>{3, 6}));
  EXPECT_EQ(values(records, "ring"), (std::vector<double>{3, 4}));
  EXPECT_EQ(values(records, "time"), (std::vector<double>{0, 0.25}));
}

TEST(Pcd, BigEndianRecordsArePackedLittleEndian) {
  PointRecords records{{{"a", FieldType::u16, 1}}, 3, 1, std::endian::big, {std::byte{9}, std::byte{1}, std::byte{2}}};
  EXPECT_EQ(column(records, records.fields[0]), column(packed(records), packed(records).fields[0]));
  EXPECT_EQ(packed(records).bytes, (std::vector<std::byte>{std::byte{2}, std::byte{1}}));
}

TEST(Pcd, LzfBackReferences) {
  // 'a', then 9 + 5 bytes from 1 back (overlapping), then a short reference of 3.
  const std::vector<std::byte> stream{std::byte{0}, std::byte{'a'},  std::byte{0xe0}, std::byte{5},
                                      std::byte{0}, std::byte{0x20}, std::byte{0}};
  EXPECT_EQ(lzf_decompress(stream, 18), bytes_of(std::string(18, 'a')));
  EXPECT_FALSE(lzf_decompress(stream, 17));
  EXPECT_FALSE(lzf_decompress(stream, 19));
  EXPECT_FALSE(lzf_decompress(std::vector<std::byte>{std::byte{0x20}, std::byte{0}}, 3)) << "before the begin";
}

TEST(Pcd, EveryTruncationIsRefused) {
  const auto parse = [](const std::vector<std::byte>& bytes) { parse_pcd(bytes, "a.pcd"); };
  const auto never = [](std::size_t) { return false; };
  expect_truncations_refused(bytes_of(kBinary), parse, never);
  expect_truncations_refused(bytes_of(compressed(true)), parse, never);
  // Text may lose its last line end, and digits of its last number: "65535.0" -> "6".
  expect_truncations_refused(bytes_of(kAscii), parse, [](std::size_t n) { return n >= kAscii.size() - 7; });
}

TEST(Pcd, CorruptionNeverCrashes) {
  for (const std::string& text : {kBinary, kAscii, compressed(true), compressed(false)}) {
    expect_corruption_survived(bytes_of(text), 3000, [](const auto& bytes) { parse_pcd(bytes, "a.pcd"); });
  }
}

TEST(Pcd, ErrorsNameFileFieldAndBound) {
  expect_error([] { parsed(""); }, {"a.pcd", "empty"});
  expect_error([] { parsed("ply\n"); }, {"a.pcd", "no DATA"});
  expect_error([] { parsed(header("5000", "binary") + record(1, 2, 3, 4, 5)); },
               {"a.pcd", "has 1 of 5000 points (truncated)"});
  expect_error([] { parsed(header("5000", "ascii") + "1 2 3 4 5 6 7 8\n"); }, {"has 1 of 5000 points (truncated)"});
  expect_error([] { parsed(header("1", "ascii") + "1 2 3 4 5 6 7\n"); }, {"a.pcd, line 12", "has 7 of 8 values"});
  expect_error([] { parsed(header("1", "ascii") + "1 2 3 4 5 6 700 8\n"); }, {"line 12", "field intensity is '700'"});
  expect_error([] { parsed(header("1", "ascii") + "1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8\n"); },
               {"line 13", "beyond the 1 POINTS"});
  expect_error([] { parsed(header("many", "binary")); }, {"POINTS is 'many'"});
  expect_error([] { parsed(header("1", "zip")); }, {"DATA is 'zip'"});
  expect_error([] { parsed("FIELDS x\nSIZE 4 4\nTYPE F\nPOINTS 1\nDATA ascii\n"); }, {"has 1 FIELDS but 2 SIZE"});
  expect_error([] { parsed("FIELDS x\nSIZE 3\nTYPE F\nPOINTS 1\nDATA ascii\n"); }, {"field x", "TYPE F with SIZE 3"});
  expect_error([] { parsed("FIELDS x\nSIZE 4\nTYPE F\nCOUNT 0\nPOINTS 1\nDATA ascii\n"); }, {"COUNT 0 of every field"});
  expect_error([] { parsed("FIELDS x\nSIZE 4\nTYPE F\nWIDTH 2\nHEIGHT 3\nPOINTS 5\nDATA ascii\n"); },
               {"POINTS 5", "HEIGHT 3"});
  expect_error([] { read_pcd("/nowhere/a.pcd"); }, {"/nowhere/a.pcd", "No such file"});
  expect_error([] { read_pcd("/tmp"); }, {"/tmp", "Is a directory"});
}

TEST(Pcd, AbsurdCountsAllocateNothing) {
  for (const std::string encoding : {"ascii", "binary", "binary_compressed"}) {
    for (const std::string count : {"4000000000", "18446744073709551615", "99999999999999999999999"}) {
      EXPECT_THROW(parsed(header(count, encoding) + "12345678"), Error) << encoding << " " << count;
    }
  }
  std::string text = header("260000000", "binary_compressed");
  put(text, std::uint32_t(3));
  put(text, std::uint32_t(260000000 * 15LL));
  expect_error([&] { parsed(text + "abc"); }, {"corrupt compressed data"});
}

TEST(OutputFile, FullDiskIsReported) {
  expect_error([] { write_pcd("/dev/full", parsed(kBinary)); }, {"/dev/full", "No space left on device"});
  expect_error([] { write_pcd("/nowhere/a.pcd", parsed(kBinary)); }, {"/nowhere/a.pcd", "No such file"});
}

TEST(OutputFile, IsWrittenCompletelyOrNotAtAll) {
  const TemporaryFolder folder;
  write_text(folder / "a", "old");
  {
    OutputFile file(folder / "a");
    file.write("new, but never closed");
  }
  EXPECT_EQ(as_text(read_file(folder / "a")), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.partial"));
  write_text(folder / "a", "new");
  EXPECT_EQ(as_text(read_file(folder / "a")), "new");
}

/// A column of COUNT 0 between y and z, with or without a value in the data.
std::string with_empty_column(const std::string& encoding) {
  return "VERSION 0.7\nFIELDS x y e z\nSIZE 4 4 2 4\nTYPE F F U F\nCOUNT 1 1 0 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA " +
         encoding + "\n";
}

TEST(Pcd, ColumnsOfCountZeroAreEmptyOrSingleAsTheDataHasThem) {
  for (const bool single : {false, true}) {
    std::string binary = with_empty_column("binary");
    for (const float first : {1.0F, 4.0F}) {
      put(binary, first), put(binary, first + 1);
      if (single) put(binary, std::uint16_t{7});
      put(binary, first + 2);
    }
    const std::string e = single ? "7 " : "";
    for (const std::string& text : {binary, with_empty_column("ascii") + "1 2 " + e + "3\n4 5 " + e + "6\n"}) {
      const PointRecords records = parsed(text);
      EXPECT_EQ(values(records, "x"), (std::vector<double>{1, 4}));
      EXPECT_EQ(values(records, "z"), (std::vector<double>{3, 6}));
      if (single)
        EXPECT_EQ(values(records, "e"), (std::vector<double>{7, 7}));
      else
        EXPECT_EQ(records.find("e"), nullptr);
    }
  }
}

TEST(Pcd, HeadersInLowerCaseAreRead) {
  const PointRecords records = parsed(
      "version 0.7\nfields x y z ring\nsize 4 4 4 1\ntype f f f u\ncount 1 1 1 1\nwidth 1\nheight 1\npoints 1\n"
      "data ASCII\n1 2 3 4\n");
  EXPECT_EQ(values(records, "y"), (std::vector<double>{2}));
  EXPECT_EQ(values(records, "ring"), (std::vector<double>{4}));
}

}  // namespace
}  // namespace tilth
