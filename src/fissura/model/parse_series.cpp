#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <optional>

#include "fissura/core/error.hpp"
#include "fissura/core/number.hpp"
#include "fissura/model/series.hpp"
#include "fissura/units/units.hpp"

namespace fissura::model {

namespace {

using core::InputError;
using core::Place;

constexpr std::size_t most_rows = 5000000;
constexpr int most_header_lines = 200;
/// Steps that differ by more are different ones [-].
constexpr double same_step = 0.01;
/// A count in the first row is at least this: few values begin with their number by chance.
constexpr double least_count = 10;

bool separates(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
}

struct Word {
  std::string_view text;
  int column; ///< from 1
};

/// Where a second number begins in a word whose columns touch: at a sign behind a digit, if both parts have a
/// decimal point ("1.5-3" may as well be 1.5e-3). 0 if nowhere.
std::size_t touching_at(std::string_view word) {
  for (std::size_t i = 1; i < word.size(); ++i) {
    bool const sign = (word[i] == '-' || word[i] == '+') && word[i - 1] >= '0' && word[i - 1] <= '9';
    bool const sign_after_point = (word[i] == '-' || word[i] == '+') && word[i - 1] == '.';
    if (!sign && !sign_after_point) continue;
    auto const first = word.substr(0, i);
    if (first.find('.') != std::string_view::npos && core::read_decimal(first)) return i;
  }
  return 0;
}

bool are_touching_numbers(std::string_view word) {
  while (true) {
    auto const at = touching_at(word);
    if (at == 0) return word.find('.') != std::string_view::npos && core::read_decimal(word).has_value();
    word.remove_prefix(at);
  }
}

void add_word(std::vector<Word>& words, std::string_view text, int column) {
  bool const part = !core::read_decimal(text) && touching_at(text) > 0 && are_touching_numbers(text);
  for (std::size_t at = part ? touching_at(text) : 0; at > 0; at = touching_at(text)) {
    words.push_back({text.substr(0, at), column});
    text.remove_prefix(at), column += static_cast<int>(at);
  }
  words.push_back({text, column});
}

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && separates(line[i])) ++i;
    std::size_t const begin = i;
    while (i < line.size() && !separates(line[i])) ++i;
    if (i > begin) add_word(words, line.substr(begin, i - begin), static_cast<int>(begin) + 1);
  }
  return words;
}

bool is_comment(std::vector<Word> const& words) {
  auto const first = words.front().text;
  return first.starts_with('#') || first.starts_with('%') || first.starts_with('!') ||
         first.starts_with("//");
}

/// Whether commas stand for decimal points: every one stands between two whole numbers, and nothing else
/// shows that they part numbers.
class Commas {
 public:
  void look(std::string_view line, int number) {
    std::size_t i = 0;
    while (i < line.size()) {
      auto const blank = [](char c) { return separates(c) && c != ','; };
      while (i < line.size() && blank(line[i])) ++i;
      std::size_t const begin = i;
      while (i < line.size() && !blank(line[i])) ++i;
      if (i > begin) chunk(line.substr(begin, i - begin), number, static_cast<int>(begin) + 1);
    }
  }
  bool may_be_decimal() const { return !first_.empty() && !part_numbers_; }
  std::string const& first() const { return first_; }
  int line() const { return line_; }
  int column() const { return column_; }

 private:
  void chunk(std::string_view text, int line, int column) {
    auto const comma = text.find(',');
    if (comma == std::string_view::npos) return;
    auto const whole = text.substr(0, comma), fraction = text.substr(comma + 1);
    bool const one = fraction.find(',') == std::string_view::npos;
    bool const digits = !fraction.empty() && fraction.front() >= '0' && fraction.front() <= '9' &&
                        fraction.find('.') == std::string_view::npos && core::read_decimal(fraction);
    bool const before = whole.find_first_of(".eEdD") == std::string_view::npos && core::read_decimal(whole);
    if (one && digits && before) {
      if (first_.empty()) first_ = text, line_ = line, column_ = column;
    } else {
      part_numbers_ = true;
    }
  }
  std::string first_;
  int line_ = 0, column_ = 0;
  bool part_numbers_ = false;
};

