#pragma once
// SIGINT and SIGTERM ask a run to stop in good order; a second one ends the program at once.

/// Installs the handlers; they only raise a flag.
void catch_signals();
/// The signal that has come, or 0.
int caught_signal();
