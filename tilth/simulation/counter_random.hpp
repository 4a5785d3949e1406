// Random numbers by counter: the stream is a pure function of its keys, so that a scan has the same bytes whatever
// thread makes it. Mixing by SplitMix64 (Steele, Lea, Flood 2014). About 2 ns a number.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tilth {

class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t index = 0)
      : state_(mix(mix(mix(seed + kGolden) ^ stream) + kGolden * index)) {}

  /// In [0, 1).
  double uniform() {
    state_ += kGolden;
    return double(mix(state_) >> 11) * 0x1.0p-53;
  }

  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  bool chance(double probability) { return uniform() < probability; }

  /// Normal with mean 0 and deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace tilth
