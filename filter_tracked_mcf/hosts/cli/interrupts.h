// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

/// Makes the program die of SIGINT, SIGTERM and SIGHUP at once or when the last InterruptHold ends.
/// Signals that are ignored, as under nohup, stay ignored. On Windows, Ctrl-C counts as SIGINT, and
/// closing the console as SIGTERM; they end the program with 128 plus the signal's number.
void handle_interrupts();

/// Returns whether an interrupt waits for the end of a hold.
bool interrupted();

/// Holds interrupts back during its life, so that temporary files can be removed first.
class InterruptHold {
public:
    InterruptHold();

    /// Ends the program if there was an interrupt and no other hold lives.
    ~InterruptHold();

    InterruptHold(const InterruptHold&) = delete;
    InterruptHold& operator=(const InterruptHold&) = delete;
};

}  // namespace tracked_mcf
