#include "fissura/checkpoint/file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include "fissura/core/error.hpp"
#include "fissura/core/hash.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::checkpoint {

namespace {

constexpr std::string_view magic = "fissura restart\n", end_mark = "complete";
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::size_t head_size = magic.size() + 8, tail_size = 16 + end_mark.size();

template <class T> std::string_view bytes_of(T const& x) {
  return {reinterpret_cast<char const*>(&x), sizeof x};
}
template <class T> T read_at(std::string_view bytes, std::size_t at) {
  T x;
  std::memcpy(&x, bytes.data() + at, sizeof x);
  return x;
}

/// Gathers small pieces, hashes them and hands them to the file.
class HashedSink : public Sink {
 public:
  explicit HashedSink(output::AtomicFile& file) : file_(file) { waiting_.reserve(2 * piece); }
  void write(std::string_view bytes) override {
    size_ += bytes.size();
    if (bytes.size() >= piece) {
      flush();
      pass_on(bytes);
      return;
    }
    waiting_.append(bytes);
    if (waiting_.size() >= piece) flush();
  }
  void flush() {
    pass_on(waiting_);
    waiting_.clear();
  }
  std::uint64_t size() const { return size_; }
  std::uint64_t hash() const { return hash_.value(); }

 private:
  static constexpr std::size_t piece = 1 << 16;
  void pass_on(std::string_view bytes) {
    hash_.add(bytes.data(), bytes.size());
    file_.write(bytes);
  }
  output::AtomicFile& file_;
  core::Hash hash_;
  std::string waiting_;
  std::uint64_t size_ = 0;
};

/// A file descriptor that closes itself.
struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

std::string bytes_in(std::string const& path) {
  Descriptor const file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.value < 0) output::throw_io_error("open", path, errno);
  struct stat about {};
  if (::fstat(file.value, &about) != 0 || !S_ISREG(about.st_mode))
    throw core::InputError({path}, "this is not a file");
  return output::read_all(file.value, static_cast<std::size_t>(about.st_size), path);
}

} // namespace

void write_file(std::string const& path, std::function<void(Saver&)> const& contents) {
  output::AtomicFile file(path);
  HashedSink sink(file);
  sink.write(magic);
  sink.write(bytes_of(format_version));
  sink.write(bytes_of(byte_order));
  Saver saver(sink);
  contents(saver);
  std::uint64_t const length = sink.size() - head_size;
  sink.write(bytes_of(length));
  sink.flush();
  std::uint64_t const hash = sink.hash();
  file.write(bytes_of(hash));
  file.write(end_mark);
  file.commit();
}

std::string_view contents_of(std::string_view bytes, std::string const& path) {
  auto refuse = [&](std::string const& reason) { throw core::InputError({path}, reason); };
  if (bytes.size() < head_size || bytes.substr(0, magic.size()) != magic)
    refuse("this is not a checkpoint of Fissura");
  if (read_at<std::uint32_t>(bytes, magic.size() + 4) != byte_order)
    refuse("this checkpoint was written on a machine with another order of bytes");
  auto const version = read_at<std::uint32_t>(bytes, magic.size());
  if (version > format_version)
    refuse(fmt::format("this checkpoint has the format {}, this program reads up to {}: go on with the "
                       "program that wrote it, or a newer one",
                       version, format_version));
  if (version == 0) refuse("this checkpoint has been altered: there is no format 0");
  if (version < format_version)
    refuse(
        fmt::format("this checkpoint has the format {}, this program reads {}: go on with the program that "
                    "wrote it",
                    version, format_version));
  if (bytes.size() < head_size + tail_size || bytes.substr(bytes.size() - end_mark.size()) != end_mark)
    refuse("this checkpoint has been cut off, or altered at its end");
  std::size_t const tail = bytes.size() - tail_size;
  if (read_at<std::uint64_t>(bytes, tail) != tail - head_size)
    refuse("this checkpoint has been cut off or altered: its length is not the one it names");
  if (read_at<std::uint64_t>(bytes, tail + 8) != core::hash_bytes(bytes.data(), tail + 8, 0))
    refuse("this checkpoint has been altered: its checksum is wrong");
  return bytes.substr(head_size, tail - head_size);
}

std::string read_file(std::string const& path) {
  std::string bytes = bytes_in(path);
  std::size_t const size = contents_of(bytes, path).size();
  bytes.resize(head_size + size);
  bytes.erase(0, head_size);
  return bytes;
}

} // namespace fissura::checkpoint
