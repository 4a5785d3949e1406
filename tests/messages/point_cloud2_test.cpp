#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sensor/point_fields.hpp>

namespace tilth {
namespace {

struct Bytes {
  std::vector<std::byte> all;
  void number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) all.push_back(std::byte(value >> (8 * i)));
  }
  void text(const std::string& value) {
    number(value.size(), 4);
    for (const char c : value) all.push_back(std::byte(c));
  }
};

struct Layout {
  std::uint32_t height = 2, width = 3, point_step = 16, row_step = 56, big_endian = 0, data = 112, datatype = 7,
                offset_z = 8, fields = 3;
};

/// Points (1, 2, 3), (4, 5, 6) ... with four bytes of padding a point and eight a row.
std::vector<std::byte> message(const Layout& layout) {
  Bytes bytes;
  bytes.number(7, 4);
  bytes.number(1700000000, 4);
  bytes.number(250000000, 4);
  bytes.text("velodyne");
  bytes.number(layout.height, 4);
  bytes.number(layout.width, 4);
  bytes.number(layout.fields, 4);
  for (int f = 0; f < 3; ++f) {
    bytes.text(std::string(1, "xyz"[f]));
    bytes.number(f == 2 ? layout.offset_z : std::uint32_t(4 * f), 4);
    bytes.number(layout.datatype, 1);
    bytes.number(1, 4);
  }
  bytes.number(layout.big_endian, 1);
  bytes.number(layout.point_step, 4);
  bytes.number(layout.row_step, 4);
  bytes.number(layout.data, 4);
  float value = 1.0f;
  for (int row = 0; row < 2; ++row) {
    for (int point = 0; point < 3; ++point) {
      for (int f = 0; f < 3; ++f) {
        const auto raw = std::bit_cast<std::uint32_t>(value);
        bytes.number(layout.big_endian != 0 ? __builtin_bswap32(raw) : raw, 4);
        value += 1.0f;
      }
      bytes.number(0xffffffff, 4);
    }
    bytes.number(~0ull, 8);
  }
  bytes.number(1, 1);
  return bytes.all;
}

TEST(PointCloud2, HonoursOffsetsPaddingRowsAndByteOrder) {
  for (const std::uint32_t big_endian : {0u, 1u}) {
    Layout layout;
    layout.big_endian = big_endian;
    const PointCloud2 cloud = parse_point_cloud2(message(layout));
    EXPECT_EQ(cloud.stamp, 1700000000.25);
    EXPECT_EQ(cloud.frame_id, "velodyne");
    ASSERT_EQ(cloud.records.count, 6u);
    EXPECT_EQ(column(cloud.records, *cloud.records.find("x")), (std::vector<double>{1, 4, 7, 10, 13, 16}));
    EXPECT_EQ(column(cloud.records, *cloud.records.find("z")), (std::vector<double>{3, 6, 9, 12, 15, 18}));
  }
}

TEST(PointCloud2, RefusesLengthsThatLie) {
  const auto refused = [](auto change) {
    Layout layout;
    change(layout);
    EXPECT_THROW(parse_point_cloud2(message(layout)), Error);
  };
  refused([](Layout& l) { l.height = 3; });
  refused([](Layout& l) { l.width = 4; });
  refused([](Layout& l) { l.width = 0xffffffff; });
  refused([](Layout& l) { l.height = l.width = l.row_step = l.point_step = 0xffffffff; });
  refused([](Layout& l) { l.data = 0xfffffff0; });
  refused([](Layout& l) { l.datatype = 9; });
  refused([](Layout& l) { l.datatype = 0; });
  refused([](Layout& l) { l.offset_z = 13; });
  refused([](Layout& l) { l.offset_z = 0xffffffff; });
  refused([](Layout& l) { l.point_step = 8; });
  refused([](Layout& l) { l.fields = 0x7fffffff; });
}

TEST(PointCloud2, RefusesEveryTruncation) {
  const std::vector<std::byte> whole = message({});
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    EXPECT_THROW(parse_point_cloud2(std::span(whole).first(size)), Error) << size;
  }
}

