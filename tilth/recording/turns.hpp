// Scans of whole turns, however the recording divides them: parts of turns (halves, eighths, packets) are put together,
// several turns in one message are cut apart. Decided over the first messages. O(n) a scan.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/scan.hpp>

namespace tilth {

/// How messages and turns go together.
struct TurnPlan {
  enum class Kind { whole, parts, several };
  Kind kind = Kind::whole;
  double messages = 1.0;   ///< a turn
  double width = 0.0;      ///< [rad] of the part of a turn that a message covers
  double direction = 1.0;  ///< of the parts: +1 counter-clockwise
  double period = 0.0;     ///< [s] of a turn; 0: the stamps do not tell
  double step = 0.0;       ///< [s] between messages
  std::string sentence;    ///< empty: a message is a turn
};

/// From consecutive messages, at least one.
TurnPlan plan_turns(std::span<const Scan> messages);

/// Points in the order of their times, where they have any.
Scan in_order_of_time(Scan scan);

/// The turns in one message; itself where it is only one. Points are in the order of their times, or of firing.
/// Where nothing tells times, those of its turns are `step` apart.
std::vector<Scan> cut_turns(Scan message, double step);

/// Parts in their order -> whole turns.
class TurnAssembler {
 public:
  /// Parts without times have those of their stamps in the turn, unless they are `snapshots`.
  TurnAssembler(const TurnPlan& plan, bool snapshots) : plan_(plan), snapshots_(snapshots) {}

  std::optional<Scan> add(Scan part);  ///< the turn before, where `part` begins a new one
  std::optional<Scan> finish();        ///< what is left

  std::size_t incomplete() const { return incomplete_; }  ///< turns with parts missing
  std::size_t left_out() const { return left_out_; }      ///< of these, with less than two fifths of them
  std::size_t repeated() const { return repeated_; }      ///< parts that came twice

 private:
  bool begins_turn(double phase, double stamp) const;

  TurnPlan plan_;
  bool snapshots_;
  std::vector<Scan> parts_;
  std::optional<double> first_centre_;  ///< [rad] of the first part of all
  double phase_ = 0.0;                  ///< [rad] of the last part in its turn
  std::size_t incomplete_ = 0, left_out_ = 0, repeated_ = 0;
};

}  // namespace tilth
