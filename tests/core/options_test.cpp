#include <array>

#include <gtest/gtest.h>

#include <tilth/core/options.hpp>

namespace tilth {
namespace {

enum class Method { plain, weighted };
std::span<const std::string_view> names_of(Method) {
  static constexpr std::array<std::string_view, 2> names{"plain", "weighted"};
  return names;
}

struct InnerOptions {
  int k = 10;
  double alpha = 1.0;
  Method method = Method::weighted;
};
template <class V>
void visit(InnerOptions& o, V&& v) {
  v("k", o.k, Bounds{3, 64}, "[points] neighbours");
  v("alpha", o.alpha, Bounds{0, 10}, "[-] width", kAdvanced);
  v("method", o.method, "[-] kind");
}
struct OuterOptions {
  InnerOptions inner;
  bool deskew = true;
};
template <class V>
void visit(OuterOptions& o, V&& v) {
  v("inner", o.inner, "[-] inner stage");
  v("deskew", o.deskew, "[-] undo motion");
}

std::string message_of(const OptionValues& values) {
  try {
    with<OuterOptions>(values);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Options, AreSetByKey) {
  const auto o =
      with<OuterOptions>({{"inner.k", "12"}, {"inner.method", "plain"}, {"deskew", "false"}, {"inner.alpha", "0.25"}});
  EXPECT_EQ(o.inner.k, 12);
  EXPECT_EQ(o.inner.method, Method::plain);
  EXPECT_FALSE(o.deskew);
  EXPECT_EQ(o.inner.alpha, 0.25);
}

struct LabOptions {
  InnerOptions inner, other;
};
template <class V>
void visit(LabOptions& o, V&& v) {
  v("inner", o.inner, "[-] inner stage", kAdvanced);
  v("other", o.other, "[-] another one");
}

TEST(Options, AreAdvancedWhereTheyOrWhatHoldsThemAreMarked) {
  std::string advanced;
  for (const OptionInfo& row : describe(LabOptions{})) advanced += row.advanced ? 'a' : '-';
  EXPECT_EQ(advanced, "aaa-a-");
  EXPECT_EQ(with<LabOptions>({{"inner.alpha", "2"}}).inner.alpha, 2.0) << "can be set all the same";
}

TEST(Options, AreDescribedWithDefaultUnitAndBounds) {
  const auto rows = describe(OuterOptions{});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].key, "inner.k");
  EXPECT_EQ(rows[0].value, "10");
  EXPECT_EQ(rows[0].unit, "points");
  EXPECT_EQ(rows[0].meaning, "neighbours");
  EXPECT_EQ(rows[0].allowed, "3 .. 64");
  EXPECT_EQ(rows[2].allowed, "plain | weighted");
  EXPECT_EQ(rows[3].allowed, "true | false");
}

TEST(Options, RefusalsNameKeyValueAndBound) {
  EXPECT_EQ(message_of({{"inner.k", "2"}}), "option inner.k: is '2', expected a value in 3 .. 64");
  EXPECT_EQ(message_of({{"inner.k", "ten"}}), "option inner.k: is 'ten', expected a whole number");
  EXPECT_EQ(message_of({{"inner.alpha", "nan"}}), "option inner.alpha: is 'nan', expected a value in 0 .. 10");
  EXPECT_EQ(message_of({{"inner.method", "best"}}), "option inner.method: is 'best', expected one of plain | weighted");
  EXPECT_EQ(message_of({{"deskew", "yes"}}), "option deskew: is 'yes', expected true or false");
  EXPECT_NE(message_of({{"inner.kk", "3"}}).find("option inner.kk"), std::string::npos);
}

}  // namespace
}  // namespace tilth
