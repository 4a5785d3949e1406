#include "interrupt.hpp"

#include <csignal>

namespace tilth::app {
namespace {

volatile std::sig_atomic_t last_signal = 0;

extern "C" void remember(int signal) {
  last_signal = signal;
}

}  // namespace

void remember_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
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
