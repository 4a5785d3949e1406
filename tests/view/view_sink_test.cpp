// A run that is watched: every scan reaches who looks, nothing is made for nobody, and what cannot be sent ends no run.
#include <run/scan_list.hpp>

#include <gtest/gtest.h>

#include "raw_client.hpp"
#include <tilth/run/session.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth {
namespace {

std::vector<std::string> watched(std::vector<Scan> scans, const std::shared_ptr<ViewServer>& server) {
  Session session(std::make_unique<ScanList>(std::move(scans)), {std::make_unique<MetreAScan>()});
  session.add(std::make_unique<ViewSink>(server));
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  return session.finish();
}

TEST(ViewSink, SendsEveryScanAndTheWholeInTheEnd) {
  const auto server = std::make_shared<ViewServer>(ViewAddress{"127.0.0.1", 0}, "run");
  const RawClient client(server->port());
  subscribe(client, "12456");
  ASSERT_TRUE(becomes_wanted(*server, RunTopic::diagnostics));
  EXPECT_EQ(watched(small_scans(20), server), std::vector<std::string>{});
  const std::string all = client.receive("", 1000);
  const auto heads = [&](char subscription) {
    const std::string head{1, subscription, 0, 0, 0};
    std::size_t count = 0;
    for (std::size_t at = all.find(head); at != std::string::npos; at = all.find(head, at + 1)) ++count;
    return count;
  };
  EXPECT_GE(heads(4), 20U) << "odometry";
  EXPECT_GE(heads(6), 20U) << "diagnostics";
  EXPECT_GE(heads(1), 1U) << "path";
  EXPECT_GE(heads(2), 1U) << "map";
  EXPECT_GE(heads(5), 1U) << "scan: three wait at most";
}

TEST(ViewSink, KeepsWhatCannotBeSentForTheEnd) {
  const auto server = std::make_shared<ViewServer>(ViewAddress{"127.0.0.1", 0}, "run");
  const RawClient client(server->port());
  subscribe(client, "3");
  ASSERT_TRUE(becomes_wanted(*server, RunTopic::tf));
  std::vector<Scan> scans = small_scans(3);
  for (Scan& scan : scans) scan.stamp -= 10;  // before 1970, which ROS cannot tell
  const std::vector<std::string> failures = watched(scans, server);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_NE(failures[0].find("view"), std::string::npos) << failures[0];
}

}  // namespace
}  // namespace tilth