/// i steps, as near to the decimal number as a double can be: 3 x 0.1 s is 0.3 s.
class Steps {
 public:
  explicit Steps(double step) : step_(step) {
    for (int k = 0; k <= 15 && step > 0; ++k) {
      double const scale = std::pow(10.0, k), scaled = std::round(step * scale);
      if (scaled > 0 && scaled < 1e9 && scaled / scale == step) {
        numerator_ = scaled, denominator_ = scale;
        return;
      }
    }
  }
  double operator()(std::size_t i) const {
    auto const n = static_cast<double>(i);
    return denominator_ > 0 ? n * numerator_ / denominator_ : n * step_;
  }

 private:
  double step_, numerator_ = 0, denominator_ = 0;
};

/// Reads a file line by line.
class Reading {
 public:
  Reading(std::string const& name, SeriesFormat const& format) : name_(name), format_(format) {}

  void line(std::string_view text) {
    ++line_;
    auto const words = words_of(text);
    if (words.empty()) return;
    bool const begun = !values_.empty();
    if (is_comment(words)) {
      if (!begun) read_header_line(text, series_.header);
      return;
    }
    if (!begun && !is_row(words)) {
      if (++headers_ > most_header_lines)
        fail(words.front().column, "no row of numbers in the first 200 lines");
      read_header_line(text, series_.header);
      if (counts(words)) first_ = First{words_as_numbers(words), std::string(text), line_, 0};
      return;
    }
    commas_.look(text, line_);
    if (!begun) choose_layout();
    read_row(words, text);
  }

  Series finish() {
    refuse_decimal_commas();
    take_counting_row();
    if (undecided_) decide_layout();
    if (values_.size() < 2)
      throw InputError(Place{name_},
                       fmt::format("the {} needs at least two rows of {}", format_.what, wanted()));
    fill();
    compare_with_header();
    return std::move(series_);
  }

 private:
  /// A row, or a header of numbers alone, that may count the values behind it.
  struct First {
    std::vector<double> numbers;
    std::string text;
    int line = 0;
    std::size_t values = 0; ///< how many of its numbers stand in values_
  };

  void refuse_decimal_commas() const {
    if (commas_.may_be_decimal())
      throw InputError({name_, commas_.line(), commas_.column()},
                       fmt::format("`{}`: a decimal comma? Write a point; a comma that parts two numbers is "
                                   "followed by a blank",
                                   commas_.first()));
  }
  [[noreturn]] void fail(int column, std::string message) const {
    refuse_decimal_commas(); // they are the reason, whatever else is amiss
    throw InputError({name_, line_, column}, std::move(message));
  }
  std::string wanted() const {
    if (format_.time_column > 0)
      return fmt::format("a time in column {} and {} in column {}", format_.time_column, format_.value,
                         format_.value_column);
    auto const noun = format_.value.substr(format_.value.find(' ') + 1);
    return format_.value_column > 0 ? fmt::format("{} in column {}", format_.value, format_.value_column)
                                    : noun + "s";
  }

  bool is_row(std::vector<Word> const& words) const {
    if (format_.value_column == 0) return !words_as_numbers(words).empty();
    for (int const column : {format_.time_column, format_.value_column}) {
      if (column == 0) continue;
      if (static_cast<std::size_t>(column) > words.size()) return false;
      if (!core::read_decimal(words[static_cast<std::size_t>(column) - 1].text)) return false;
    }
    return true;
  }

  /// All of them, or none.
  static std::vector<double> words_as_numbers(std::vector<Word> const& words) {
    std::vector<double> numbers;
    for (auto const& w : words) {
      auto const value = core::read_decimal(w.text);
      if (!value) return {};
      numbers.push_back(*value);
    }
    return numbers;
  }

  /// "910", "910 0.0100" or "0.0100 910".
  static bool counts(std::vector<Word> const& words) {
    auto const numbers = words_as_numbers(words);
    return !numbers.empty() && numbers.size() <= 2 && count_in(numbers) > 0;
  }
  static double count_in(std::vector<double> const& numbers) {
    for (double const n : numbers)
      if (n >= least_count && n <= most_rows && n == std::floor(n)) return n;
    return 0;
  }
  static double step_in(std::vector<double> const& numbers) {
    if (numbers.size() != 2) return 0;
    double const other = numbers[0] == count_in(numbers) ? numbers[1] : numbers[0];
    return other > 0 ? other : 0;
  }