TEST(PointCloud2, NamesWhatIsWrong) {
  Layout layout;
  layout.height = 3;
  try {
    parse_point_cloud2(message(layout));
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "PointCloud2 data: 112 bytes hold no 3 x 3 points, which need 160");
  }
}

TEST(PointCloud2, ReadsWhatItWrites) {
  const std::vector<Shot> shots = shots_of({beams_deg(16, -15, 2), 0.1, 10, 30});
  const PointRecords records =
      records_of(shots, {intensity_field(), ring_field(), {"t", FieldType::f64, [](const Shot& s) { return s.time; }}});
  for (const Serialization serialization : {Serialization::ros1, Serialization::cdr}) {
    const PointCloud2 back = parse_point_cloud2(
        serialize_point_cloud2({1234567890.123456789, "lidar", records}, serialization), serialization);
    EXPECT_NEAR(back.stamp, 1234567890.123456789, 3e-7);
    EXPECT_EQ(back.frame_id, "lidar");
    ASSERT_EQ(back.records.count, records.count);
    EXPECT_EQ(back.records.bytes, records.bytes);
    for (std::size_t f = 0; f < records.fields.size(); ++f) {
      EXPECT_EQ(back.records.fields[f].name, records.fields[f].name);
      EXPECT_EQ(back.records.fields[f].type, records.fields[f].type);
      EXPECT_EQ(back.records.fields[f].offset, records.fields[f].offset);
    }
  }
}

TEST(PointCloud2, RefusesToWriteWhatItCannotHold) {
  EXPECT_THROW(serialize_point_cloud2({-1.0, "", {}}), Error);
  const PointRecords records = records_of({Shot{}}, {{"t", FieldType::u64, [](const Shot&) { return 1.0; }}});
  EXPECT_THROW(serialize_point_cloud2({0.0, "", records}), Error);
}

TEST(PointFields, AreFoundByTheNamesOfDrivers) {
  const auto number = [](const Shot&) { return 1.0; };
  for (const char* name : {"intensity", "i", "reflectivity", "reflectance", "scalar_Intensity"}) {
    const auto roles = roles_of(records_of({Shot{}}, {{name, FieldType::f32, number}}));
    ASSERT_TRUE(roles.intensity) << name;
    EXPECT_EQ(roles.intensity->name, name);
  }
  for (const char* name : {"ring", "line", "channel", "laser_id"}) {
    EXPECT_TRUE(roles_of(records_of({Shot{}}, {{name, FieldType::u8, number}})).ring) << name;
  }
  for (const char* name : {"t", "time", "timestamp", "offset_time", "time_stamp", "timeStamp"}) {
    EXPECT_TRUE(roles_of(records_of({Shot{}}, {{name, FieldType::f64, number}})).time) << name;
  }
  const auto bare = roles_of(records_of({Shot{}}, {{"rgb", FieldType::f32, number}}));
  EXPECT_FALSE(bare.intensity || bare.ring || bare.time);
}

TEST(PointFields, NameTheMissingCoordinate) {
  PointRecords records = records_of({Shot{}}, {});
  records.fields[1].name = "u";
  try {
    roles_of(records);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "field y: is missing; the fields are: x, u, z");
  }
}

TEST(PointFields, LeaveOutPointsWithoutReturnAndKeepTheOrder) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const std::vector<Shot> shots{{{1, 2, 3}, 1}, {{nan, 0, 0}, 2}, {{0, 0, 0}, 3}, {{0, 0, 1}, 4}, {{1, -inf, 1}, 5}};
  const PointRecords records = records_of(shots, {ring_field()});
  const MeasuredPoints measured = measured_points(records, roles_of(records));
  EXPECT_EQ(measured.ring_values, (std::vector<double>{1, 4}));
  EXPECT_EQ(measured.not_finite, 2u);
  EXPECT_EQ(measured.no_return, 1u);
  const PointRecords none = records_of({shots[1], shots[2]}, {});
  EXPECT_THROW(measured_points(none, roles_of(none)), Error);
  EXPECT_THROW(measured_points(records_of({}, {}), roles_of(none)), Error);
}

}  // namespace
}  // namespace tilth
