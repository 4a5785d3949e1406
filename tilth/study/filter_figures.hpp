// The figures of a filter's score by name: what CSV and JSON list.
#pragma once

#include <string>
#include <vector>

#include <tilth/evaluation/filter_score.hpp>

namespace tilth {

struct FilterFigure {
  std::string name;
  double value = 0.0;  ///< a share from 0 to 1, or a count
  bool count = false;
};

std::vector<FilterFigure> figures_of(const FilterScore& score);

}  // namespace tilth
