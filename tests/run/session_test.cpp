// A run without a program: what reaches sinks and observers, and how it ends.
#include <algorithm>
#include <memory>
#include <run/scan_list.hpp>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/session.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

/// Counts what it is given; refuses the scan of number `refused`.
class CountingSink : public Sink {
 public:
  explicit CountingSink(std::vector<std::size_t>& poses, std::size_t refused = 0) : poses_(poses), refused_(refused) {}

  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override {
    EXPECT_EQ(record.trajectory.back().stamp, result.stamp);
    EXPECT_EQ(record.scans.rows.back().points_read, scan.cloud.size());
    if (record.trajectory.size() == refused_) throw Error("disk", "is full");
    poses_.push_back(record.trajectory.size());
  }
  void finish(const RunRecord& record) override { poses_.push_back(100 + record.trajectory.size()); }

 private:
  std::vector<std::size_t>& poses_;
  std::size_t refused_;
};

struct Listener : RunObserver {
  void note(const std::string& text) override { notes.push_back(text); }
  void warn(const std::string& text) override { warnings.push_back(text); }
  void progress(std::size_t scans, std::optional<std::size_t> total) override { last = {scans, total.value_or(0)}; }
  std::vector<std::string> notes, warnings;
  std::pair<std::size_t, std::size_t> last;
};

Session session_of(std::unique_ptr<ScanList> source) {
  return {std::move(source), {std::make_unique<MetreAScan>()}};
}

Session session_of(std::vector<Scan> scans) {
  return session_of(std::make_unique<ScanList>(std::move(scans)));
}

TEST(Session, HandsEveryScanToEverySink) {
  std::vector<std::size_t> first, second;
  Session session = session_of(small_scans(3));
  session.add(std::make_unique<CountingSink>(first));
  session.add(std::make_unique<CountingSink>(second));
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  EXPECT_EQ(session.finish(), std::vector<std::string>{});
  EXPECT_EQ(first, (std::vector<std::size_t>{1, 2, 3, 103}));
  EXPECT_EQ(second, first);
  const RunRecord& record = session.record();
  EXPECT_EQ(record.ended, "end of input");
  EXPECT_EQ(record.scans.stages, std::vector<std::string>{"step"});
  EXPECT_EQ(record.map.size(), 3U);
  EXPECT_EQ(record.trajectory.back().T_world_lidar.translation().x(), 2.0);
}

TEST(Session, TellsWhoListens) {
  auto source = std::make_unique<ScanList>(small_scans(4));
  source->skips_at = 2;
  Listener listener;
  Session session = session_of(std::move(source));
  session.observe(listener);
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  EXPECT_EQ(listener.notes, (std::vector<std::string>{"times are made up", "a packet was lost"}));
  ASSERT_FALSE(listener.warnings.empty());
  EXPECT_EQ(listener.warnings.front(), "skipped: record 7: is no scan");
  EXPECT_NE(listener.warnings.back().find("All intensities are alike"), std::string::npos);
  EXPECT_EQ(session.record().notices.back(), listener.warnings.back()) << "as tilth info warns";
  EXPECT_EQ(listener.last, (std::pair<std::size_t, std::size_t>(4, 4)));
}

TEST(Session, PassesOverAScanThatCannotBeRegistered) {
  std::vector<Scan> scans = small_scans(5);
  scans[1].cloud = {};
  Session session = session_of(scans);
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  EXPECT_EQ(session.record().trajectory.size(), 4U);
  ASSERT_EQ(session.record().skipped.size(), 1U);
  EXPECT_EQ(session.record().skipped[0].index, 1U);
  Session strict = session_of(scans);
  EXPECT_EQ(strict.run({.strict = true}), RunEnd::bad_record);
  EXPECT_EQ(strict.record().trajectory.size(), 1U);
}

TEST(Session, WarnsOfTenRecordsAndCountsAll) {
  Listener listener;
  Session session = session_of(std::vector<Scan>(15));
  session.observe(listener);
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  const auto of_skipped = [](const std::string& warning) { return warning.find("skipped") != std::string::npos; };
  EXPECT_EQ(std::count_if(listener.warnings.begin(), listener.warnings.end(), of_skipped), 11);
  EXPECT_EQ(session.record().skipped.size(), 15U);
}

TEST(Session, KeepsWhatCameBeforeTheInputBroke) {
  auto source = std::make_unique<ScanList>(small_scans(5));
  source->breaks_off_at = 3;
  Session session = session_of(std::move(source));
  EXPECT_EQ(session.run(), RunEnd::input_broken);
  EXPECT_EQ(session.record().ended, "the input breaks off");
  EXPECT_EQ(session.record().trajectory.size(), 3U);
  EXPECT_NE(session.record().skipped.at(0).what.find("is torn"), std::string::npos);
}

TEST(Session, EndsWhenItIsAskedTo) {
  Session few = session_of(small_scans(5));
  EXPECT_EQ(few.run({.max_scans = 2}), RunEnd::max_scans);
  EXPECT_EQ(few.record().trajectory.size(), 2U);
  Session stopped = session_of(small_scans(5));
  int asked = 0;
  EXPECT_EQ(stopped.run({.interrupted = [&] { return ++asked == 4; }}), RunEnd::interrupted);
  EXPECT_EQ(stopped.record().trajectory.size(), 3U);
}

TEST(Session, GoesNoFurtherWhereASinkRefuses) {
  std::vector<std::size_t> poses;
  Session session = session_of(small_scans(5));
  session.add(std::make_unique<CountingSink>(poses, 3));
  EXPECT_THROW(session.run(), Error);
  EXPECT_EQ(poses.size(), 2U);
}

TEST(Session, ClosesTheLoopsAtItsEnd) {
  Session session(std::make_unique<ScanList>(small_scans(6)),
                  with_loop_closure({std::make_unique<MetreAScan>()}, SlamOptions{}));
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  ASSERT_TRUE(session.record().loops.has_value());
  EXPECT_EQ(session.record().loops->odometry.size(), 6U);
  EXPECT_GE(session.record().loops->keyframe_scans.size(), 2U);
}

TEST(Session, RunsARecording) {
  Session session(open_source("sim://corridor?duration=1", {}), {make_odometry("tilth", {})});
  EXPECT_EQ(session.run(), RunEnd::end_of_input);
  EXPECT_EQ(session.record().trajectory.size(), 9U) << "whole turns at 10 Hz";
  EXPECT_EQ(session.record().trajectory.front().T_world_lidar.translation().norm(), 0.0);
  EXPECT_GT(session.record().map.size(), 1000U);
}

}  // namespace
}  // namespace tilth
