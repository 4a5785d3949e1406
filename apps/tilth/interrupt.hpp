// Ctrl-C, SIGTERM and SIGHUP (the terminal or ssh session ends) as a question that long loops ask; the second one ends
// the program at once.
#pragma once

#include <tilth/sources/open_source.hpp>

namespace tilth::app {

/// From now on the first SIGINT, SIGTERM or SIGHUP is only remembered; a SIGHUP that nohup has ignored stays so.
void remember_interrupts();

/// The signal that came, or zero.
int interrupted();

/// `options` with such a signal as the end of a live source.
SourceOptions stopped_by_signals(SourceOptions options);

/// Of what goes on where it was when it is called again, whichever signal ended it.
constexpr int kInterruptedExit = 130;

/// As a shell says that this signal ended a program: 128 and its number.
int signal_exit_code();

}  // namespace tilth::app
