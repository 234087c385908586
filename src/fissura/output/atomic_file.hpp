#pragma once
// A file that appears whole or not at all: written under a temporary name, flushed to the disk, then renamed.
// A reader (ParaView on a running job, a plot script) never sees half of it, and a crash leaves the previous
// version.
#include <cstddef>
#include <string>
#include <string_view>

namespace fissura::output {

/// Throws core::Error(Failure::io) "cannot <doing> '<path>': <text of errno>".
[[noreturn]] void throw_io_error(std::string_view doing, std::string const& path, int errno_value);

/// Writes all bytes to a descriptor, continuing after short writes and interrupts; throws as above.
void write_all(int descriptor, std::string_view bytes, std::string const& path);

/// All bytes of an open file from where it stands, `expected` of them or fewer if it ends before; throws as
/// above.
std::string read_all(int descriptor, std::size_t expected, std::string const& path);

/// Closes a file that was written to; throws as above, for what the system could not keep after all.
void close_file(int descriptor, std::string const& path);

/// Throws as above if `path` no longer names the file that is open: it was removed or replaced, or its folder
/// was. What is written then would be lost in silence.
void check_in_place(int descriptor, std::string const& path);

/// Makes what was renamed or removed in a folder durable; throws as above.
void flush_folder(std::string const& folder);

class AtomicFile {
 public:
  /// Opens "<path>.part" for writing; throws core::Error(Failure::io) if that fails.
  explicit AtomicFile(std::string path);
  /// Without commit() the temporary is removed and `path` stays as it was.
  ~AtomicFile();
  AtomicFile(AtomicFile const&) = delete;
  AtomicFile& operator=(AtomicFile const&) = delete;

  void write(std::string_view bytes);
  /// Flushes to the disk and renames; every failing call throws and leaves `path` as it was.
  void commit();

 private:
  std::string path_, temporary_;
  int descriptor_ = -1;
};

/// The whole of `text` as the new content of `path`.
void replace_file(std::string const& path, std::string_view text);

} // namespace fissura::output
