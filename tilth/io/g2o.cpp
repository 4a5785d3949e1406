#include <algorithm>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/io/g2o.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

constexpr std::size_t kPoseValues = 7, kInformationValues = 21;

// From [rotation; translation] to [translation; vector part of the quaternion], which is half the rotation: the vector
// part times 2 is the rotation to the second order.
Matrix6d to_g2o() {
  Matrix6d S = Matrix6d::Zero();
  S.topRightCorner<3, 3>() = 2 * Eigen::Matrix3d::Identity();
  S.bottomLeftCorner<3, 3>() = Eigen::Matrix3d::Identity();
  return S;
}

std::string pose_text(const Pose& pose) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  const Eigen::Vector3d t = pose.translation();
  std::string text;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    text.append(" ").append(exact_text(value));
  return text;
}

std::string edge_text(const Constraint& c) {
  std::string text = "EDGE_SE3:QUAT " + std::to_string(c.from) + " " + std::to_string(c.to) + pose_text(c.T_from_to);
  const Matrix6d information = to_g2o().transpose() * c.information * to_g2o();
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column) text.append(" ").append(exact_text(information(row, column)));
  return text + "\n";
}

// The words of one line, as numbers.
class Line {
 public:
  Line(const std::vector<std::string_view>& words, std::string where, std::size_t expected)
      : words_(words), where_(std::move(where)) {
    if (words.size() != expected) {
      throw Error(where_, "has " + std::to_string(words.size() - 1) + " values after " + std::string(words[0]) +
                              ", expected " + std::to_string(expected - 1));
    }
  }

  std::size_t vertex(std::size_t i) const {
    const auto count = to_count(words_[i]);
    if (!count) throw Error(where_, "'" + std::string(words_[i].substr(0, 40)) + "' is no number of a vertex");
    return std::size_t(*count);
  }

  double number(std::size_t i) const {
    const auto value = to_double(words_[i]);
    if (!value || !std::isfinite(*value))
      throw Error(where_, "'" + std::string(words_[i].substr(0, 40)) + "' is not a finite number");
    return *value;
  }

  Pose pose(std::size_t i) const {
    const Eigen::Quaterniond q(number(i + 6), number(i + 3), number(i + 4), number(i + 5));
    if (!(q.norm() > 1e-6)) throw Error(where_, "has a quaternion of length zero");
    return Eigen::Translation3d(number(i), number(i + 1), number(i + 2)) * q.normalized();
  }

  Matrix6d information(std::size_t i) const {
    Matrix6d values;
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column) values(row, column) = values(column, row) = number(i++);
    const Matrix6d back = to_g2o().inverse();
    return back.transpose() * values * back;
  }

  const std::string& where() const { return where_; }

 private:
  const std::vector<std::string_view>& words_;
  std::string where_;
};

void add_vertex(const Line& line, PoseGraph& graph) {
  if (line.vertex(1) != graph.poses.size())
    throw Error(line.where(), "is not vertex " + std::to_string(graph.poses.size()) + ", which comes next");
  graph.poses.push_back(line.pose(2));
}

void add_edge(const Line& line, PoseGraph& graph) {
  Constraint c{line.vertex(1), line.vertex(2), line.pose(3), line.information(3 + kPoseValues), false};
  if (std::max(c.from, c.to) >= graph.poses.size() || c.from == c.to)
    throw Error(line.where(), "joins no two of the vertices before it");
  c.closure = c.to != c.from + 1;
  graph.constraints.push_back(c);
}

}  // namespace

void write_g2o(const std::filesystem::path& path, const PoseGraph& graph) {
  std::string text;
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    text += "VERTEX_SE3:QUAT " + std::to_string(i) + pose_text(graph.poses[i]) + "\n";
  if (!graph.poses.empty()) text += "FIX 0\n";
  for (const Constraint& constraint : graph.constraints) text += edge_text(constraint);
  write_text(path, text);
}

PoseGraph parse_g2o(std::string_view text, const std::string& name) {
  PoseGraph graph;
  TextLines lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::vector<std::string_view> found = words(*line);
    if (found.empty()) continue;
    if (found[0] == "VERTEX_SE3:QUAT") add_vertex(Line(found, lines.where(name), 2 + kPoseValues), graph);
    if (found[0] == "EDGE_SE3:QUAT")
      add_edge(Line(found, lines.where(name), 3 + kPoseValues + kInformationValues), graph);
  }
  return graph;
}

PoseGraph read_g2o(const std::filesystem::path& path) {
  return parse_g2o(as_text(read_file(path)), path.string());
}

}  // namespace tilth
