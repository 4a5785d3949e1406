// The budget that keeps the house readable: lines of a file and of a function, parameters, nesting.
#include <gtest/gtest.h>

#include "function_scanner.hpp"
#include "source_files.hpp"

namespace tilth::house {
namespace {

constexpr std::size_t kFileLines = 200;
constexpr std::size_t kTestFileLines = 300;  // cases stand side by side and are read one at a time
constexpr std::size_t kFunctionLines = 40;
constexpr std::size_t kFormatFunctionLines = 60;  // in io: a format's rules stand best in one place
constexpr std::size_t kParameters = 5;
constexpr std::size_t kNesting = 3;

const char* const kSample = R"cpp(
  namespace a {
  template <class T>
  struct S {
    S(int x, std::map<int, int> y) : x_{x}, y_(y) { go(); }
    int operator()(int a, int b) const { return a + b; }
    std::array<int, 2> names{1, 2};
  };
  void nested() {
    for (const char c : "a{b") {
      if (c == '}') { /* { */
        while (true) call([&] { return 1; });
        for (int i = 0; i < 3; ++i) {
        }
      }
    }
  }
  }  // namespace a
)cpp";

TEST(FunctionScanner, FindsFunctionsParametersAndNesting) {
  const std::vector<FunctionText> found = functions_of(kSample);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].parameters, 2U);
  EXPECT_EQ(found[1].parameters, 2U);
  EXPECT_EQ(found[2].parameters, 0U);
  EXPECT_EQ(found[2].nesting, 3U);
  EXPECT_EQ(found[2].lines, 9U);
  EXPECT_EQ(found[2].line, 9U);
}

std::vector<SourceFile> all_files() {
  std::vector<SourceFile> files;
  for (const char* folder : {"tilth", "apps", "python", "ros2"}) {
    for (SourceFile& file : source_files(folder)) files.push_back(std::move(file));
  }
  return files;
}

TEST(SizeBudget, FilesAreShort) {
  for (const char* folder : {"tilth", "apps", "python", "ros2", "tests"}) {
    for (const SourceFile& file : source_files(folder)) {
      EXPECT_LE(lines_of(file.text).size(), file.path.starts_with("tests/") ? kTestFileLines : kFileLines) << file.path;
    }
  }
}

TEST(SizeBudget, FilesOfThePageAndThePackageAreShort) {
  for (const char* folder : {"/web/src", "/python/tilth"}) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(TILTH_SOURCE_DIR + std::string(folder))) {
      if (!entry.is_regular_file() || entry.path().extension() == ".pyc") continue;
      EXPECT_LE(lines_of(read_text(entry.path())).size(), kFileLines) << entry.path();
      ++count;
    }
    EXPECT_GT(count, 0U) << folder;
  }
}

TEST(SizeBudget, FunctionsAreShort) {
  for (const SourceFile& file : all_files()) {
    const std::size_t most = file.path.starts_with("tilth/io/") ? kFormatFunctionLines : kFunctionLines;
    for (const FunctionText& f : functions_of(file.text)) {
      EXPECT_LE(f.lines, most) << file.path << ":" << f.line << ": " << f.head;
    }
  }
}

TEST(SizeBudget, FunctionsTakeFewParameters) {
  for (const SourceFile& file : all_files()) {
    for (const FunctionText& f : functions_of(file.text)) {
      EXPECT_LE(f.parameters, kParameters) << file.path << ":" << f.line << ": " << f.head;
    }
  }
}

TEST(SizeBudget, BlocksAreShallow) {
  for (const SourceFile& file : all_files()) {
    for (const FunctionText& f : functions_of(file.text)) {
      EXPECT_LE(f.nesting, kNesting) << file.path << ":" << f.line << ": " << f.head;
    }
  }
}

}  // namespace
}  // namespace tilth::house
