// The seeds, cut at every length and mutated: an error or a skip, never a crash, a hang or a gigabyte of memory.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "targets.hpp"
#include <tilth/io/input_file.hpp>

namespace tilth::fuzz {
namespace {

using Clock = std::chrono::steady_clock;
using Seed = std::vector<std::byte>;

constexpr double kSeconds = 20.0 / double(kTargets.size());  // of mutation a target
constexpr double kLongest = 5.0;                             // [s] of one input, on a busy computer
constexpr std::size_t kCuts = 500;
constexpr long kMostMemory = 1 << 20;  // [KiB]

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<Seed> seeds_of(std::string_view target) {
  std::vector<Seed> seeds;
  const auto folder = std::filesystem::path(TILTH_SOURCE_DIR) / "tests/fuzz/seeds" / target;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) seeds.push_back(read_file(file));
  return seeds;
}

Seed mutated(Seed seed, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return std::size_t(random()) % std::max<std::size_t>(n, 1); };
  constexpr std::array<unsigned, 6> kEdges{0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF};
  const std::size_t changes = 1 + below(8);
  for (std::size_t i = 0; i < changes && !seed.empty(); ++i) {
    const std::size_t at = below(4) == 0 ? below(std::min<std::size_t>(seed.size(), 64)) : below(seed.size());
    switch (below(6)) {
      case 0: seed[at] = std::byte(random() & 0xFF); break;
      case 1: seed[at] = std::byte(kEdges[below(kEdges.size())]); break;
      case 2: seed[at] ^= std::byte(1U << below(8)); break;
      case 3:
        std::fill_n(seed.begin() + std::ptrdiff_t(at), std::min<std::size_t>(4, seed.size() - at), std::byte(0xFF));
        break;
      case 4:
        seed.erase(seed.begin() + std::ptrdiff_t(at),
                   seed.begin() + std::ptrdiff_t(std::min(seed.size(), at + 1 + below(16))));
        break;
      default: seed.insert(seed.begin() + std::ptrdiff_t(at), 1 + below(16), std::byte(random() & 0xFF));
    }
  }
  return seed;
}

class Fuzz : public testing::TestWithParam<Target> {
 protected:
  void feed(const Seed& bytes) {
    const Clock::time_point begin = Clock::now();
    run(GetParam(), bytes);
    ASSERT_LT(since(begin), kLongest) << "a hang on " << bytes.size() << " bytes";
    ++inputs_;
  }
  std::size_t inputs_ = 0;
};

TEST_P(Fuzz, SurvivesCutAndMutatedSeeds) {
  const Clock::time_point begin = Clock::now();
  const std::vector<Seed> seeds = seeds_of(GetParam().name);
  ASSERT_FALSE(seeds.empty());
  feed({});
  for (const Seed& seed : seeds) {
    feed(seed);
    const std::size_t stride = 1 + seed.size() / kCuts;
    for (std::size_t size = 0; size < seed.size(); size += stride)
      feed({seed.begin(), seed.begin() + std::ptrdiff_t(size)});
  }
  std::mt19937 random(8);
  while (since(begin) < kSeconds || inputs_ < 100) feed(mutated(seeds[random() % seeds.size()], random));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, kMostMemory);
  RecordProperty("inputs", int(inputs_));
}

INSTANTIATE_TEST_SUITE_P(Every, Fuzz, testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace tilth::fuzz
