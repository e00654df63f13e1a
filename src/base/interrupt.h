// SIGINT and SIGTERM ask the run to stop: the time loop looks, writes a checkpoint and leaves.
#pragma once

namespace windhover {

/// From now on the first signal is only remembered; a second one ends the program at once.
void catch_interrupts();

/// The signal that arrived (SIGINT or SIGTERM), or 0. Ranks may differ: the loop agrees on it collectively.
int interrupt_signal();

}  // namespace windhover
