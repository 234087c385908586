#include "fissura/output/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "fissura/core/error.hpp"

namespace fissura::output {

void throw_io_error(std::string_view doing, std::string const& path, int errno_value) {
  throw core::Error(core::Failure::io,
                    fmt::format("cannot {} '{}': {}", doing, path, std::strerror(errno_value)));
}

void write_all(int descriptor, std::string_view bytes, std::string const& path) {
  while (!bytes.empty()) {
    ssize_t const written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw_io_error("write", path, errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string read_all(int descriptor, std::size_t expected, std::string const& path) {
  std::string bytes(expected, '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    ssize_t const n = ::read(descriptor, bytes.data() + have, bytes.size() - have);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw_io_error("read", path, errno);
    if (n == 0) break;
    have += static_cast<std::size_t>(n);
  }
  bytes.resize(have);
  return bytes;
}

void close_file(int descriptor, std::string const& path) {
  if (::close(descriptor) != 0) throw_io_error("close", path, errno);
}

void check_in_place(int descriptor, std::string const& path) {
  struct stat open {
  }, there{};
  if (::fstat(descriptor, &open) != 0) throw_io_error("look at", path, errno);
  if (::stat(path.c_str(), &there) != 0) throw_io_error("go on writing", path, errno);
  if (open.st_ino != there.st_ino || open.st_dev != there.st_dev)
    throw core::Error(core::Failure::io,
                      fmt::format("cannot go on writing '{}': another file has taken its place", path));
}

// Some network file systems refuse to flush a folder; the data is safe anyway.
void flush_folder(std::string const& folder) {
  int const descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw_io_error("open the folder", folder, errno);
  int const failed = ::fsync(descriptor) != 0 ? errno : 0;
  ::close(descriptor);
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP)
    throw_io_error("flush the folder", folder, failed);
}

namespace {

/// Makes the rename itself durable.
void flush_folder_of(std::string const& path) {
  auto const slash = path.rfind('/');
  flush_folder(slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash));
}

} // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), temporary_(path_ + ".part") {
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw_io_error("open", temporary_, errno);
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  write_all(descriptor_, bytes, temporary_);
}

void AtomicFile::commit() {
  if (::fsync(descriptor_) != 0) throw_io_error("flush", temporary_, errno);
  close_file(std::exchange(descriptor_, -1), temporary_);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw_io_error("rename to", path_, errno);
  temporary_.clear();
  flush_folder_of(path_);
}

void replace_file(std::string const& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

} // namespace fissura::output