  /// A header names a step, and the deck neither columns nor a step: all numbers of all rows, unless the
  /// first column turns out to hold the times.
  void choose_layout() {
    if (!format_.as_header_says || series_.header.step <= 0) return;
    undecided_ = true;
    format_.time_step = series_.header.step;
  }

  void read_row(std::vector<Word> const& words, std::string_view text) {
    bool const begins = values_.empty() && all_.empty();
    if (undecided_) {
      for (auto const& w : words) all_.push_back(value(w)), si_.push_back(in_si(w));
      row_ends_.push_back(all_.size());
      if (all_.size() > most_rows) too_many();
      values_.push_back(0); // only says that rows have begun
      return;
    }
    if (format_.time_column > 0)
      timed_row(words);
    else
      spaced_row(words);
    if (begins && counts(words))
      first_ = First{words_as_numbers(words), std::string(text), line_, values_.size()};
  }

  double value(Word const& w) const {
    if (auto const v = core::read_decimal(w.text)) return *v;
    bool const touches = w.text.find_first_not_of("0123456789.+-eEdD") == std::string_view::npos;
    if (touches && w.text.size() > 1 && !core::decimal_text(w.text))
      fail(w.column, fmt::format("`{}` is no number; if columns of a fixed width touch here, part them by a "
                                 "blank",
                                 w.text.substr(0, 40)));
    fail(w.column, fmt::format("`{}` is not a finite number; the {} needs {}", w.text.substr(0, 40),
                               format_.what, wanted()));
  }
  /// In SI: the decimal point is shifted where the unit allows it, so that a file gives what a table in the
  /// deck would.
  double in_si(Word const& w) const {
    double const as_written = value(w);
    if (format_.unit == 1) return as_written;
    return units::times(*core::decimal_text(w.text), format_.unit);
  }
  Word const& cell(std::vector<Word> const& words, int column) const {
    if (static_cast<std::size_t>(column) > words.size())
      fail(words.back().column,
           fmt::format("this row has {} numbers; the {} needs {}", words.size(), format_.what, wanted()));
    return words[static_cast<std::size_t>(column) - 1];
  }

  void timed_row(std::vector<Word> const& words) {
    auto const& time = cell(words, format_.time_column);
    double const t = value(time);
    if (!times_.empty() && !(t > times_.back())) {
      if (times_.size() != 1 || first_.values == 0)
        fail(time.column,
             fmt::format("the times must increase from row to row: {} s after {} s{}", t, times_.back(),
                         times_.size() < 3 ? "; values without times need `time_step`" : ""));
      times_.clear(), values_.clear(); // a count stood where the first time is due
      first_.values = 0;
    }
    times_.push_back(t);
    add(in_si(cell(words, format_.value_column)));
  }

  void spaced_row(std::vector<Word> const& words) {
    if (format_.value_column > 0) return add(in_si(cell(words, format_.value_column)));
    for (auto const& w : words) add(in_si(w));
  }

  [[noreturn]] void too_many() const {
    fail(1, fmt::format("the {} has more than {} values", format_.what, most_rows));
  }
  void add(double v) {
    if (values_.size() >= most_rows) too_many();
    values_.push_back(v);
  }

