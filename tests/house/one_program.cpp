// Every header in one file and every room in one program.
#include <every_header.hpp>

#include <gtest/gtest.h>

namespace tilth {
namespace {

/// Values of types that several rooms could have called alike are made and destroyed where all of them are known.
TEST(OneProgram, MakesEveryPipeline) {
  for (const PipelineInfo& info : pipelines()) {
    Slam slam(make_odometry(info.name), {});
    slam.register_scan({0.0, {}});
    EXPECT_EQ(slam.trajectory().size(), 1U) << info.name;
  }
}

}  // namespace
}  // namespace tilth
