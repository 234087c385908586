#include "signals.hpp"

#include <csignal>

namespace {

volatile std::sig_atomic_t caught = 0;

void note(int signal) {
  caught = signal;
}

} // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND | SA_RESTART; // the second one meets the system's own answer: the end
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int caught_signal() {
  return caught;
}
