#include "fissura/sim/run_lock.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::sim {

namespace {

constexpr std::string_view mark = "fissura: in use by ";

std::string path_in(std::string const& folder) {
  return folder + "/.lock";
}

std::string this_process() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return fmt::format("process {} on {}", ::getpid(), host.data());
}

std::string first_line(std::string const& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

/// What the holder has written; "another run" before it has.
std::string holder(std::string const& path) {
  std::string const line = first_line(path);
  return line.size() > mark.size() && line.starts_with(mark) ? line.substr(mark.size()) : "another run";
}

} // namespace

RunLock::RunLock(std::string const& folder) : path_(path_in(folder)) {
  try {
    while (!try_once()) {
    }
    output::write_all(descriptor_, fmt::format("{}{}\n", mark, this_process()), path_);
  } catch (...) {
    if (descriptor_ >= 0) ::unlink(path_.c_str()), ::close(std::exchange(descriptor_, -1));
    throw; // no destructor runs for an object that was never built
  }
}

/// False where the file that was opened has been taken away meanwhile by the run that let it go.
bool RunLock::try_once() {
  int const file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) output::throw_io_error("open the lock", path_, errno);
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    int const why = errno;
    if (why == EWOULDBLOCK) {
      ::close(file);
      throw core::Error(
          core::Failure::io,
          fmt::format("{} is in use by {}: wait until that run has ended, stop it (`touch {}/stop`), or "
                      "choose another --out",
                      path_.substr(0, path_.rfind('/')), holder(path_), path_.substr(0, path_.rfind('/'))));
    }
    if (why == EINTR) return ::close(file), false;
    doubt_ =
        fmt::format("this file system cannot lock files ({}): nothing keeps a second run out of the folder",
                    std::strerror(why));
  }
  struct stat open {
  }, there{};
  bool const is_there = ::fstat(file, &open) == 0 && ::stat(path_.c_str(), &there) == 0 &&
                        open.st_ino == there.st_ino && open.st_dev == there.st_dev;
  if (!is_there) return ::close(file), false;
  descriptor_ = file;
  found_ = first_line(path_);
  if (::ftruncate(descriptor_, 0) != 0) output::throw_io_error("write", path_, errno);
  return true;
}

RunLock::~RunLock() {
  if (descriptor_ < 0) return;
  std::string const before = found_ + '\n';
  bool const is_back = !found_.empty() && ::ftruncate(descriptor_, 0) == 0 &&
                       ::pwrite(descriptor_, before.data(), before.size(), 0) > 0;
  if (!is_back) ::unlink(path_.c_str()); // before it is let go: who comes next makes a file of its own
  ::close(descriptor_);
}

RunLock::RunLock(RunLock&& other) noexcept
    : path_(std::move(other.path_)), doubt_(std::move(other.doubt_)), found_(std::move(other.found_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

RunLock& RunLock::operator=(RunLock&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(doubt_, other.doubt_);
  std::swap(found_, other.found_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void RunLock::release() {
  if (descriptor_ < 0) return;
  ::unlink(path_.c_str());
  output::close_file(std::exchange(descriptor_, -1), path_);
}

bool RunLock::was_left_in(std::string const& folder) {
  return first_line(path_in(folder)).starts_with(mark);
}

} // namespace fissura::sim
