// Every name once: two types of one name, in two files of one program, are undefined behaviour that no linker notices.
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "source_files.hpp"

namespace tilth::house {
namespace {

struct NamedType {
  std::string name;  ///< "tilth::app::RunEnd"
  bool is_local;     ///< in an anonymous namespace
};

/// The types that a file defines in its namespaces. Formatting keeps those at the margin, as it does their ends.
std::vector<NamedType> types_of(const std::string& text) {
  const std::regex space(R"(^(?:inline )?namespace ([\w:]*) ?\{$)");
  const std::regex type(
      R"(^(?:struct|class|union|enum(?: class)?) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: :.*| \{.*)$)");
  std::vector<std::string> open;
  std::vector<NamedType> types;
  std::smatch match;
  for (const std::string& line : lines_of(text)) {
    if (std::regex_match(line, match, space)) open.push_back(match[1]);
    if (line.starts_with("}  // namespace") && !open.empty()) open.pop_back();
    if (!std::regex_match(line, match, type)) continue;
    NamedType found{"", false};
    for (const std::string& name : open) {
      found.is_local |= name.empty();
      if (!name.empty()) found.name += name + "::";
    }
    found.name += match[1];
    types.push_back(found);
  }
  return types;
}

TEST(Names, AreReadFromSources) {
  const std::vector<NamedType> types = types_of(
      "namespace tilth {\nstruct A {\n  struct Inner {};\n};\nnamespace {\n"
      "class B : public A {\n};\nenum class C { d };\n}  // namespace\n"
      "enum class E : int { f };\nclass Declared;\n}  // namespace tilth\n");
  ASSERT_EQ(types.size(), 4U);
  EXPECT_EQ(types[0].name, "tilth::A");
  EXPECT_EQ(types[1].name, "tilth::B");
  EXPECT_TRUE(types[1].is_local && types[2].is_local && !types[3].is_local);
}

/// Where each type is defined that a whole program sees.
std::map<std::string, std::vector<std::string>> shared_types(const std::string& folder) {
  std::map<std::string, std::vector<std::string>> where;
  for (const SourceFile& file : source_files(folder)) {
    for (const NamedType& type : types_of(file.text)) {
      if (!type.is_local) where[type.name].push_back(file.path);
    }
  }
  return where;
}

TEST(Names, ATypeIsDefinedOnce) {
  for (const char* folder : {"tilth", "apps", "python", "tests", "bench"}) {
    for (const auto& [name, files] : shared_types(folder))
      EXPECT_EQ(files.size(), 1U) << name << " is defined in " << files.front() << " and " << files.back();
  }
}

TEST(Names, NoLocalTypeHidesASharedOne) {
  const auto shared = shared_types("tilth");
  for (const SourceFile& file : source_files("tilth")) {
    for (const NamedType& type : types_of(file.text)) {
      const auto other = shared.find(type.name);
      if (!type.is_local || other == shared.end()) continue;
      ADD_FAILURE() << type.name << " of " << file.path << " is also in " << other->second.front();
    }
  }
}

/// Whether the lines at `i` begin a function that several files may define alike: an inline one, or a template that is
/// no member of a class.
bool begins_shared_function(const std::vector<std::string>& lines, std::size_t i) {
  const std::regex member(R"([\w>]::(operator\W+|~?\w+)\()");
  if (lines[i].starts_with("inline ")) return true;
  return lines[i].starts_with("template <") && i + 1 < lines.size() && !std::regex_search(lines[i + 1], member);
}

/// They belong in headers, which one_program.cpp sees all together, or in anonymous namespaces.
TEST(Names, SourcesDefineNoSharedInlineFunctions) {
  for (const char* folder : {"tilth", "apps", "python"}) {
    for (const SourceFile& file : source_files(folder)) {
      if (!file.path.ends_with(".cpp")) continue;
      const std::vector<std::string> lines = lines_of(file.text);
      int anonymous = 0;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        anonymous += lines[i] == "namespace {";
        anonymous -= lines[i] == "}  // namespace";
        EXPECT_FALSE(anonymous == 0 && begins_shared_function(lines, i)) << file.path << ": " << lines[i];
      }
    }
  }
}

}  // namespace
}  // namespace tilth::house
