#include <algorithm>
#include <cstdio>

#include <tilth/assessment/map_assessment.hpp>

namespace tilth {
namespace {

constexpr std::size_t kLeastCells = 3;     // that a doubled wall must fill to be told of
constexpr double kFewDoubled = 0.012;      // share of the surfaces that may be doubled: panes, hedges
constexpr double kManyDoubled = 0.04;      // share of the surfaces above which it is told even where they are apart
constexpr std::size_t kFewestDoubled = 5;  // cells of them
constexpr double kThick = 0.025;           // [m] median thickness from which on all surfaces are blurred
constexpr double kFewFlat = 0.05;          // share of the cells that hold a plane, below which all is blurred
constexpr std::size_t kMostWalls = 3;      // that are told of

std::string minute_text(double seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "minute %d (%.0f s)", 1 + int(seconds / 60), seconds);
  return text;
}

std::string wall_text(const DoubledWall& wall, double seconds) {
  char text[200];
  std::snprintf(text, sizeof text, "look at %s: two walls %.0f cm apart over about %.0f m2 near (%.1f, %.1f, %.1f)",
                minute_text(seconds).c_str(), 100 * wall.gap, 0.64 * double(wall.cells), double(wall.place.x()),
                double(wall.place.y()), double(wall.place.z()));
  return text;
}

void find_losses(std::span<const AssessedScan> scans, MapAssessment& to) {
  const auto lost =
      std::find_if(scans.begin(), scans.end(), [](const AssessedScan& scan) { return scan.track == TrackState::lost; });
  if (lost != scans.end())
    to.findings.push_back("look at " + minute_text(lost->stamp - scans.front().stamp) + ": the track was lost");
}

void find_walls(std::span<const AssessedScan> scans, MapAssessment& to) {
  if (double(to.doubled.doubled) <= kFewDoubled * double(to.doubled.planes)) return;
  std::size_t told = 0;
  for (const DoubledWall& wall : to.doubled.walls) {
    if (wall.cells < kLeastCells || told++ == kMostWalls) break;
    const double seconds = wall.scan < scans.size() ? scans[wall.scan].stamp - scans.front().stamp : 0;
    to.findings.push_back(wall_text(wall, seconds));
  }
  const double share = double(to.doubled.doubled) / double(std::max<std::size_t>(1, to.doubled.planes));
  if (told > 0 || share < kManyDoubled || to.doubled.doubled < kFewestDoubled) return;
  to.findings.push_back("one wall in " + std::to_string(int(1 / share + 0.5)) + " is there twice, here and there");
}

}  // namespace

std::string MapAssessment::verdict() const {
  std::string text;
  for (const std::string& finding : findings) text += (text.empty() ? "" : "; ") + finding;
  return text.empty() ? "good" : text;
}

MapAssessment assess_map(std::span<const ScannedPoint> points, std::span<const AssessedScan> scans) {
  MapAssessment assessment;
  std::vector<Eigen::Vector3f> places;
  for (const ScannedPoint& p : points) places.push_back(p.point);
  assessment.quality = quality_of(places);
  assessment.doubled = doubled_walls(points);
  assessment.scans = scans.size();
  assessment.not_tracked = std::size_t(std::count_if(scans.begin(), scans.end(), [](const AssessedScan& scan) {
    return scan.track == TrackState::lost || scan.track == TrackState::coasting;
  }));
  if (assessment.quality.cells == 0) {
    assessment.findings.emplace_back("the map has too few points to be judged");
    return assessment;
  }
  find_losses(scans, assessment);
  find_walls(scans, assessment);
  if (assessment.quality.thickness_median > kThick) {
    char text[96];
    std::snprintf(text, sizeof text, "surfaces are %.1f cm thick (median): look at times, beams and mount",
                  100 * assessment.quality.thickness_median);
    assessment.findings.emplace_back(text);
  }
  if (double(assessment.quality.planes) < kFewFlat * double(assessment.quality.cells))
    assessment.findings.emplace_back("hardly a surface is flat: look at times, beams and mount");
  return assessment;
}

}  // namespace tilth