  /// The first row, where it counts the values behind it, or names the deck's own step.
  void take_counting_row() {
    if (first_.numbers.empty()) return;
    double const count = count_in(first_.numbers), step = step_in(first_.numbers);
    std::size_t const behind = (undecided_ ? all_.size() : values_.size()) - first_.values;
    bool const counts_them = count == static_cast<double>(behind);
    bool const same = step > 0 && format_.time_step > 0 && std::abs(step / format_.time_step - 1) < 1e-6;
    bool const was_skipped = first_.values == 0;
    if (!counts_them && !same && !was_skipped) return;
    auto const drop = [&](std::vector<double>& column) {
      if (!column.empty())
        column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(first_.values));
    };
    drop(times_), drop(values_);
    auto& header = series_.header;
    if (header.count == 0 && (counts_them || step > 0)) header.count = static_cast<long>(count);
    if (header.step == 0 && step > 0) header.step = step, header.step_written = fmt::format("{} s", step);
    series_.notes.push_back(fmt::format("{}:{}: `{}` is taken for a header, not for values", name_,
                                        first_.line, trimmed(first_.text)));
  }
  static std::string trimmed(std::string text) {
    auto const last = text.find_last_not_of(" \t\r");
    text.resize(last == std::string::npos ? 0 : last + 1);
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size())).substr(0, 40);
  }

  /// Rows of two numbers or more whose first column counts the header's steps are times and values.
  void decide_layout() {
    bool timed = row_ends_.size() >= 2;
    for (std::size_t i = 0, begin = 0; timed && i < row_ends_.size(); begin = row_ends_[i++]) {
      timed = row_ends_[i] - begin >= 2 &&
              (i == 0 || std::abs(all_[begin] - all_[0] - static_cast<double>(i) * format_.time_step) <
                             0.5 * format_.time_step);
    }
    values_.clear();
    if (timed) {
      for (std::size_t i = 0, begin = 0; i < row_ends_.size(); begin = row_ends_[i++])
        times_.push_back(all_[begin]), values_.push_back(si_[begin + 1]);
    } else {
      format_.time_column = format_.value_column = 0;
      values_ = std::move(si_);
      series_.notes.push_back(
          fmt::format("{}: the step is that of the header, {}", name_, series_.header.step_written));
    }
  }

  void fill() {
    Steps const steps(format_.time_step);
    if (format_.time_column == 0) {
      times_.reserve(values_.size());
      for (std::size_t i = 0; i < values_.size(); ++i) times_.push_back(steps(i));
    }
    series_.times = std::move(times_), series_.values = std::move(values_);
  }

  void compare_with_header() {
    auto const& header = series_.header;
    auto const& t = series_.times;
    double const step = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    if (header.step > 0 && std::abs(header.step / step - 1) > same_step)
      series_.warnings.push_back(fmt::format(
          "{}: the header names a step of {:.6g} s, {} {:.6g} s: one of them is wrong, or the time is scaled "
          "on purpose",
          name_, header.step,
          format_.time_column > 0 ? "but its rows follow each other after" : "but `time_step` of the deck is",
          step));
    if (header.count > 0 && header.count != static_cast<long>(t.size()))
      series_.warnings.push_back(
          fmt::format("{}: the header names {} values, but {} are there: {}", name_, header.count, t.size(),
                      header.count > static_cast<long>(t.size()) ? "is the file cut off?"
                                                                 : "is something else in the file as well?"));
  }

  std::string const& name_;
  SeriesFormat format_;
  Series series_;
  Commas commas_;
  First first_;
  std::vector<double> times_, values_; ///< times only where the file has them
  bool undecided_ = false;
  std::vector<double> all_, si_;      ///< while the layout is undecided: as they stand, and in SI
  std::vector<std::size_t> row_ends_; ///< in all_
  int line_ = 0, headers_ = 0;
};

} // namespace

Series parse_series(std::string_view text, std::string const& name, SeriesFormat const& format) {
  if (text.find('\0') != std::string_view::npos)
    throw InputError(Place{name},
                     fmt::format("the {} is not a text file: it holds a zero byte", format.what));
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3); // some editors mark UTF-8
  Reading reading(name, format);
  while (!text.empty()) {
    auto const end = text.find_first_of("\n\r");
    reading.line(text.substr(0, end));
    bool const two = end != std::string_view::npos && text.substr(end).starts_with("\r\n");
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + (two ? 2 : 1));
  }
  return reading.finish();
}

std::string read_series_text(std::string const& file, std::string const& what) {
  constexpr std::uintmax_t largest = 64U << 20U;
  namespace fs = std::filesystem;
  std::error_code ec;
  if (fs::file_size(file, ec) > largest && !ec)
    throw InputError(Place{file}, fmt::format("the {} is larger than {} MiB", what, largest >> 20U));
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in || in.bad())
    throw core::Error(core::Failure::io, fmt::format("cannot read the {} \"{}\"", what, file));
  return text;
}

std::string extent_of(std::vector<double> const& times) {
  double least = HUGE_VAL, most = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    least = std::min(least, times[i] - times[i - 1]);
    most = std::max(most, times[i] - times[i - 1]);
  }
  auto const step = most - least <= same_step * most
                        ? fmt::format("a step of {:.6g} s", 0.5 * (least + most))
                        : fmt::format("steps of {:.6g} to {:.6g} s", least, most);
  return fmt::format("{} values at {}, {:.6g} s", times.size(), step, times.back() - times.front());
}

} // namespace fissura::model
