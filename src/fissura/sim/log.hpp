#pragma once
#include <memory>
#include <string>

#include <spdlog/logger.h>

namespace fissura::sim {

/// A logger to the terminal (unless quiet) and, once opened, to log.txt of the run folder.
std::shared_ptr<spdlog::logger> make_log(bool quiet);
/// Adds the file, anew or behind what it holds; throws core::Error(Failure::io). The file also holds what the
/// terminal does not show (level debug).
void log_to_file(spdlog::logger& log, std::string const& path, bool anew = true);
/// Ends the file, if there is one; throws core::Error(Failure::io) if the system could not keep what it took.
void close_log_file(spdlog::logger& log);

} // namespace fissura::sim
