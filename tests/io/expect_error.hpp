// Bad input must end in tilth::Error that says what is wrong.
#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>

namespace tilth {

/// Expects f() to throw Error whose text contains every one of `parts`.
template <class F>
void expect_error(const F& f, const std::vector<std::string>& parts) {
  try {
    f();
    ADD_FAILURE() << "no Error; expected one with '" << parts.at(0) << "'";
  } catch (const Error& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

/// parse(bytes) on every shorter prefix: Error each time, or acceptance where `may_pass(length)` says so.
template <class Parse, class MayPass>
void expect_truncations_refused(const std::vector<std::byte>& bytes, const Parse& parse, const MayPass& may_pass) {
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    bool refused = false;
    try {
      parse(std::vector<std::byte>(bytes.begin(), bytes.begin() + std::ptrdiff_t(length)));
    } catch (const Error&) {
      refused = true;
    }
    EXPECT_TRUE(refused || may_pass(length)) << "accepted the first " << length << " of " << bytes.size() << " bytes";
  }
}

/// parse(bytes) with a few bytes changed at random, many times: an Error or a result, nothing else.
template <class Parse>
void expect_corruption_survived(const std::vector<std::byte>& bytes, int rounds, const Parse& parse) {
  std::mt19937 random(7);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> corrupt = bytes;
    for (unsigned i = 0; i < 1 + random() % 4; ++i) corrupt[random() % corrupt.size()] = std::byte(random());
    try {
      parse(corrupt);
    } catch (const Error&) {
    }
  }
}

inline std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace tilth
