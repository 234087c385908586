#include "fissura/output/csv.hpp"

#include <cerrno>
#include <fcntl.h>
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

CsvWriter::CsvWriter(std::string path, std::vector<Column> const& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw_io_error("open", path_, errno);
  std::string header = "time [s]";
  for (Column const& c : columns) {
    header += ',';
    header += quoted(fmt::format("{} [{}]", c.name, c.unit));
  }
  header += '\n';
  try {
    write_all(descriptor_, header, path_);
  } catch (...) {
    ::close(descriptor_); // no destructor runs for an object that was never built
    throw;
  }
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
  write_all(descriptor_, {line_.data(), line_.size()}, path_);
}

void CsvWriter::close() {
  if (::fsync(descriptor_) != 0) throw_io_error("flush", path_, errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) throw_io_error("close", path_, errno);
}

} // namespace fissura::output
