#include "fissura/sim/log.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <mutex>
#include <unistd.h>
#include <utility>

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "fissura/core/error.hpp"
#include "fissura/core/printable.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/sim/terminal.hpp"

namespace fissura::sim {

namespace {

/// log.txt, line by line. The library's own file sink writes through a buffer that loses a full disk.
class LogFile final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  LogFile(std::string path, bool anew) : path_(std::move(path)) {
    int const begin = anew ? O_TRUNC : 0;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | begin, 0666);
    if (descriptor_ < 0) output::throw_io_error("open the log", path_, errno);
  }
  ~LogFile() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  void close() { output::close_file(std::exchange(descriptor_, -1), path_); }
  LogFile(LogFile const&) = delete;
  LogFile& operator=(LogFile const&) = delete;

 private:
  void sink_it_(spdlog::details::log_msg const& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    output::check_in_place(descriptor_, path_);
    output::write_all(descriptor_, {line.data(), line.size()}, path_);
  }
  void flush_() override {}

  std::string path_;
  int descriptor_ = -1;
};

} // namespace

struct Log::Sinks {
  spdlog::logger logger{"fissura"};
  std::shared_ptr<LogFile> file;
};

Log::Log(bool quiet) : sinks_(std::make_unique<Sinks>()) {
  auto& log = sinks_->logger;
  if (!quiet) {
    auto const mode = standard_output().colour ? spdlog::color_mode::always : spdlog::color_mode::never;
    auto sink = std::make_shared<spdlog::sinks::stdout_color_sink_mt>(mode);
    sink->set_color(spdlog::level::info, "");
    sink->set_color(spdlog::level::warn, "\x1b[33m");
    sink->set_color(spdlog::level::err, "\x1b[1;31m");
    sink->set_pattern("%^%v%$");
    sink->set_level(spdlog::level::info);
    log.sinks().push_back(sink);
  }
  log.set_level(spdlog::level::debug);
  log.flush_on(spdlog::level::debug);
  // The library would print what goes wrong to the terminal, once a second, and go on.
  log.set_error_handler([](std::string const& why) { throw core::Error(core::Failure::io, why); });
}

Log::~Log() = default;

void Log::open_file(std::string const& path, bool anew) {
  sinks_->file = std::make_shared<LogFile>(path, anew);
  sinks_->file->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  sinks_->logger.sinks().push_back(sinks_->file);
}

void Log::close_file() {
  if (!sinks_->file) return;
  std::erase(sinks_->logger.sinks(), sinks_->file);
  std::exchange(sinks_->file, nullptr)->close();
}

void Log::write(Level level, std::string const& line) {
  constexpr std::array levels{spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                              spdlog::level::err};
  // Names and texts of the case reach the terminal, and whoever prints log.txt, through here.
  sinks_->logger.log(levels[static_cast<std::size_t>(level)], core::printable(line));
}

void Log::flush() {
  sinks_->logger.flush();
}

} // namespace fissura::sim
