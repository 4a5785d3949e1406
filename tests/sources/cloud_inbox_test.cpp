// The newest clouds win, what makes way is counted, and nobody waits for ever.
#include <thread>

#include <gtest/gtest.h>

#include <tilth/sources/cloud_inbox.hpp>

namespace tilth {
namespace {

Message numbered(std::uint64_t number) {
  return {0, number, {}};
}

TEST(CloudInbox, KeepsTheNewestAndCountsTheRest) {
  CloudInbox inbox(3);
  for (std::uint64_t i = 0; i < 10; ++i) inbox.push(numbered(i));
  EXPECT_EQ(inbox.counts().received, 10U);
  EXPECT_EQ(inbox.counts().dropped, 7U);
  inbox.lose(2);
  EXPECT_EQ(inbox.counts().lost, 2U);
  for (std::uint64_t i = 7; i < 10; ++i) EXPECT_EQ(inbox.pop()->stamp, i);
}

TEST(CloudInbox, WaitsForTheNext) {
  CloudInbox inbox(1);
  std::jthread sender([&] { inbox.push(numbered(4)); });
  EXPECT_EQ(inbox.pop()->stamp, 4U);
}

TEST(CloudInbox, HasNothingOnceItIsClosed) {
  CloudInbox inbox(5);
  inbox.push(numbered(1));
  std::jthread closer([&] { inbox.close(); });
  while (inbox.pop()) {
  }
  inbox.push(numbered(2));
  EXPECT_FALSE(inbox.pop());
  EXPECT_TRUE(inbox.ended());
  EXPECT_EQ(inbox.counts().received, 1U) << "what came later is not counted";
}

}  // namespace
}  // namespace tilth
