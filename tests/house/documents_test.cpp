// C++ that documents show is C++ that is built and run: part of one of the examples, line by line.
#include <gtest/gtest.h>

#include "source_files.hpp"

namespace tilth::house {
namespace {

std::vector<std::string> cpp_blocks_of(const std::string& markdown) {
  const std::string fence = "```cpp\n";
  std::vector<std::string> blocks;
  for (std::size_t begin = markdown.find(fence); begin != std::string::npos; begin = markdown.find(fence, begin)) {
    begin += fence.size();
    blocks.push_back(markdown.substr(begin, markdown.find("```", begin) - begin));
  }
  return blocks;
}

TEST(Documents, ShowTheExamples) {
  const std::filesystem::path root = TILTH_SOURCE_DIR;
  for (const char* document : {"README.md", "README.zh.md", "docs/library.md"}) {
    const std::vector<std::string> blocks = cpp_blocks_of(read_text(root / document));
    EXPECT_FALSE(blocks.empty()) << document;
    for (const std::string& block : blocks) {
      const std::vector<SourceFile> examples = source_files("examples");
      EXPECT_TRUE(std::any_of(examples.begin(), examples.end(),
                              [&](const SourceFile& example) { return example.text.find(block) != std::string::npos; }))
          << document << " shows\n"
          << block;
    }
  }
}

}  // namespace
}  // namespace tilth::house
