// Messages that are parts of a turn, or several turns, become scans of one turn.
#include <cmath>
#include <numbers>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/recording/turn_stage.hpp>
#include <tilth/sensor/azimuth_arc.hpp>
#include <tilth/sensor/scan_decoder.hpp>

namespace tilth {
namespace {

const std::vector<double> kVlp16 = beams_deg(16, -15, 2);

/// One message after another of `degrees` each, as a sensor at 10 Hz sends them.
std::vector<Scan> messages_of(double degrees, int count, bool timed = true) {
  std::vector<Scan> messages;
  Spin spin{kVlp16, 0.1, 170, degrees, true, 5.0, 3600};
  for (int k = 0; k < count; ++k) {
    Scan message{spin.start, {}};
    for (const Shot& shot : shots_of(spin)) {
      message.cloud.points.push_back(shot.point);
      message.cloud.rings.push_back(std::uint16_t(shot.ring));
      if (timed) message.cloud.times.push_back(float(shot.time - spin.start));
    }
    messages.push_back(std::move(message));
    spin.start += 0.1 * degrees / 360.0;
    spin.start_deg -= degrees;
  }
  return messages;
}

std::vector<Scan> turns_of(const std::vector<Scan>& messages, TurnStage& stage) {
  std::vector<Scan> turns;
  for (const Scan& message : messages) {
    for (Scan& turn : stage.add(message)) turns.push_back(std::move(turn));
  }
  for (Scan& turn : stage.finish()) turns.push_back(std::move(turn));
  return turns;
}

/// Every scan is a turn of 0.1 s, one after the other, with the points of the sensor at their times.
void expect_turns(const std::vector<Scan>& turns, std::size_t count, double tolerance) {
  ASSERT_EQ(turns.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_NEAR(turns[k].stamp, 5.0 + 0.1 * double(k), tolerance) << k;
    ASSERT_TRUE(turns[k].cloud.has_times());
    ASSERT_TRUE(turns[k].cloud.has_rings());
    EXPECT_NEAR(double(turns[k].cloud.size()), 57600.0, 57600.0 * tolerance * 10);
    EXPECT_NEAR(duration(turns[k].cloud), 0.1, tolerance);
    for (std::size_t i = 0; i < turns[k].cloud.size(); i += 97) {
      const Eigen::Vector3d& p = turns[k].cloud.points[i];
      const double time = turns[k].stamp + double(turns[k].cloud.times[i]);
      const double azimuth = 170.0 * std::numbers::pi / 180.0 - (time - 5.0) * 20.0 * std::numbers::pi;
      ASSERT_NEAR(std::remainder(std::atan2(p.y(), p.x()) - azimuth, 2 * std::numbers::pi), 0.0, 1e-3) << k << " " << i;
    }
  }
}

TEST(AzimuthArc, IsAllButTheLongestGap) {
  const double degree = std::numbers::pi / 180.0;
  std::vector<Eigen::Vector3d> points;
  for (double azimuth = 150.5; azimuth < 230; azimuth += 0.5)
    points.emplace_back(3 * std::cos(azimuth * degree), 3 * std::sin(azimuth * degree), 1);
  EXPECT_NEAR(arc_of(points).width, 80 * degree, 1.1 * degree);
  EXPECT_NEAR(std::remainder(arc_of(points).centre() - 190 * degree, 2 * std::numbers::pi), 0.0, degree);
  EXPECT_EQ(arc_of({}).width, 0.0);
}

TEST(Turns, AreLeftAloneWhereMessagesAreTurns) {
  TurnStage stage;
  expect_turns(turns_of(messages_of(360, 9), stage), 9, 1e-3);
  EXPECT_EQ(stage.plan()->kind, TurnPlan::Kind::whole);
  EXPECT_TRUE(stage.plan()->sentence.empty());
}

TEST(Turns, ArePutTogetherFromHalvesThirdsAndEighths) {
  for (const int parts : {2, 3, 4, 8}) {
    TurnStage stage;
    expect_turns(turns_of(messages_of(360.0 / parts, 6 * parts), stage), 6, 1e-3);
    EXPECT_NEAR(stage.plan()->messages, parts, 0.05);
    EXPECT_NE(stage.plan()->sentence.find("are put together"), std::string::npos);
    EXPECT_TRUE(stage.notices().empty());
  }
}

TEST(Turns, ArePutTogetherFromPackets) {
  TurnStage stage;
  const std::vector<Scan> turns = turns_of(messages_of(4.8, 5 * 75), stage);  // 75 a turn
  expect_turns(turns, 5, 2e-3);
}

TEST(Turns, OfPartsThatAreNoWholeNumberAreAsLongAsOne) {
  TurnStage stage;
  const std::vector<Scan> turns = turns_of(messages_of(50, 72), stage);  // 7.2 a turn
  ASSERT_GE(turns.size(), 9u);
  for (const Scan& turn : turns) EXPECT_NEAR(duration(turn.cloud), 0.1, 0.1 * 50 / 360 + 1e-3);
}

TEST(Turns, PartsWithoutTimesHaveThoseOfTheirStamps) {
  TurnStage stage;
  expect_turns(turns_of(messages_of(4.8, 4 * 75, false), stage), 4, 2e-3);
}

TEST(Turns, GoOnWhereAPartIsMissing) {
  for (const int parts : {2, 8}) {
    std::vector<Scan> messages = messages_of(360.0 / parts, 8 * parts);
    messages.erase(messages.begin() + 5 * parts + 1);
    TurnStage stage;
    const std::vector<Scan> turns = turns_of(messages, stage);
    ASSERT_EQ(turns.size(), 8u);
    EXPECT_NEAR(turns[6].stamp, 5.6, 1e-6);
    EXPECT_NEAR(double(turns[5].cloud.size()), 57600.0 * (parts - 1) / parts, 1.0);
    EXPECT_EQ(stage.notices().size(), 1u);
  }
}

TEST(Turns, GoOnAfterAPauseAndARepeatedPart) {
  std::vector<Scan> messages = messages_of(180, 16);
  messages.erase(messages.begin() + 9, messages.begin() + 12);  // the second half of one turn, and all of the next
  messages.insert(messages.begin() + 3, messages[2]);
  TurnStage stage;
  const std::vector<Scan> turns = turns_of(messages, stage);
  ASSERT_EQ(turns.size(), 7u);
  EXPECT_NEAR(turns[5].stamp, 5.6, 1e-6);
  EXPECT_NEAR(double(turns[1].cloud.size()), 57600.0, 1.0);
  EXPECT_EQ(stage.notices().size(), 2u);
}

TEST(Turns, ACroppedViewIsNoPart) {
  for (const double degrees : {90.0, 180.0}) {
    TurnStage stage;
    std::vector<Scan> messages;
    for (int k = 0; k < 10; ++k) {
      messages.push_back(messages_of(degrees, 1).front());
      messages.back().stamp += 0.1 * k;
    }
    EXPECT_EQ(turns_of(messages, stage).size(), 10u);
    EXPECT_EQ(stage.plan()->kind, TurnPlan::Kind::whole);
  }
}

TEST(Turns, AreCutApart) {
  for (const int turns : {2, 3}) {
    for (const bool by_ring : {false, true}) {  // in the order of firing, or stored otherwise
      std::vector<Scan> messages = messages_of(360.0 * turns, 4);
      for (Scan& message : messages) {
        if (!by_ring) continue;
        std::vector<std::uint32_t> order;
        for (std::uint32_t ring = 0; ring < 16; ++ring) {
          for (std::uint32_t i = 0; i < message.cloud.size(); ++i) {
            if (message.cloud.rings[i] == ring) order.push_back(i);
          }
        }
        message.cloud = select(message.cloud, order);
      }
      TurnStage stage;
      expect_turns(turns_of(messages, stage), std::size_t(4 * turns), 1e-3);
      EXPECT_NE(stage.plan()->sentence.find("cut apart"), std::string::npos);
    }
  }
}

TEST(Turns, TimesOfSeveralInAMessageAreDerivedAndCut) {
  std::vector<StampedRecords> records;
  Spin spin{kVlp16, 0.1, 170, 720, true, 5.0, 3600};
  for (int k = 0; k < 4; ++k) {
    records.push_back({{spin.start, std::nullopt}, records_of(shots_of(spin), {ring_field()})});
    spin.start += 0.2;
  }
  const ScanDecoder decoder(records, {});
  std::vector<Scan> messages;
  for (const StampedRecords& r : records) messages.push_back(decoder.decode(r));
  TurnStage stage;
  expect_turns(turns_of(messages, stage), 8, 2e-3);
}

}  // namespace
}  // namespace tilth
