// Pose graphs through g2o files and back.
#include <sstream>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/g2o.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {
namespace {

PoseGraph sample() {
  PoseGraph graph;
  for (int i = 0; i < 4; ++i) graph.poses.push_back(exp((Vector6d() << 0.1, 0.2 * i, -0.3, i, 2, 3).finished()));
  Matrix6d A = Matrix6d::Random();
  const Matrix6d information = A * A.transpose() + Matrix6d::Identity();
  for (std::size_t i = 1; i < 4; ++i)
    graph.constraints.push_back({i - 1, i, graph.poses[i - 1].inverse() * graph.poses[i], information, false});
  graph.constraints.push_back({0, 3, exp(Vector6d::Constant(0.2)), 5 * information, true});
  return graph;
}

TEST(G2o, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const PoseGraph graph = sample();
  write_g2o(folder / "a.g2o", graph);
  const PoseGraph back = read_g2o(folder / "a.g2o");
  ASSERT_EQ(back.poses.size(), graph.poses.size());
  for (std::size_t i = 0; i < graph.poses.size(); ++i) EXPECT_TRUE(back.poses[i].isApprox(graph.poses[i], 1e-12));
  ASSERT_EQ(back.constraints.size(), graph.constraints.size());
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const Constraint &a = graph.constraints[i], &b = back.constraints[i];
    EXPECT_EQ(a.from, b.from);
    EXPECT_EQ(a.to, b.to);
    EXPECT_EQ(a.closure, b.closure);
    EXPECT_TRUE(a.T_from_to.isApprox(b.T_from_to, 1e-12));
    EXPECT_TRUE(a.information.isApprox(b.information, 1e-12));
  }
}

// An edge's cost is the same by g2o's own error: translation, then the vector part of the quaternion.
TEST(G2o, KeepsTheCostOfAnError) {
  const TemporaryFolder folder;
  const PoseGraph graph = sample();
  write_g2o(folder / "a.g2o", graph);
  const auto bytes = read_file(folder / "a.g2o");
  const std::string text(as_text(bytes));
  std::istringstream edge(text.substr(text.find("EDGE_SE3:QUAT")));
  std::string tag;
  edge >> tag;
  double skipped;
  for (int i = 0; i < 9; ++i) edge >> skipped;
  Matrix6d information;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      edge >> information(i, j);
      information(j, i) = information(i, j);
    }
  }
  Vector6d error;
  error << 1e-4, -2e-4, 3e-4, 2e-4, 1e-4, -1e-4;  // rotation, translation
  const Pose T = exp(error);
  Vector6d theirs;
  theirs << T.translation(), Eigen::Quaterniond(T.linear()).vec();
  const double ours = error.dot(graph.constraints[0].information * error);
  EXPECT_NEAR(theirs.dot(information * theirs), ours, 1e-4 * ours);  // equal to first order in the error
}

const std::string kVertices =
    "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n# a remark\nFIX 0\nVERTEX_SE3:QUAT 1 1 0 0 0 0 0.7071067811865476 "
    "0.7071067811865476\n";
const std::string kInformation = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4";

TEST(G2o, ReadsAFileOfAnother) {
  const PoseGraph graph = parse_g2o(kVertices + "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1" + kInformation + "\n", "a");
  ASSERT_EQ(graph.poses.size(), 2U);
  EXPECT_NEAR(angle_of(graph.poses[1]), 1.5707963, 1e-6);
  ASSERT_EQ(graph.constraints.size(), 1U);
  EXPECT_TRUE(graph.constraints[0].information.isApprox(Matrix6d::Identity()));
  EXPECT_FALSE(graph.constraints[0].closure);
}

TEST(G2o, RefusesWhatIsBroken) {
  const auto parse = [](const std::string& text) { return [text] { parse_g2o(text, "a.g2o"); }; };
  expect_error(parse("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n"), {"a.g2o, line 1", "vertex 0"});
  expect_error(parse("VERTEX_SE3:QUAT 0 0 0 0 0 0 0\n"), {"line 1", "7 values", "expected 8"});
  expect_error(parse("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n"), {"length zero"});
  expect_error(parse("VERTEX_SE3:QUAT 0 0 x 0 0 0 0 1\n"), {"'x'", "finite number"});
  expect_error(parse(kVertices + "EDGE_SE3:QUAT 0 2 1 0 0 0 0 0 1" + kInformation), {"line 5", "joins no two"});
  expect_error(parse(kVertices + "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0"), {"line 5", "expected 30"});
}

}  // namespace
}  // namespace tilth
