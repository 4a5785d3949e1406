// A broken PLY or KITTI .bin among good ones: passed over by name, not fatal.
#include <gtest/gtest.h>

#include "program.hpp"
#include "room_recording.hpp"

namespace tilth::app {
namespace {

constexpr int kScans = 5, kBroken = 2;

std::string ply_of(const PointCloud& cloud) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(cloud.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const Eigen::Vector3d& p : cloud.points)
    text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  return text;
}

std::string bin_of(const PointCloud& cloud) {
  std::string bytes;
  for (const Eigen::Vector3d& p : cloud.points) {
    const float record[4] = {float(p.x()), float(p.y()), float(p.z()), 0.5F};
    bytes.append(reinterpret_cast<const char*>(record), sizeof(record));
  }
  return bytes;
}

class BadScanFiles : public testing::Test {
 protected:
  void write(int index, const std::string& extension, const std::string& bytes) const {
    std::filesystem::create_directories(scans_);
    std::ofstream(scans_ / (std::to_string(index) + extension), std::ios::binary) << bytes;
  }
  template <class Format>
  void write_all(const std::string& extension, const Format& format) const {
    for (int i = 0; i < kScans; ++i) write(i, extension, format(room_scan(i)));
  }
  void expect_passed_over(const std::string& name) const {
    const Outcome outcome = tilth({"run", scans_.string(), "--out", (folder_ / "out").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
    const std::string poses = text_of(folder_ / "out" / "trajectory.tum");
    EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), kScans - 1);
  }

  TemporaryFolder folder_;
  std::filesystem::path scans_ = folder_ / "scans";
};

TEST_F(BadScanFiles, ZeroBytePly) {
  write_all(".ply", ply_of);
  write(kBroken, ".ply", "");
  expect_passed_over("2.ply");
}

TEST_F(BadScanFiles, TruncatedPly) {
  write_all(".ply", ply_of);
  const std::string whole = ply_of(room_scan(kBroken));
  write(kBroken, ".ply", whole.substr(0, whole.size() / 2));
  expect_passed_over("2.ply");
}

TEST_F(BadScanFiles, PlyThatPromisesMoreThanMemoryHolds) {
  write_all(".ply", ply_of);
  write(kBroken, ".ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\n"
        "property float z\nend_header\nabcdefgh");
  expect_passed_over("2.ply");
}

TEST_F(BadScanFiles, ZeroByteBin) {
  write_all(".bin", bin_of);
  write(kBroken, ".bin", "");
  expect_passed_over("2.bin");
}

TEST_F(BadScanFiles, BinThatIsNoMultipleOfAPoint) {
  write_all(".bin", bin_of);
  const std::string whole = bin_of(room_scan(kBroken));
  write(kBroken, ".bin", whole.substr(0, whole.size() - 7));
  expect_passed_over("2.bin");
}

}  // namespace
}  // namespace tilth::app
