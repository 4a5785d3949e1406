// Some of many, evenly over their order. O(chosen).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace tilth {

/// At most `most` of `items`: all of them where they are no more.
template <class T>
std::vector<T> evenly_chosen(std::span<const T> items, std::size_t most) {
  const std::size_t count = std::min(items.size(), most);
  std::vector<T> chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(items[i * items.size() / count]);
  return chosen;
}

}  // namespace tilth
