// A row of the table while single candidates come: squared distance and index as one integer, so that one comparison
// orders by both. Insertion O(k), mostly O(1).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tilth {

/// Where a row of the table lies.
struct Row {
  float* distances;
  std::uint32_t* indices;
  std::size_t k;
};

/// The k nearest candidates so far, by squared distance, then by index; one that comes twice counts once.
class NearestRow {
 public:
  static constexpr std::size_t kMost = 32;

  explicit NearestRow(std::size_t k) : k_(k) {}

  std::size_t k() const { return k_; }

  /// Orders by squared distance, then by index.
  static std::uint64_t entry(float squared, std::uint32_t index) {
    return std::uint64_t(std::bit_cast<std::uint32_t>(squared)) << 32 | index;
  }

  /// The squared distance beyond which nothing is of use.
  float limit() const { return limit_; }

  void insert(float squared, std::uint32_t index) {
    const std::uint64_t candidate = entry(squared, index);
    std::size_t j = count_;
    while (j > 0 && nearest_[j - 1] > candidate) --j;
    if (j == k_ || (j > 0 && nearest_[j - 1] == candidate)) return;
    if (count_ < k_) ++count_;
    for (std::size_t i = count_ - 1; i > j; --i) nearest_[i] = nearest_[i - 1];
    nearest_[j] = candidate;
    if (count_ == k_) limit_ = std::bit_cast<float>(std::uint32_t(nearest_[k_ - 1] >> 32));
  }

  void write(const Row& row) const {
    for (std::size_t j = 0; j < k_; ++j) {
      row.distances[j] = std::bit_cast<float>(std::uint32_t(nearest_[j] >> 32));
      row.indices[j] = std::uint32_t(nearest_[j]);
    }
  }

 private:
  std::uint64_t nearest_[kMost];
  std::size_t k_, count_ = 0;
  float limit_ = std::numeric_limits<float>::max();
};

}  // namespace tilth
