#pragma once
// SIGINT, SIGTERM, SIGHUP and SIGUSR1 ask a run to stop in good order; a second SIGINT or SIGTERM ends the
// program at once. A SIGHUP that is ignored (nohup) stays ignored.

/// Installs the handlers; they only raise a flag.
void catch_signals();
/// The signal that has come, or 0.
int caught_signal();
