#include "fissura/sim/old_history.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::sim {

namespace {

[[noreturn]] void refuse(std::string const& path, std::string_view reason) {
  throw core::InputError({path}, fmt::format("the run cannot go on with this file: {}", reason));
}

std::string bytes_of(std::string const& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) output::throw_io_error("open", path, errno);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The fields of a header, as they stand there: quotes may hold commas.
std::vector<std::string_view> titles_of(std::string_view header) {
  std::vector<std::string_view> titles;
  bool is_quoted = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i <= header.size(); ++i) {
    if (i < header.size() && header[i] == '"') is_quoted = !is_quoted;
    if (i < header.size() && (header[i] != ',' || is_quoted)) continue;
    titles.push_back(header.substr(from, i - from));
    from = i + 1;
  }
  return titles;
}

/// Where the lines that were there at the mark end.
std::size_t end_of_rows(std::string const& path, std::string_view text, HistoryMark const& mark,
                        bool is_as_then) {
  if (is_as_then) {
    if (text.size() < mark.bytes) refuse(path, "it is shorter than when the checkpoint was written");
    if (mark.bytes == 0 || text[mark.bytes - 1] != '\n')
      refuse(path, "no line ends where the checkpoint was written");
    return mark.bytes;
  }
  std::size_t at = 0;
  for (std::int64_t line = 0; line <= mark.rows; ++line) {
    std::size_t const end = text.find('\n', at);
    if (end == std::string_view::npos) refuse(path, "it is shorter than when the checkpoint was written");
    at = end + 1;
  }
  return at;
}

std::vector<double> numbers_in(std::string const& path, std::string_view lines, std::size_t columns) {
  std::vector<double> numbers;
  while (!lines.empty()) {
    std::size_t const length = lines.find('\n'), before = numbers.size();
    char const *at = lines.data(), *const end = at + length;
    for (double value = 0; at < end; ++at) {
      auto const [next, error] = std::from_chars(at, end, value);
      if (error != std::errc() || (next < end && *next != ',')) break;
      numbers.push_back(value);
      at = next;
    }
    if (numbers.size() - before != columns) refuse(path, "a row has too few or too many values");
    lines.remove_prefix(length + 1);
  }
  return numbers;
}

} // namespace

OldHistory read_old_history(std::string const& path, HistoryMark const& mark,
                            std::vector<output::Column> const& columns, std::vector<bool> const& is_new) {
  std::string const text = bytes_of(path), wanted = output::csv_header(columns);
  std::string const header = text.substr(0, text.find('\n') + 1);
  // A run that was killed after it had written the file anew: the columns are those wanted already.
  if (header != mark.header && header != wanted)
    refuse(path, "its columns are others than when the checkpoint was written");
  OldHistory old;
  old.column_count = columns.size() + 1;
  old.bytes = end_of_rows(path, text, mark, header == mark.header);
  auto const titles = titles_of(std::string_view(header).substr(0, header.size() - 1));
  auto rows = numbers_in(path, std::string_view(text).substr(header.size(), old.bytes - header.size()),
                         titles.size());
  if (rows.size() != titles.size() * static_cast<std::size_t>(mark.rows))
    refuse(path, "it has more or fewer rows than when the checkpoint was written");
  if (header == wanted && std::find(is_new.begin(), is_new.end(), true) == is_new.end()) {
    old.rows = std::move(rows);
    return old;
  }
  auto const wanted_titles = titles_of(std::string_view(wanted).substr(0, wanted.size() - 1));
  std::vector<std::size_t> source;
  for (std::size_t i = 0; i < wanted_titles.size(); ++i) {
    auto const found = std::find(titles.begin(), titles.end(), wanted_titles[i]);
    bool const is_kept = found != titles.end() && (i == 0 || !is_new[i - 1]);
    source.push_back(is_kept ? static_cast<std::size_t>(found - titles.begin()) : titles.size());
  }
  old.text = wanted;
  auto out = std::back_inserter(old.text);
  for (std::size_t row = 0; row < rows.size(); row += titles.size())
    for (std::size_t i = 0; i < source.size(); ++i) {
      double const value =
          source[i] < titles.size() ? rows[row + source[i]] : std::numeric_limits<double>::quiet_NaN();
      old.rows.push_back(value);
      fmt::format_to(out, "{}{}", value, i + 1 < source.size() ? ',' : '\n');
    }
  old.bytes = old.text.size();
  return old;
}

} // namespace fissura::sim
