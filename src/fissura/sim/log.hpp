#pragma once
#include <memory>
#include <string>

#include <spdlog/logger.h>

namespace fissura::sim {

/// A logger to the terminal (unless quiet) and, once opened, to log.txt of the run folder.
std::shared_ptr<spdlog::logger> make_log(bool quiet);
/// Adds the file; throws core::Error(Failure::io).
void log_to_file(spdlog::logger& log, std::string const& path);

} // namespace fissura::sim
