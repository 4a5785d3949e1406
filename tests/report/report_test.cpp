// The report as text: nothing that a name holds becomes markup, every number of a curve arrives, drawings are whole.
#include <cmath>
#include <cstring>
#include <fstream>
#include <io/temporary_folder.hpp>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/plot/curve_thinning.hpp>
#include <tilth/plot/svg_canvas.hpp>
#include <tilth/plot/svg_frame.hpp>
#include <tilth/plot/svg_plot.hpp>
#include <tilth/report/html_report.hpp>
#include <tilth/report/report_json.hpp>
#include <tilth/report/run_report.hpp>

namespace tilth {
namespace {

const std::string kHostile = "</script><script>alert(1)</script>\"'><img src=x onerror=alert(2)>\n<!-- & \x01\xFF";

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A run along a bend, 0.1 s and 0.5 m a scan; the truth lies 1 cm beside it.
RunRecord bent_run(const std::string& name) {
  RunRecord record;
  record.source = record.pipeline = record.machine = record.ended = name;
  record.decisions = {name};
  record.skipped = {{3, name, name}};
  record.options = {{"k", "5", "-", name, ""}, {"same", "1", "-", "", ""}};
  record.defaults = {{"k", "10", "-", name, ""}, {"same", "1", "-", "", ""}};
  record.scans.stages = {name};
  Trajectory truth;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.05 * i;
    const Pose T = Eigen::Translation3d(10 * std::sin(angle), 10 - 10 * std::cos(angle), 0.0) *
                   Pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    record.trajectory.push_back({100 + 0.1 * i, T});
    truth.push_back({100 + 0.1 * i, T * Eigen::Translation3d(0, i % 2 == 0 ? 0.01 : -0.01, 0)});
    ScanRow row;
    row.stamp = 100 + 0.1 * i;
    row.register_ms = 5 + i % 3;
    row.stage_ms = {1.0 + i % 2};
    record.scans.rows.push_back(row);
    PointCloud cloud;
    cloud.points = {{1, 2, 0.3}, {-1, 2, 1.5}};
    cloud.intensities = {float(i), 1};
    record.map.add(cloud, T, 0.0, {});
  }
  record.evaluation = evaluate(truth, record.trajectory, {});
  return record;
}

std::vector<float> floats_of(const std::string& base64_text) {
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0, bits = 0;
  for (const char c : base64_text) {
    if (c == '=') break;
    group = group << 6U | unsigned(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += char(group >> bits & 0xffU);
  }
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

TEST(MarkupText, LeavesNothingThatIsMarkup) {
  EXPECT_EQ(markup_text("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
  EXPECT_EQ(markup_text("Straße 点\n"), "Straße 点\n");
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_EQ(markup_text("\x01"), unknown);
  EXPECT_EQ(markup_text("\xC0\xAF"), unknown + unknown) << "overlong";
  EXPECT_EQ(markup_text("\xED\xA0\x80x"), unknown + unknown + unknown + "x") << "surrogate";
  EXPECT_EQ(markup_text("\xE7\x82"), unknown + unknown) << "cut off";
}

TEST(HtmlReport, HostileNamesStandInItAsText) {
  const std::string html = html_report(report_of(bent_run(kHostile), 1000));
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_EQ(html.find("<!-- "), std::string::npos);
  EXPECT_NE(html.find("&lt;/script&gt;&lt;script&gt;alert(1)"), std::string::npos);
}

TEST(HtmlReport, FetchesNothing) {
  const std::string html = html_report(report_of(bent_run("run"), 1000));
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  for (const char* outside : {"src=\"", "href=\"http", "@import", "url(http"}) {
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  }
}

TEST(HtmlReport, SaysWhatDiffersFromTheDefaults) {
  const std::string html = html_report(report_of(bent_run("run"), 1000));
  EXPECT_NE(html.find("<tr><td>k</td><td>5</td><td>10</td>"), std::string::npos);
  EXPECT_EQ(html.find("<td>same</td>"), std::string::npos);
}

TEST(HtmlReport, EveryNoteHasALineOfItsOwn) {
  Report report;
  report.notes = {"Failed: one <source>.", "Failed: another."};
  const std::string html = html_report(report);
  EXPECT_NE(html.find("<li>Failed: one &lt;source&gt;.</li><li>Failed: another.</li>"), std::string::npos) << html;
  EXPECT_EQ(html_report(Report{}).find("<li>"), std::string::npos);
}

TEST(HtmlReport, IsWrittenForARunWithoutAScan) {
  const std::string html = html_report(report_of(RunRecord{}, 1000));
  EXPECT_NE(html.find("</html>"), std::string::npos);
}

TEST(ReportJson, CarriesTheCurvesAndNoMarkup) {
  const std::string text = report_json(report_of(bent_run(kHostile), 1000));
  EXPECT_EQ(text.find('<'), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(text);
  const nlohmann::json& speed = json["plots"]["speed"]["curves"][0];
  const std::vector<float> times = floats_of(json["arrays"][speed["x"].get<std::size_t>()]);
  const std::vector<float> speeds = floats_of(json["arrays"][speed["y"].get<std::size_t>()]);
  ASSERT_EQ(speeds.size(), 40U);
  EXPECT_NEAR(times[7], 0.7F, 1e-5F);
  EXPECT_NEAR(speeds[7], 5.0F, 0.01F);
  const nlohmann::json& ape = json["plots"]["ape"];
  EXPECT_EQ(ape["x"], nlohmann::json({{"label", "time"}, {"unit", "s"}}));
  EXPECT_EQ(ape["marks"].size(), 3U);
  EXPECT_EQ(json["map"]["paths"][1]["truth"], true);
}

TEST(ReportJson, TheTruthLiesWhereTheMapIs) {
  RunRecord record = bent_run("run");
  const Pose elsewhere = Eigen::Translation3d(100, -50, 3) * Pose(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  Trajectory truth = record.trajectory;
  for (StampedPose& pose : truth) pose.T_world_lidar = elsewhere * pose.T_world_lidar;
  EvaluationOptions options;
  options.align = Alignment::origin;
  record.evaluation = evaluate(truth, record.trajectory, options);
  const Report report = report_of(record, 1000);
  ASSERT_EQ(report.map->paths.size(), 2U);
  for (std::size_t i = 0; i < record.trajectory.size(); ++i) {
    EXPECT_TRUE(report.map->paths[1].poses[i].T_world_lidar.isApprox(record.trajectory[i].T_world_lidar, 1e-6)) << i;
  }
}

/// As if loop closure had moved everything by a metre: four keyframes, two closures of three accepted.
LoopRecord loops_of(const Trajectory& corrected) {
  LoopRecord loops;
  for (StampedPose pose : corrected) {
    pose.T_world_lidar.translation().x() -= 1;
    loops.odometry.push_back(pose);
  }
  loops.keyframe_scans = {0, 10, 20, 39};
  loops.closures.resize(3);
  for (std::size_t i = 0; i < 3; ++i) loops.closures[i].from_scan = 10 * i;
  for (ClosureRow& row : loops.closures) row.to_scan = 39;
  loops.closures[0].verdict = loops.closures[2].verdict = "accepted";
  loops.closures[1].verdict = "outvoted";
  return loops;
}

TEST(Report, ShowsKeyframesClosuresAndTheWayBefore) {
  RunRecord record = bent_run("run");
  EXPECT_TRUE(report_of(record, 1000).map->keyframes.empty());
  record.loops = loops_of(record.trajectory);
  const Report report = report_of(record, 1000);
  EXPECT_EQ(report.map->keyframes, record.loops->keyframe_scans);
  const std::vector<std::pair<std::size_t, std::size_t>> accepted{{0, 39}, {20, 39}};
  EXPECT_EQ(report.map->closures, accepted);
  ASSERT_EQ(report.map->paths.size(), 3U) << "after, before, truth";
  EXPECT_TRUE(report.map->paths[1].poses[5].T_world_lidar.isApprox(record.loops->odometry[5].T_world_lidar));
  EXPECT_TRUE(report.map->paths[2].truth);

  const Plot& top = report.sections.front().plots.front();
  ASSERT_EQ(top.id, "top_view");
  ASSERT_EQ(top.curves.size(), 3U);
  EXPECT_FLOAT_EQ(top.curves[1].x[7], top.curves[0].x[7] - 1);
  EXPECT_TRUE(top.curves[1].behind);
  EXPECT_FALSE(top.curves[1].truth);
  EXPECT_EQ(top.dots->x.size(), 4U);
  ASSERT_EQ(top.links->x.size(), 4U);
  EXPECT_FLOAT_EQ(top.links->y[2], top.curves[0].y[20]);
  EXPECT_FLOAT_EQ(top.links->y[3], top.curves[0].y[39]);
  const std::string svg = svg_file(top);
  for (const char* drawn : {"class=\"link\"", "class=\"landmark\"", "before loop closure"})
    EXPECT_NE(svg.find(drawn), std::string::npos) << drawn;
  const nlohmann::json json = nlohmann::json::parse(report_json(report));
  EXPECT_EQ(json["map"]["closures"], nlohmann::json({{0, 39}, {20, 39}}));
  EXPECT_EQ(floats_of(json["arrays"][json["plots"]["top_view"]["dots"]["x"].get<std::size_t>()]).size(), 4U);
}

TEST(SvgPlot, DrawsEveryKind) {
  for (const PlotKind kind :
       {PlotKind::lines, PlotKind::path, PlotKind::boxes, PlotKind::bars, PlotKind::histogram, PlotKind::heat}) {
    Plot plot;
    plot.kind = kind;
    plot.title = kHostile;
    plot.categories = {kHostile, "b"};
    plot.curves = {{kHostile, {0, 1, 2}, {1, 2}, {}}, {"b", {0, 1, 2}, {3, 4}, {}}};
    if (kind == PlotKind::lines || kind == PlotKind::path) plot.curves[0].y = plot.curves[1].y = {1, 2, 4};
    const std::string svg = svg_file(plot);
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_NE(svg.find(kind == PlotKind::heat ? ">4</text>" : "s1"), std::string::npos) << int(kind);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
  }
}

TEST(SvgPlot, AnUnknownCellSaysSo) {
  Plot plot;
  plot.kind = PlotKind::heat;
  plot.categories = {"a", "b"};
  plot.curves = {{"row", {}, {0.5F, std::nanf("")}, {}}};
  const std::string svg = svg_file(plot);
  EXPECT_NE(svg.find(">0.5</text>"), std::string::npos);
  EXPECT_NE(svg.find(">-</text>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(SvgPlot, BearsCurvesWithoutAPointAndWithOneValue) {
  Plot plot;
  plot.curves = {{"empty", {}, {}, {}}};
  EXPECT_EQ(svg_file(plot).find("nan"), std::string::npos);
  plot.curves = {{"flat", {1, 1}, {0, 0}, {}}};
  for (const PlotKind kind : {PlotKind::lines, PlotKind::path}) {
    plot.kind = kind;
    const std::string svg = svg_file(plot);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
  }
}

TEST(SvgPlot, LongValuesHaveRoomBesideTheNameOfTheirAxis) {
  constexpr double kDigit = 6, kName = 22;  // [px] width of a digit; where the name of the axis ends
  Plot plot;
  plot.y = {"RMSE", "m"};
  plot.curves = {{"k", {5, 10, 20}, {0.00204F, 0.00205F, 0.00225F}, {}}};
  EXPECT_GT(left_of(plot) - 6 - kDigit * 7, kName) << "0.00225";
  plot.curves = {{"k", {5, 10}, {0.1F, 0.2F}, {}}};
  const double narrow = left_of(plot);
  plot.kind = PlotKind::heat;
  plot.categories = {"0.5"};
  plot.curves = {{"a row with a long name", {}, {1}, {}}};
  EXPECT_GT(left_of(plot), narrow + 50);
}

TEST(SvgPlot, OfNothingButZerosHasNoNegativeAxis) {
  Plot plot;
  plot.curves = {{"degenerate directions", {0, 1, 2}, {0, 0, 0}, {}}};
  const std::string svg = svg_file(plot);
  EXPECT_EQ(svg.find(">-0."), std::string::npos) << svg;
  EXPECT_NE(svg.find(">0.5</text>"), std::string::npos) << svg;
}

TEST(Thinned, KeepsPeaksAndEnds) {
  Curve curve{"c", {}, {}, {}};
  for (int i = 0; i < 10000; ++i) {
    curve.x.push_back(float(i));
    curve.y.push_back(i == 4321 ? 50.0F : float(i % 2));
  }
  const Curve thin = thinned(curve, 100, PlotKind::lines);
  EXPECT_LE(thin.y.size(), 100U);
  EXPECT_EQ(thin.x.size(), thin.y.size());
  EXPECT_EQ(thin.x.back(), 9999.0F);
  EXPECT_EQ(*std::max_element(thin.y.begin(), thin.y.end()), 50.0F);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

TEST(WriteReport, WritesThePlotsToo) {
  const TemporaryFolder folder;
  write_report(folder / "", report_of(bent_run("run"), 1000));
  EXPECT_TRUE(text_of(folder / "report.html").ends_with("</html>\n"));
  EXPECT_NE(text_of(folder / "plots" / "ape.svg").find("RMSE"), std::string::npos);
  write_report(folder / "", report_of(RunRecord{}, 1000));
  EXPECT_FALSE(std::filesystem::exists(folder / "plots" / "ape.svg")) << "a run without truth has no errors";
}

}  // namespace
}  // namespace tilth
