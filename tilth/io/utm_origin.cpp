#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/utm_origin.hpp>

namespace tilth {
namespace {

constexpr double kFarthest = 2e7;  // [m] beyond any easting, northing or height

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    words.push_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  words.push_back(text);
  return words;
}

template <class T>
bool parse(std::string_view word, T& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

bool parse_zone(std::string_view word, UtmOrigin& origin) {
  if (word.empty() || (word.back() != 'N' && word.back() != 'S')) return false;
  origin.north = word.back() == 'N';
  return parse(word.substr(0, word.size() - 1), origin.zone) && origin.zone >= 1 && origin.zone <= 60;
}

bool parse_lengths(const std::vector<std::string_view>& words, std::array<double, 4>& values) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (!parse(words[i], values[i - 1]) || !(std::abs(values[i - 1]) < kFarthest)) return false;
  }
  return true;
}

}  // namespace

UtmOrigin parse_utm_origin(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  UtmOrigin origin;
  std::array<double, 4> values{};
  if ((words.size() != 4 && words.size() != 5) || !parse_zone(words[0], origin) || !parse_lengths(words, values)) {
    throw Error("option origin",
                "is \"" + std::string(text) +
                    "\": expected zone and hemisphere of UTM, easting, northing and height in metres, "
                    "and the heading of the x axis in degrees from east, as 32N,691000,5335000,520,90");
  }
  const double heading = values[3] * std::numbers::pi / 180;
  origin.T_utm_world = Eigen::Translation3d(values[0], values[1], values[2]) *
                       Pose(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
  return origin;
}

std::string well_known_text(const std::optional<UtmOrigin>& origin) {
  const std::string metre = "UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]],";
  if (!origin) {
    return "LOCAL_CS[\"world of a Tilth map\",LOCAL_DATUM[\"first pose\",32767]," + metre +
           "AXIS[\"x\",EAST],AXIS[\"y\",NORTH],AXIS[\"z\",UP]]";
  }
  const std::string name = "WGS 84 / UTM zone " + std::to_string(origin->zone) + (origin->north ? "N" : "S");
  const auto parameter = [](const std::string& key, const std::string& value) {
    return "PARAMETER[\"" + key + "\"," + value + "],";
  };
  const int code = (origin->north ? 32600 : 32700) + origin->zone;
  return "PROJCS[\"" + name +
         "\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
         "84\",6378137,298.257223563,AUTHORITY[\"EPSG\",\"7030\"]],"
         "AUTHORITY[\"EPSG\",\"6326\"]],PRIMEM[\"Greenwich\",0,AUTHORITY[\"EPSG\",\"8901\"]],UNIT[\"degree\","
         "0.0174532925199433,AUTHORITY[\"EPSG\",\"9122\"]],AUTHORITY[\"EPSG\",\"4326\"]],"
         "PROJECTION[\"Transverse_Mercator\"]," +
         parameter("latitude_of_origin", "0") + parameter("central_meridian", std::to_string(6 * origin->zone - 183)) +
         parameter("scale_factor", "0.9996") + parameter("false_easting", "500000") +
         parameter("false_northing", origin->north ? "0" : "10000000") + metre +
         "AXIS[\"Easting\",EAST],AXIS[\"Northing\",NORTH],AUTHORITY[\"EPSG\",\"" + std::to_string(code) + "\"]]";
}

}  // namespace tilth
