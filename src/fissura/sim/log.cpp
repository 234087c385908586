#include "fissura/sim/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "fissura/core/error.hpp"

namespace fissura::sim {

std::shared_ptr<spdlog::logger> make_log(bool quiet) {
  auto log = std::make_shared<spdlog::logger>("fissura");
  if (!quiet) {
    auto sink = std::make_shared<spdlog::sinks::stdout_color_sink_mt>();
    sink->set_pattern("%^%v%$");
    sink->set_level(spdlog::level::info);
    log->sinks().push_back(sink);
  }
  log->set_level(spdlog::level::debug);
  log->flush_on(spdlog::level::debug);
  return log;
}

void log_to_file(spdlog::logger& log, std::string const& path, bool anew) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path, anew);
    sink->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
    log.sinks().push_back(sink);
  } catch (spdlog::spdlog_ex const& e) {
    throw core::Error(core::Failure::io, path + ": cannot open the log: " + e.what());
  }
}

} // namespace fissura::sim
