#include <iterator>
#include <utility>

#include <tilth/recording/turn_stage.hpp>

namespace tilth {
namespace {

constexpr std::size_t kFirst = 8;  ///< messages that tell how turns and messages go together

void move_to_end(std::vector<Scan> from, std::vector<Scan>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

std::vector<Scan> TurnStage::add(Scan message) {
  if (plan_) return turns_of(std::move(message));
  first_.push_back(std::move(message));
  return first_.size() < kFirst ? std::vector<Scan>{} : decide();
}

std::vector<Scan> TurnStage::decide() {
  plan_ = plan_turns(first_);
  if (plan_->kind == TurnPlan::Kind::parts) assembler_.emplace(*plan_, snapshots_);
  std::vector<Scan> turns;
  for (Scan& message : std::exchange(first_, {})) move_to_end(turns_of(std::move(message)), turns);
  return turns;
}

std::vector<Scan> TurnStage::turns_of(Scan message) {
  if (plan_->kind == TurnPlan::Kind::several) return cut_turns(std::move(message), plan_->step);
  std::vector<Scan> turns;
  if (!assembler_)
    turns.push_back(std::move(message));
  else if (std::optional<Scan> turn = assembler_->add(std::move(message)))
    turns.push_back(std::move(*turn));
  return turns;
}

std::vector<Scan> TurnStage::finish() {
  std::vector<Scan> turns;
  if (!first_.empty()) turns = decide();
  std::optional<Scan> last = assembler_ ? assembler_->finish() : std::nullopt;
  if (last) turns.push_back(std::move(*last));
  return turns;
}

std::vector<std::string> TurnStage::notices() const {
  std::vector<std::string> all;
  if (!assembler_) return all;
  const auto tell = [&](std::size_t n, const std::string& what) {
    if (n > 0) all.push_back("turns: " + std::to_string(n) + " " + what);
  };
  tell(assembler_->incomplete(),
       "are incomplete, " + std::to_string(assembler_->left_out()) + " of them so much that they are left out");
  tell(assembler_->repeated(), "parts came twice: the second is left out");
  return all;
}

}  // namespace tilth
