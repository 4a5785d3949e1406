// A run that is saved while it goes on can be continued from whatever the folder holds.
#include <io/temporary_folder.hpp>
#include <run/scan_list.hpp>

#include <gtest/gtest.h>

#include <tilth/io/trajectory_file.hpp>
#include <tilth/run/journal_sink.hpp>
#include <tilth/run/session.hpp>

namespace tilth {
namespace {

constexpr double kNever = 1e9, kAlways = 0.0;  // [s] between checkpoints

std::unique_ptr<Session> journaled(const TemporaryFolder& folder, std::vector<Scan> scans, double checkpoint,
                                   RunObserver& observer) {
  auto session =
      std::make_unique<Session>(std::make_unique<ScanList>(std::move(scans)), Pipeline{std::make_unique<MetreAScan>()});
  session->add(std::make_unique<JournalSink>(folder / "", checkpoint, observer));
  return session;
}

TEST(JournalSink, EveryPoseStandsInTheFolderAtOnce) {
  const TemporaryFolder folder;
  RunObserver deaf;
  EXPECT_FALSE(holds_run(folder / ""));
  const auto session = journaled(folder, small_scans(4), kNever, deaf);
  EXPECT_EQ(session->run(), RunEnd::end_of_input);  // and never finish()
  EXPECT_TRUE(holds_run(folder / ""));
  RunRecord record;
  EXPECT_EQ(continue_run(folder / "", record).size(), 1U) << "there is no map yet";
  EXPECT_EQ(record.trajectory.size(), 4U);
  EXPECT_EQ(record.map.size(), 0U);
}

TEST(JournalSink, AMapIsSavedMeanwhile) {
  const TemporaryFolder folder;
  RunObserver deaf;
  journaled(folder, small_scans(4), kAlways, deaf)->run();  // its end waits for what is being saved
  RunRecord record;
  EXPECT_EQ(continue_run(folder / "", record), std::vector<std::string>{});
  EXPECT_GE(record.map.size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder / "summary.json"));
}

TEST(JournalSink, HoldsPosesOfTheBaseAndGoesOnWithTheSameMountOnly) {
  const TemporaryFolder folder;
  RunObserver deaf;
  RunRecord begun;
  begun.T_base_lidar = Pose(Eigen::Translation3d(0.5, 0, 0.25) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  {
    Session session(std::make_unique<ScanList>(small_scans(4)), {std::make_unique<MetreAScan>()}, begun);
    session.add(std::make_unique<JournalSink>(folder / "", kAlways, deaf));
    session.run();
  }
  const Pose T_world_base = read_tum(folder / "trajectory.tum").back().T_world_lidar;
  EXPECT_TRUE((T_world_base * *begun.T_base_lidar).isApprox(Pose(Eigen::Translation3d(3, 0, 0)), 1e-12));
  continue_run(folder / "", begun);
  EXPECT_TRUE(begun.trajectory.back().T_world_lidar.isApprox(Pose(Eigen::Translation3d(3, 0, 0)), 1e-12));
  RunRecord other;
  EXPECT_THROW(continue_run(folder / "", other), Error);
  other.T_base_lidar = Pose::Identity();
  EXPECT_THROW(continue_run(folder / "", other), Error);
}

TEST(JournalSink, RefusesStampsThatGoBack) {
  const TemporaryFolder folder;
  RunObserver deaf;
  std::vector<Scan> scans = small_scans(3);
  scans[2].stamp = scans[1].stamp;
  EXPECT_THROW(journaled(folder, scans, kNever, deaf)->run(), Error);
  EXPECT_EQ(read_tum(folder / "trajectory.tum").size(), 2U);
}

TEST(JournalSink, IsRemovedWithItsRun) {
  const TemporaryFolder folder;
  RunObserver deaf;
  const auto session = journaled(folder, small_scans(3), kNever, deaf);
  session->run();
  EXPECT_EQ(session->finish(), std::vector<std::string>{});
  EXPECT_TRUE(std::filesystem::exists(folder / "map.pcd"));
  remove_run(folder / "", {});
  EXPECT_FALSE(holds_run(folder / ""));
  EXPECT_FALSE(std::filesystem::exists(folder / "map.pcd"));
}

}  // namespace
}  // namespace tilth
