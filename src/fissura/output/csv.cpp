#include "fissura/output/csv.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h> // and not core.h: clang 14 gives the function that it declares another name than gcc
#include <fstream>
#include <iterator>
#include <string_view>
#include <unistd.h>
#include <utility>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::output {

namespace {

/// RFC 4180: a field with a comma, quote or line break stands in quotes, its quotes doubled.
std::string quoted(std::string const& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string out = "\"";
  for (char const c : field) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

} // namespace

std::string csv_header(std::vector<Column> const& columns) {
  std::string header = "time [s]";
  for (Column const& c : columns) {
    header += ',';
    header += quoted(fmt::format("{} [{}]", c.name, c.unit));
  }
  return header + '\n';
}

namespace {

/// Whether the file begins with this header and has a line that ends after so many bytes.
void check_start(std::string const& path, std::string const& header, std::uint64_t bytes) {
  auto refuse = [&](char const* reason) {
    throw core::InputError({path}, fmt::format("the run cannot go on with this file: {}", reason));
  };
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw_io_error("open", path, errno);
  if (static_cast<std::uint64_t>(in.tellg()) < bytes)
    refuse("it is shorter than when the checkpoint was written");
  std::string start(header.size(), '\0');
  in.seekg(0);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (bytes < header.size() || start != header) refuse("its columns are others");
  in.seekg(static_cast<std::streamoff>(bytes - 1));
  if (in.get() != '\n') refuse("no line ends where the checkpoint was written");
}

} // namespace

CsvWriter::CsvWriter(std::string path, std::vector<Column> const& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw_io_error("open", path_, errno);
  std::string const header = csv_header(columns);
  try {
    write_all(descriptor_, header, path_);
  } catch (...) {
    ::close(descriptor_); // no destructor runs for an object that was never built
    throw;
  }
  bytes_ = header.size();
}

CsvWriter::CsvWriter(std::string path, std::vector<Column> const& columns, std::uint64_t bytes)
    : path_(std::move(path)), columns_(columns.size()), bytes_(bytes) {
  check_start(path_, csv_header(columns), bytes);
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) throw_io_error("open", path_, errno);
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) == 0) return;
  int const why = errno;
  ::close(descriptor_);
  throw_io_error("cut back", path_, why);
}

CsvWriter::~CsvWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void CsvWriter::row(double time, std::span<double const> values) {
  if (values.size() != columns_) {
    throw core::Error(core::Failure::run,
                      fmt::format("'{}' has {} columns, the row has {}", path_, columns_, values.size()));
  }
  line_.clear();
  auto out = std::back_inserter(line_);
  fmt::format_to(out, "{}", time);
  for (double const v : values) fmt::format_to(out, ",{}", v);
  line_.push_back('\n');
  check_in_place(descriptor_, path_);
  write_all(descriptor_, line_, path_);
  bytes_ += line_.size();
}

void CsvWriter::flush() {
  check_in_place(descriptor_, path_);
  if (::fsync(descriptor_) != 0) throw_io_error("flush", path_, errno);
}

void CsvWriter::close() {
  flush();
  close_file(std::exchange(descriptor_, -1), path_);
}

} // namespace fissura::output
