// What a reader left out, each said once.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace tilth {

class Warnings {
 public:
  void add(std::string text) {
    if (std::find(texts_.begin(), texts_.end(), text) == texts_.end()) texts_.push_back(std::move(text));
  }
  std::vector<std::string> take() { return std::move(texts_); }

 private:
  std::vector<std::string> texts_;
};

}  // namespace tilth
