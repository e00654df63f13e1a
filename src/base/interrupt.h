// SIGINT, SIGTERM and SIGUSR1 ask the run to stop: the time loop looks, writes a checkpoint and leaves. SIGUSR1 is the one that mpiexec
// hands on to its ranks at once and without killing them afterwards.
#pragma once

namespace windhover {

/// From now on the first signal is only remembered; a second one ends the program at once.
void catch_interrupts();

/// The signal that arrived (SIGINT, SIGTERM or SIGUSR1), or 0. Ranks may differ: the loop agrees on it collectively.
int interrupt_signal();

}  // namespace windhover
