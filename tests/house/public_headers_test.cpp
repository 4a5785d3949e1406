// What is installed stands on what is installed: the list of public headers, held against every #include line.
#include <set>

#include <gtest/gtest.h>

#include "source_files.hpp"

namespace tilth::house {
namespace {

const std::filesystem::path kRoot = TILTH_SOURCE_DIR;

std::set<std::string> public_headers() {
  std::set<std::string> headers;
  for (const std::string& line : lines_of(read_text(kRoot / "cmake/public_headers.txt"))) {
    if (line.empty() || line.starts_with('#')) continue;
    EXPECT_TRUE(headers.insert("tilth/" + line).second) << line;
  }
  return headers;
}

TEST(PublicHeaders, IncludePublicHeadersOnly) {
  const std::set<std::string> headers = public_headers();
  ASSERT_TRUE(headers.contains("tilth/tilth.hpp"));
  for (const std::string& header : headers) {
    ASSERT_TRUE(std::filesystem::exists(kRoot / header)) << header;
    for (const std::string& include : includes_of(read_text(kRoot / header)))
      EXPECT_TRUE(!include.starts_with("tilth/") || headers.contains(include)) << header << " includes " << include;
  }
}

TEST(PublicHeaders, NeedNoLibraryButEigenAndTbb) {
  for (const std::string& header : public_headers()) {
    for (const std::string& include : includes_of(read_text(kRoot / header))) {
      const bool of_others = include.find('/') != std::string::npos || include.ends_with(".h");
      EXPECT_TRUE(!of_others || include.starts_with("tilth/") || include.starts_with("Eigen/") ||
                  include.starts_with("tbb/"))
          << header << " includes " << include;
    }
  }
}

}  // namespace
}  // namespace tilth::house
