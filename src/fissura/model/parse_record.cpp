// The text of an acceleration record: rows of numbers with comments and headers around them.
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "fissura/model/record.hpp"

namespace fissura::model {

namespace {

constexpr std::size_t most_rows = 5000000;
constexpr int most_header_lines = 200;

bool separates(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
}

struct Word {
  std::string_view text;
  int column; ///< from 1
};

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && separates(line[i])) ++i;
    std::size_t const begin = i;
    while (i < line.size() && !separates(line[i])) ++i;
    if (i > begin) words.push_back({line.substr(begin, i - begin), static_cast<int>(begin) + 1});
  }
  return words;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  auto const [end, ec] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (ec != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_comment(std::vector<Word> const& words) {
  if (words.empty()) return true;
  auto const first = words.front().text;
  return first.starts_with('#') || first.starts_with('%') || first.starts_with('!') ||
         first.starts_with("//");
}

/// Reads a record line by line.
class Reading {
 public:
  Reading(std::string const& name, RecordSpec const& spec) : name_(name), spec_(spec) {}

  void line(std::string_view text) {
    ++line_;
    auto const words = words_of(text);
    if (is_comment(words)) return;
    if (record_.times.empty() && !is_row(words)) {
      if (++headers_ > most_header_lines)
        fail(words.front().column, "no row of numbers in the first 200 lines");
      return;
    }
    if (spec_.time_column > 0)
      timed_row(words);
    else
      spaced_row(words);
  }

  Record finish() {
    if (record_.times.size() < 2)
      throw core::InputError(core::Place{name_},
                             fmt::format("the record needs at least two rows of {}", wanted()));
    double const begin = record_.times.front();
    for (double& t : record_.times) t -= begin;
    return std::move(record_);
  }

 private:
  [[noreturn]] void fail(int column, std::string message) const {
    throw core::InputError({name_, line_, column}, std::move(message));
  }
  std::string wanted() const {
    if (spec_.time_column > 0)
      return fmt::format("a time in column {} and an acceleration in column {}", spec_.time_column,
                         spec_.acceleration_column);
    return spec_.acceleration_column > 0
               ? fmt::format("an acceleration in column {}", spec_.acceleration_column)
               : std::string("accelerations");
  }

  bool is_row(std::vector<Word> const& words) const {
    if (spec_.acceleration_column == 0) {
      for (auto const& w : words)
        if (!number_of(w.text)) return false;
      return true;
    }
    for (int const column : {spec_.time_column, spec_.acceleration_column}) {
      if (column == 0) continue;
      if (static_cast<std::size_t>(column) > words.size()) return false;
      if (!number_of(words[static_cast<std::size_t>(column) - 1].text)) return false;
    }
    return true;
  }

  double value(Word const& w) const {
    auto const v = number_of(w.text);
    if (!v)
      fail(w.column,
           fmt::format("`{}` is not a finite number; the record needs {}", w.text.substr(0, 40), wanted()));
    return *v;
  }
  Word const& cell(std::vector<Word> const& words, int column) const {
    if (static_cast<std::size_t>(column) > words.size())
      fail(words.back().column,
           fmt::format("this row has {} numbers; the record needs {}", words.size(), wanted()));
    return words[static_cast<std::size_t>(column) - 1];
  }

  void timed_row(std::vector<Word> const& words) {
    auto const& time = cell(words, spec_.time_column);
    double const t = value(time);
    if (!record_.times.empty() && !(t > record_.times.back()))
      fail(time.column,
           fmt::format("the times must increase from row to row: {} s after {} s", t, record_.times.back()));
    add(t, value(cell(words, spec_.acceleration_column)));
  }

  void spaced_row(std::vector<Word> const& words) {
    auto next = [&](Word const& w) {
      add(spec_.time_step * static_cast<double>(record_.times.size()), value(w));
    };
    if (spec_.acceleration_column > 0) return next(cell(words, spec_.acceleration_column));
    for (auto const& w : words) next(w);
  }

  void add(double t, double a) {
    if (record_.times.size() >= most_rows)
      fail(1, fmt::format("the record has more than {} values", most_rows));
    record_.times.push_back(t);
    record_.acceleration.push_back(a * spec_.unit);
  }

  std::string const& name_;
  RecordSpec const& spec_;
  Record record_;
  int line_ = 0, headers_ = 0;
};

} // namespace

Record parse_record(std::string_view text, std::string const& name, RecordSpec const& spec) {
  if (text.find('\0') != std::string_view::npos)
    throw core::InputError(core::Place{name}, "the record is not a text file: it holds a zero byte");
  Reading reading(name, spec);
  while (!text.empty()) {
    auto const end = text.find('\n');
    reading.line(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return reading.finish();
}

} // namespace fissura::model
