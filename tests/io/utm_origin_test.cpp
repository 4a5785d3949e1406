// Where a map lies on the Earth, as text.
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/io/utm_origin.hpp>

namespace tilth {
namespace {

TEST(UtmOrigin, IsReadFromText) {
  const UtmOrigin origin = parse_utm_origin("32N,691000.5,5335000,520.25");
  EXPECT_EQ(origin.zone, 32);
  EXPECT_TRUE(origin.north);
  EXPECT_TRUE(origin.T_utm_world.translation().isApprox(Eigen::Vector3d(691000.5, 5335000, 520.25)));
  EXPECT_TRUE(origin.T_utm_world.linear().isIdentity(1e-12));
  const UtmOrigin turned = parse_utm_origin("1S,500000,10,-3,90");
  EXPECT_FALSE(turned.north);
  const Eigen::Vector3d ahead = turned.T_utm_world * Eigen::Vector3d(2, 0, 1);  // x points north
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(500000, 12, -2), 1e-9));
}

TEST(UtmOrigin, RefusesWhatItIsNot) {
  for (const char* text :
       {"", "32N", "32N,1,2", "32,1,2,3", "N,1,2,3", "0N,1,2,3", "61S,1,2,3", "32E,1,2,3", "32N,1,2,3,4,5", "32N,1,,3",
        "32N,1,2,x", "32N,1,2,3 ", "32N,nan,2,3", "32N,inf,2,3", "32N,1e9,2,3", "999999999999N,1,2,3", ",,,"}) {
    EXPECT_THROW(parse_utm_origin(text), Error) << text;
  }
}

TEST(UtmOrigin, NamesItsReferenceSystem) {
  EXPECT_NE(well_known_text(parse_utm_origin("32N,1,2,3")).find("AUTHORITY[\"EPSG\",\"32632\"]]"), std::string::npos);
  const std::string south = well_known_text(parse_utm_origin("60S,1,2,3"));
  EXPECT_NE(south.find("AUTHORITY[\"EPSG\",\"32760\"]]"), std::string::npos);
  EXPECT_NE(south.find("\"central_meridian\",177]"), std::string::npos);
  EXPECT_EQ(well_known_text({}).substr(0, 9), "LOCAL_CS[");
}

}  // namespace
}  // namespace tilth
