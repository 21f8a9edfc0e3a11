// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tracked_mcf {

// What differs between Windows and other systems.

/// Returns the arguments of main() behind the program's name, in UTF-8, which all texts of this
/// program have. On Windows, also lets the console use it.
std::vector<std::string> utf8_arguments(int argc, const char* const* argv);

/// Returns whether the standard error stream is a terminal that understands escape sequences.
bool writes_to_terminal();

/// Lets a file that grows beyond a limit of the system fail as on a full disk. On Unix, it would
/// end the program.
void let_writes_fail_at_file_limits();

/// Lets `handler` be called with the number of each signal that interrupts the program, on a thread
/// of its own on Windows. There, Ctrl-C and Ctrl-Break are SIGINT; closing the console, logging off
/// and shutting down are SIGTERM. Elsewhere, these signals and SIGHUP are handled, unless they are
/// ignored, as under nohup.
void call_on_interrupts(void (*handler)(int number));

/// Ends the program as the default action of the signal `number` does, without destructors or
/// buffers. A shell then sees that a signal ended it, and ends its own loop on Ctrl-C. In a
/// handler, the program ends when the handler returns. Windows knows no such end: the exit code is
/// 128 plus the number.
void die_of_interrupt(int number);

}  // namespace tracked_mcf
