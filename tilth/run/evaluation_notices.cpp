#include <cstdio>
#include <numbers>

#include <tilth/run/evaluation_report.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostGaps = 5;  // listed one by one

std::string gap_text(const TruthGap& gap) {
  char text[120];
  std::snprintf(text, sizeof text, "%.3f s to %.3f s (%zu)", gap.from, gap.to, gap.left_out);
  return text;
}

std::string gaps_text(const std::vector<TruthGap>& gaps, double limit) {
  std::size_t left_out = 0;
  for (const TruthGap& gap : gaps) left_out += gap.left_out;
  char text[200];
  std::snprintf(text, sizeof text,
                "%zu poses of the estimate are left out: the truth has none for more than %.3g s (max_gap) there: ",
                left_out, limit);
  std::string list;
  for (std::size_t i = 0; i < std::min(gaps.size(), kMostGaps); ++i)
    list.append(i > 0 ? ", " : "").append(gap_text(gaps[i]));
  if (gaps.size() > kMostGaps) list += " and " + std::to_string(gaps.size() - kMostGaps) + " more";
  return text + list;
}

std::string roll_text(const OpenRoll& roll) {
  char text[280];
  std::snprintf(
      text, sizeof text,
      "warning: the positions lie within %.3g m of a straight line, which leaves the rotation about it open to "
      "some %.2g deg: the alignment may have turned the estimate by that (compare by the first poses, origin)",
      roll.off_line, 180 / std::numbers::pi * roll.angle);
  return text;
}

}  // namespace

std::vector<std::string> notices_of(const Evaluation& evaluation) {
  std::vector<std::string> notices = evaluation.notices;
  if (!evaluation.matches.gaps.empty()) notices.push_back(gaps_text(evaluation.matches.gaps, evaluation.gap_limit));
  if (evaluation.open_roll) notices.push_back(roll_text(*evaluation.open_roll));
  return notices;
}

}  // namespace tilth
