#include "signals.hpp"

#include <csignal>
#include <initializer_list>

namespace {

volatile std::sig_atomic_t caught = 0;

void note(int signal) {
  caught = signal;
}

void catch_with(int flags, std::initializer_list<int> signals) {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART | flags;
  sigemptyset(&action.sa_mask);
  for (int const signal : signals) {
    struct sigaction before {};
    bool const is_ignored = sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    if (signal != SIGHUP || !is_ignored) sigaction(signal, &action, nullptr); // nohup means it
  }
}

} // namespace

void catch_signals() {
  // The second one of these meets the system's own answer: the end. A terminal that closes and a queue may
  // well say the others twice.
  catch_with(static_cast<int>(SA_RESETHAND), {SIGINT, SIGTERM});
  catch_with(0, {SIGHUP, SIGUSR1});
}

int caught_signal() {
  return caught;
}
