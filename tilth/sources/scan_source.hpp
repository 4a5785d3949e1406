// Where scans come from, one after the other.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tilth/core/scan.hpp>

namespace tilth {

/// A record that could not be read and was passed over.
struct SkippedScan {
  std::size_t index = 0;  ///< of the record in the recording
  std::string where;      ///< file, or bag and message
  std::string what;       ///< what is wrong with it
};

class ScanSource {
 public:
  virtual ~ScanSource() = default;

  /// The next scan with finite stamp, or nothing at the end. Bad records are passed over and listed in skipped(); a
  /// recording that breaks off ends here and says so in skipped(). Throws Error only where nothing more can be read.
  virtual std::optional<Scan> next() = 0;

  virtual std::optional<std::size_t> size() const { return std::nullopt; }  ///< scans in all, where that is known

  /// What the recording holds: topics with their types, fields with theirs; one line each. Complete from the start.
  const std::vector<std::string>& contents() const { return contents_; }

  /// What was worked out from the data and how: fields, ring, time unit and reference, spin period; one sentence each.
  /// Complete once the first scan has been read.
  const std::vector<std::string>& decisions() const { return decisions_; }
  const std::vector<SkippedScan>& skipped() const { return skipped_; }

  /// What was noticed so far beside scans: packets lost, other traffic; one sentence each. Complete at the end.
  virtual std::vector<std::string> notices() const { return {}; }

 protected:
  std::vector<std::string> contents_, decisions_;
  std::vector<SkippedScan> skipped_;
};

}  // namespace tilth
