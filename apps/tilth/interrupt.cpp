#include "interrupt.hpp"

#include <csignal>

namespace tilth::app {
namespace {

volatile std::sig_atomic_t last_signal = 0;

extern "C" void remember(int signal) {
  last_signal = signal;
}

/// The terminal is gone: what is still said must not end the program before its results are written.
extern "C" void remember_hangup(int signal) {
  last_signal = signal;
  struct sigaction action {};
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
}

/// Whoever started the program had it ignored, as nohup has SIGHUP.
bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void remember_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  if (is_ignored(SIGHUP)) return;
  action.sa_handler = remember_hangup;
  sigaction(SIGHUP, &action, nullptr);
}

int interrupted() {
  return last_signal;
}

SourceOptions stopped_by_signals(SourceOptions options) {
  options.stopped = [] { return interrupted() != 0; };
  return options;
}

int signal_exit_code() {
  constexpr int kSignalExit = 128;
  return kSignalExit + interrupted();
}

}  // namespace tilth::app
