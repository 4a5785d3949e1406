// What a run says while it goes on, for whoever shows it: the run itself prints nothing.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace tilth {

/// Hears nothing: override what is of interest. All is called by the thread that runs the session.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void note(const std::string&) {}  ///< a sentence to know: how the input is understood, how far the run is
  virtual void warn(const std::string&) {}  ///< a sentence to act on: what was skipped, what could not be saved
  /// `scans` were read so far, of `total` where that is known.
  virtual void progress(std::size_t /*scans*/, std::optional<std::size_t> /*total*/) {}
};

}  // namespace tilth
