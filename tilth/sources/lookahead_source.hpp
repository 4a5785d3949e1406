// A source whose first scans are known before they are taken from it.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <vector>

#include <tilth/sources/scan_source.hpp>

namespace tilth {

class LookaheadSource : public ScanSource {
 public:
  /// Reads the scans of the first `seconds` of `source`; what goes wrong there is thrown when it is taken.
  LookaheadSource(std::unique_ptr<ScanSource> source, double seconds);

  /// Those that were read and not yet taken.
  const std::vector<Scan>& ahead() const { return ahead_; }

  std::optional<Scan> next() override;
  std::optional<std::size_t> size() const override { return source_->size(); }
  std::vector<std::string> notices() const override { return source_->notices(); }

 private:
  void take_over();

  std::unique_ptr<ScanSource> source_;
  std::vector<Scan> ahead_;
  std::exception_ptr problem_;
};

}  // namespace tilth
