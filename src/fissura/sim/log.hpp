#pragma once
// What a run says: to the terminal (unless quiet) and, once a file is open, to log.txt of the run folder. The
// library behind it is seen by log.cpp alone: its headers take seconds to compile.
#include <memory>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace fissura::sim {

class Log {
 public:
  enum class Level { debug, info, warning, error };

  explicit Log(bool quiet);
  ~Log();

  /// Opens the file, anew or behind what it holds; throws core::Error(Failure::io). The file also holds what
  /// the terminal does not show (debug).
  void open_file(std::string const& path, bool anew = true);
  /// Ends the file, if there is one; throws core::Error(Failure::io) if the system could not keep what it
  /// took.
  void close_file();
  void flush();

  /// One line, as fmt::format makes it; throws core::Error(Failure::io) if it cannot be written.
  template <class... Args> void log(Level level, fmt::format_string<Args...> text, Args&&... args) {
    write(level, fmt::vformat(text, fmt::make_format_args(args...)));
  }
  template <class... Args> void debug(fmt::format_string<Args...> text, Args&&... args) {
    log(Level::debug, text, std::forward<Args>(args)...);
  }
  template <class... Args> void info(fmt::format_string<Args...> text, Args&&... args) {
    log(Level::info, text, std::forward<Args>(args)...);
  }
  template <class... Args> void warning(fmt::format_string<Args...> text, Args&&... args) {
    log(Level::warning, text, std::forward<Args>(args)...);
  }

 private:
  void write(Level level, std::string const& line);
  struct Sinks;
  std::unique_ptr<Sinks> sinks_;
};

} // namespace fissura::sim
