#include "fissura/sim/requests.hpp"

#include <csignal>
#include <fmt/core.h>
#include <unistd.h>
#include <utility>

namespace fissura::sim {

namespace {

std::string name_of(int signal) {
  return signal == SIGINT    ? "SIGINT (Ctrl-C)"
         : signal == SIGTERM ? "SIGTERM"
         : signal == SIGHUP  ? "SIGHUP"
         : signal == SIGUSR1 ? "SIGUSR1"
                             : fmt::format("signal {}", signal);
}

} // namespace

Requests::Requests(std::function<int()> signal, std::optional<double> walltime)
    : signal_(std::move(signal)), walltime_(walltime) {}

bool Requests::take(char const* file) const {
  return ::unlink((folder_ + "/" + file).c_str()) == 0;
}

void Requests::look_for_files() {
  auto const now = clock::now();
  if (folder_.empty() || now < next_look_) return;
  next_look_ = now + std::chrono::milliseconds(10);
  stop_ = stop_ || ::access((folder_ + "/stop").c_str(), F_OK) == 0;
  output_ |= take("output_now");
}

std::optional<std::string> Requests::to_stop() {
  if (int const signal = signal_ ? signal_() : 0; signal != 0) return "stopped by " + name_of(signal);
  if (walltime_ && std::chrono::duration<double>(clock::now() - start_).count() >= *walltime_)
    return "wall time used up";
  look_for_files();
  if (stop_) take("stop");
  if (stop_) return "a file `stop` was found in the run folder";
  return std::nullopt;
}

void Requests::check_signal() const {
  if (int const signal = signal_ ? signal_() : 0; signal != 0)
    throw Interrupted(fmt::format("stopped by {} before the first step", name_of(signal)));
}

bool Requests::for_output() {
  return std::exchange(output_, false);
}

} // namespace fissura::sim
