#include <algorithm>
#include <cmath>
#include <cstdio>

#include <tilth/core/median.hpp>
#include <tilth/core/turn.hpp>
#include <tilth/recording/turns.hpp>
#include <tilth/sensor/azimuth_arc.hpp>
#include <tilth/sensor/firing_order.hpp>

namespace tilth {
namespace {

constexpr double kWhole = 300.0 / 360.0 * kTurn;  ///< [rad] a message that covers more is a turn
constexpr double kNext = 0.4, kFar = 1.7;         ///< widths from a part to the one after it
constexpr double kSteady = 0.35;                  ///< widths by which that may vary
constexpr double kMostSteady = 0.7;               ///< of the steps are so
constexpr double kSeveral = 1.5;                  ///< turns in a message
constexpr std::size_t kLooked = 3;                ///< messages in which turns are counted
constexpr std::size_t kFewestParts = 4;           ///< messages that tell a succession of parts

std::string text(const char* format, auto... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

double median_step(std::span<const Scan> messages) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < messages.size(); ++k) steps.push_back(messages[k].stamp - messages[k - 1].stamp);
  return steps.empty() ? 0.0 : std::max(0.0, median(std::move(steps)));
}

/// [rad] by which the head turned in a message; 0 where its points are in no order.
double rotation_in(const Scan& message) {
  const PointCloud cloud = in_order_of_time(message).cloud;
  const auto rotation = find_head_rotation(cloud.points, cloud.rings);
  return rotation ? rotation->covered() : 0.0;
}

TurnPlan parts_of_turns(std::span<const double> moved, double width, double step) {
  TurnPlan plan{TurnPlan::Kind::parts, 0.0, width, 1.0, 0.0, step, {}};
  const double middle = median({moved.begin(), moved.end()});
  plan.direction = middle < 0.0 ? -1.0 : 1.0;
  plan.messages = kTurn / std::abs(middle);
  plan.period = step * plan.messages;
  plan.sentence = text("turns: a message is %.0f deg of a turn; %.1f messages are put together to one",
                       width / kTurn * 360, plan.messages);
  return plan;
}

}  // namespace

TurnPlan plan_turns(std::span<const Scan> messages) {
  std::vector<double> widths, centres, moved;
  for (const Scan& message : messages) {
    const AzimuthArc arc = arc_of(message.cloud.points);
    widths.push_back(arc.width);
    centres.push_back(arc.centre());
  }
  const double width = median(widths), step = median_step(messages);
  if (width > kWhole) {
    std::vector<double> turns;
    for (const Scan& message : messages.first(std::min(kLooked, messages.size())))
      turns.push_back(rotation_in(message) / kTurn);
    const double several = median(std::move(turns));
    if (several < kSeveral) return {};
    return {TurnPlan::Kind::several,
            1.0 / std::round(several),
            width,
            1.0,
            step / std::round(several),
            step,
            text("turns: a message holds %.1f turns, which are cut apart", several)};
  }
  if (messages.size() < kFewestParts) return {};
  for (std::size_t k = 1; k < centres.size(); ++k) {
    double by = std::remainder(centres[k] - centres[k - 1], kTurn);
    if (std::abs(by) > 0.47 * kTurn) by = std::abs(by);  // a half turn is one either way
    moved.push_back(by);
  }
  const double middle = median(moved);
  const auto steady = std::count_if(moved.begin(), moved.end(), [&](double by) {
    return std::abs(std::remainder(by - middle, kTurn)) < kSteady * width;
  });
  const bool follow = std::abs(middle) > kNext * width && std::abs(middle) < kFar * width;
  if (!follow || double(steady) < kMostSteady * double(moved.size())) return {};
  return parts_of_turns(moved, width, step);
}

}  // namespace tilth
