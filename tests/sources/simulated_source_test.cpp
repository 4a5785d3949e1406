// sim:// gives the scans that the simulator makes, and refuses what it does not know by name.
#include <algorithm>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/simulation/simulator.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

TEST(SimulatedSource, GivesTheScansOfTheSimulator) {
  const auto source = open_source("sim://corridor?seed=3&duration=1&columns=100", {});
  const Simulator simulator("corridor",
                            simulation_options("corridor", {{"seed", "3"}, {"duration", "1"}, {"columns", "100"}}));
  ASSERT_EQ(source->size(), simulator.size());
  std::size_t count = 0;
  while (const std::optional<Scan> scan = source->next()) {
    const LabelledScan made = simulator.scan(count++);
    EXPECT_EQ(scan->stamp, made.scan.stamp);
    EXPECT_EQ(scan->cloud.points, made.scan.cloud.points);
    EXPECT_EQ(scan->cloud.times, made.scan.cloud.times);
    EXPECT_EQ(scan->cloud.rings, made.scan.cloud.rings);
  }
  EXPECT_EQ(count, 9u);
  EXPECT_FALSE(source->decisions().empty());
}

TEST(SimulatedSource, TakesTheErrorsOfBeams) {
  const auto source = open_source("sim://corridor?seed=3&duration=1&columns=100&beams=worn&beam_azimuth=0.1", {});
  const OptionValues values{
      {"seed", "3"}, {"duration", "1"}, {"columns", "100"}, {"beams", "worn"}, {"beam_azimuth", "0.1"}};
  const Simulator simulator("corridor", simulation_options("corridor", values));
  EXPECT_FALSE(simulator.beams().azimuth.empty());
  EXPECT_EQ(source->next()->cloud.points, simulator.scan(0).scan.cloud.points);
  EXPECT_EQ(std::count(source->decisions().begin(), source->decisions().end(), "beams: simulated with constant errors"),
            1);
}

TEST(SimulatedSource, RefusesWhatItDoesNotKnow) {
  for (const char* uri : {"sim://", "sim://corridoor", "sim://corridor?nosie=1", "sim://corridor?noise",
                          "sim://corridor?noise=", "sim://corridor?seed=-1", "sim://corridor?sensor=vlp17",
                          "sim://corridor?beams=bent", "sim://corridor?sensor=rosette&walk=0.01"}) {
    EXPECT_THROW(open_source(uri, {}), Error) << uri;
  }
}

}  // namespace
}  // namespace tilth
