#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/config_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/times_file.hpp>

namespace tilth {
namespace {

OptionValues parsed(const std::string& text) {
  return parse_config(text, "a.yaml");
}

TEST(ConfigFile, NestedMapsAndDottedKeysAreTheSame) {
  const OptionValues expected{{"align.max_iterations", "12"}, {"align.sor.k", "20"}, {"name", "a b"}, {"on", "true"}};
  EXPECT_EQ(parsed("align:\n  max_iterations: 12\n  sor: {k: 20}\nname: a b\non: true\n"), expected);
  EXPECT_EQ(parsed("align.max_iterations: 12  # twelve\nalign.sor.k: 20\nname: 'a b'\non: true\n"), expected);
  EXPECT_TRUE(parsed("# nothing\n").empty());
  EXPECT_TRUE(parsed("").empty());
}

TEST(ConfigFile, IsReadFromDisk) {
  const TemporaryFolder folder;
  write_text(folder / "a.yaml", "a: {b: 1.5}\n");
  EXPECT_EQ(read_config(folder / "a.yaml"), (OptionValues{{"a.b", "1.5"}}));
  expect_error([&] { read_config(folder / "b.yaml"); }, {"b.yaml", "No such file"});
}

TEST(ConfigFile, ErrorsNameFileLineAndKey) {
  expect_error([] { parsed("a: 1\nb:\n  c: [1, 2]\n"); }, {"a.yaml, line 3", "key b.c is a list"});
  expect_error([] { parsed("a:\n"); }, {"a.yaml, line 1", "key a has no value"});
  expect_error([] { parsed("a: {}\n"); }, {"a.yaml, line 1", "key a has no value"});
  expect_error([] { parsed("a: 1\na: 2\n"); }, {"a.yaml, line 2", "key a is given twice"});
  expect_error([] { parsed("a.b: 1\na:\n  b: 2\n"); }, {"a.yaml, line 3", "key a.b is given twice"});
  expect_error([] { parsed("- 1\n- 2\n"); }, {"a.yaml", "no map"});
  expect_error([] { parsed("a: 1\nb: {c: 2\n"); }, {"a.yaml, line", "no YAML"});
  expect_error([] { parsed("[1]: 2\n"); }, {"a.yaml, line 1", "key that is no text"});
  expect_error([] { parsed("a: &x {b: *x}\n"); }, {"a.yaml"});
}

TEST(ConfigFile, AliasesThatGrowWithoutEndAreRefused) {
  std::string text = "l0: &l0 {a: 1, b: 2, c: 3, d: 4}\n";
  for (int i = 1; i < 12; ++i) {
    const std::string below = std::string("*l").append(std::to_string(i - 1)),
                      name = std::string("l").append(std::to_string(i));
    text += name + ": &" + name + " {a: " + below + ", b: " + below + ", c: " + below + ", d: " + below + "}\n";
  }
  expect_error([&] { parsed(text); }, {"a.yaml", "beyond 10000 values"});
}

TEST(ConfigFile, CorruptionNeverCrashes) {
  const std::string text = "align:\n  max_iterations: 12\n  sor: {k: 20, \"q\": 'x'}\nname: |\n  a b\n? on\n: true\n";
  expect_corruption_survived(bytes_of(text), 3000, [](const auto& bytes) {
    parsed({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  });
}

TEST(TimesFile, OneNumberALine) {
  EXPECT_EQ(parse_times("# s\n0.000000e+00\r\n\n 1.036224e-01\n", "times.txt"), (std::vector<double>{0, 0.1036224}));
  expect_error([] { parse_times("0\n1 2\n", "times.txt"); }, {"times.txt, line 2", "has 2 values, expected 1"});
  expect_error([] { parse_times("0\nx\n", "times.txt"); }, {"times.txt, line 2", "'x' is not a finite number"});
  expect_error([] { parse_times("\n", "times.txt"); }, {"times.txt", "holds no times"});
}

}  // namespace
}  // namespace tilth
