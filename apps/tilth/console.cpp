#include "console.hpp"

#include <cstdio>
#include <unistd.h>

namespace tilth::app {
namespace {

constexpr double kSecondsBetweenLines = 0.1;

std::string progress_line(std::size_t done, std::optional<std::size_t> total, double seconds) {
  const double rate = double(done) / seconds;
  char text[128];
  if (total && *total >= done) {
    const double ratio = 100.0 * double(done) / double(*total);
    std::snprintf(text, sizeof text, "%zu of %zu scans  %3.0f %%  %.0f scans/s  %.0f s left", done, *total, ratio, rate,
                  double(*total - done) / rate);
  } else {
    std::snprintf(text, sizeof text, "%zu scans  %.0f scans/s", done, rate);
  }
  return text;
}

}  // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void Console::note(const std::string& text) {
  if (quiet_) return;
  clear_progress();
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

void Console::warn(const std::string& text) {
  if (quiet_) return;
  clear_progress();
  std::fprintf(stderr, "tilth: warning: %s\n", text.c_str());
}

void Console::error(const std::string& text) {
  clear_progress();
  std::fprintf(stderr, "tilth: error: %s\n", text.c_str());
}

void Console::progress(std::size_t done, std::optional<std::size_t> total) {
  if (done > 0) show_progress(progress_line(done, total, run_.seconds()));
}

void Console::show_progress(const std::string& text) {
  if (quiet_ || !terminal_ || line_.seconds() < kSecondsBetweenLines) return;
  line_ = Stopwatch();
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  line_open_ = true;
}

void Console::clear_progress() {
  if (line_open_) std::fputs("\r\033[K", stderr);
  line_open_ = false;
}

}  // namespace tilth::app
