// The period of the spin where turns were left out of the recording: sensors fire at a rate of their own.
#include <algorithm>
#include <cmath>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/sensor/firing_cycle.hpp>
#include <tilth/sensor/scan_decoder.hpp>

namespace tilth {
namespace {

struct Sensor {
  const char* name;
  double period;         ///< [s]
  int columns;           ///< a turn
  int recorded = 1;      ///< every so many turns
  double covered = 360;  ///< [deg] a scan
  const char* said = "from the stamps";
};

std::ostream& operator<<(std::ostream& out, const Sensor& sensor) {
  return out << sensor.name;
}

class SpinOf : public testing::TestWithParam<Sensor> {};

TEST_P(SpinOf, IsThatOfTheSensorHoweverManyTurnsWereRecorded) {
  const Sensor& sensor = GetParam();
  std::vector<StampedRecords> recording;
  for (int k = 0; k < 8; ++k) {
    const double turns = double(sensor.recorded * k) * sensor.covered / 360.0;
    const Spin spin{beams_deg(16, -15, 2),       sensor.period, 170 - 360 * turns, sensor.covered, true,
                    1e9 + turns * sensor.period, sensor.columns};
    recording.push_back({{spin.start, std::nullopt}, records_of(shots_of(spin), {ring_field()})});
  }
  const ScanDecoder decoder(recording, {});
  const std::string& decision = decoder.decisions()[3];
  EXPECT_NE(decision.find(sensor.said), std::string::npos) << decision;
  const Scan scan = decoder.decode(recording[1]);
  ASSERT_TRUE(scan.cloud.has_times());
  EXPECT_NEAR(scan.cloud.times.back(), sensor.period * sensor.covered / 360.0, 0.002 * sensor.period);
}

INSTANTIATE_TEST_SUITE_P(
    Sensors, SpinOf,
    testing::Values(Sensor{"vlp16_10Hz", 0.1, 1808}, Sensor{"vlp16_5Hz", 0.2, 3617}, Sensor{"vlp16_20Hz", 0.05, 904},
                    Sensor{"vlp16_second", 0.1, 1808, 2, 360, "and 1 of 2 turns not recorded"},
                    Sensor{"vlp16_fifth", 0.1, 1808, 5, 360, "and 4 of 5 turns not recorded"},
                    Sensor{"vlp16_tenth", 0.1, 1808, 10, 360, "and 9 of 10 turns not recorded"},
                    Sensor{"vlp16_20Hz_third", 0.05, 904, 3, 360, "and 2 of 3 turns not recorded"},
                    Sensor{"vlp16_5Hz_second", 0.2, 3617, 2, 360, "and 1 of 2 turns not recorded"},
                    Sensor{"hesai_third", 0.1, 2000, 3, 360, "and 2 of 3 turns not recorded"},
                    Sensor{"ouster_second", 0.1, 1024, 2, 360, "and 1 of 2 turns not recorded"},
                    Sensor{"wandering_cut", 0.1, 1808, 1, 363}, Sensor{"wandering_cut_5Hz", 0.2, 3617, 1, 363},
                    Sensor{"wandering_cut_second", 0.1, 1808, 2, 363, "and 1 of 2 turns not recorded"},
                    Sensor{"thinned_10Hz", 0.1, 904}, Sensor{"unknown_5Hz", 0.2, 600}),
    [](const auto& p) { return std::string(p.param.name); });

TEST(ColumnStep, IsThatOfNeighboursOfABeam) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint16_t> rings;
  for (const Shot& shot : shots_of({beams_deg(16, -15, 2), 0.1, 170, 360, true, 0.0, 1808})) {
    if (shot.ring % 3 == 0 && std::sin(40.0 * shot.time) > 0.5) continue;  // no returns there
    points.push_back(shot.point);
    rings.push_back(std::uint16_t(shot.ring));
    if (shot.ring > 7) points.push_back(1.1 * shot.point), rings.push_back(std::uint16_t(shot.ring));  // two echoes
  }
  ASSERT_TRUE(column_step(points, rings));
  EXPECT_NEAR(*column_step(points, rings), 2 * std::numbers::pi / 1808, 1e-6);
  EXPECT_FALSE(column_step(points, {}));
  EXPECT_FALSE(column_step(std::span(points).first(40), std::span(rings).first(40)));
}

}  // namespace
}  // namespace tilth
