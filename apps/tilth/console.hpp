// What a run says while it runs: notes on standard output, warnings and the progress line on standard error.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <tilth/run/run_observer.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth::app {

class Console final : public RunObserver {
 public:
  explicit Console(bool quiet);

  void note(const std::string& text) override;  ///< nothing where quiet
  void warn(const std::string& text) override;  ///< nothing where quiet
  void error(const std::string& text);          ///< always

  /// Rewrites the progress line, a few times a second; only on a terminal. `total` where it is known.
  void progress(std::size_t done, std::optional<std::size_t> total) override;
  /// Rewrites the progress line as `text`, a few times a second; only on a terminal.
  void show_progress(const std::string& text);
  void clear_progress();

 private:
  bool quiet_, terminal_, line_open_ = false;
  Stopwatch run_, line_;
};

}  // namespace tilth::app
