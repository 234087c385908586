#include "fissura/mesh/msh_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/core.h>
#include <limits>

#include "fissura/core/error.hpp"

namespace fissura::mesh {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// A word as it may stand in a message: short, and without bytes that are no text.
std::string shown(std::string_view word) {
  std::string s(word.substr(0, 24));
  for (char& c : s)
    if (c < ' ' || c > '~') c = '?';
  return s;
}

} // namespace

void MshScanner::refuse(std::string message) const {
  auto const end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
  int const line = is_binary ? 0 : 1 + static_cast<int>(std::count(text_.begin(), end, '\n'));
  throw core::InputError({file_, line, 0}, std::move(message));
}

std::string_view MshScanner::word() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  std::size_t const begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view MshScanner::next_section() {
  std::string_view const name = word();
  if (name.empty()) return {};
  if (name.front() != '$' || name.starts_with("$End"))
    refuse(fmt::format("expected the name of a section ($Nodes, $Elements, ...), found '{}'", shown(name)));
  return name.substr(1);
}

void MshScanner::skip_section(std::string_view name) {
  std::string const mark = fmt::format("$End{}", name);
  auto const found = text_.find(mark, at_);
  if (found == std::string_view::npos) refuse(fmt::format("the section ${} has no end", shown(name)));
  at_ = found + mark.size();
}

void MshScanner::end_section(std::string_view name) {
  std::string_view const found = word();
  if (found.size() != name.size() + 4 || !found.starts_with("$End") || found.substr(4) != name)
    refuse(fmt::format("expected $End{}, found '{}'", name, shown(found)));
}

std::int64_t MshScanner::written_integer(char const* what) {
  std::string_view const w = word();
  std::int64_t value = 0;
  auto const [end, ec] = std::from_chars(w.data(), w.data() + w.size(), value);
  if (ec != std::errc{} || end != w.data() + w.size())
    refuse(fmt::format("expected {} (a whole number), found '{}'", what, shown(w)));
  return value;
}

double MshScanner::written_number(char const* what) {
  std::string_view w = word();
  if (w.starts_with('+')) w.remove_prefix(1);
  double value = 0;
  auto const [end, ec] = std::from_chars(w.data(), w.data() + w.size(), value);
  bool const is_tiny = ec == std::errc::result_out_of_range &&
                       w.find_first_of("eE") != std::string_view::npos &&
                       w[w.find_first_of("eE") + 1 < w.size() ? w.find_first_of("eE") + 1 : 0] == '-';
  if ((ec != std::errc{} && !is_tiny) || end != w.data() + w.size())
    refuse(fmt::format("expected {} (a number), found '{}'", what, shown(w)));
  return is_tiny ? 0 : value;
}

std::string MshScanner::quoted(char const* what) {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  auto const end =
      at_ < text_.size() && text_[at_] == '"' ? text_.find('"', at_ + 1) : std::string_view::npos;
  if (end == std::string_view::npos || text_.substr(at_, end - at_).find('\n') != std::string_view::npos)
    refuse(fmt::format("expected {} in quotes", what));
  std::string const s(text_.substr(at_ + 1, end - at_ - 1));
  at_ = end + 1;
  return s;
}

void MshScanner::begin_bytes() {
  if (!is_binary) return;
  if (at_ < text_.size() && text_[at_] == '\r') ++at_;
  if (at_ >= text_.size() || text_[at_] != '\n') refuse("expected the end of the line before the bytes");
  ++at_;
}

template <class T> T MshScanner::raw(char const* what) {
  if (text_.size() - at_ < sizeof(T)) refuse(fmt::format("the file ends where {} should be", what));
  T value;
  std::memcpy(&value, text_.data() + at_, sizeof value);
  at_ += sizeof value;
  return value;
}

int MshScanner::integer(char const* what) {
  if (is_binary) return raw<std::int32_t>(what);
  std::int64_t const value = written_integer(what);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    refuse(fmt::format("{} = {} is too large", what, value));
  return static_cast<int>(value);
}

std::uint64_t MshScanner::size(char const* what) {
  std::int64_t const value = is_binary ? raw<std::int64_t>(what) : written_integer(what);
  if (value < 0) refuse(fmt::format("{} = {} is negative", what, value));
  return static_cast<std::uint64_t>(value);
}

double MshScanner::number(char const* what) {
  return is_binary ? raw<double>(what) : written_number(what);
}

std::size_t MshScanner::count(char const* what, std::size_t least_characters, std::size_t least_bytes) {
  return checked(static_cast<std::int64_t>(size(what)), what, least_characters, least_bytes);
}

std::size_t MshScanner::checked(std::int64_t count, char const* what, std::size_t least_characters,
                                std::size_t least_bytes) const {
  std::size_t const least = is_binary ? least_bytes : least_characters, left = text_.size() - at_;
  if (count < 0 || static_cast<std::uint64_t>(count) > left / least + 1)
    refuse(fmt::format("{} = {}, but there are only {} bytes left in the file", what, count, left));
  return static_cast<std::size_t>(count);
}

void MshScanner::skip_numbers(std::size_t how_many, char const* what) {
  for (std::size_t i = 0; i < how_many; ++i) number(what);
}

void MshScanner::skip_line() {
  auto const end = text_.find('\n', at_);
  at_ = end == std::string_view::npos ? text_.size() : end;
}

} // namespace fissura::mesh
