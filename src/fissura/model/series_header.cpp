// What the header of a file of numbers says of its step, its count and its unit.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "fissura/core/number.hpp"
#include "fissura/model/series.hpp"

namespace fissura::model {
namespace {

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

bool is_of_a_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Where `word` stands alone in the line, from `from` on; npos if nowhere.
std::size_t find_word(std::string_view line, std::string_view word, std::size_t from = 0) {
  for (std::size_t at = line.find(word, from); at != std::string_view::npos; at = line.find(word, at + 1)) {
    bool const begins = at == 0 || !is_of_a_word(line[at - 1]) || !is_of_a_word(word.front());
    std::size_t const end = at + word.size();
    if (begins && (end >= line.size() || !is_of_a_word(line[end]) || !is_of_a_word(word.back()))) return at;
  }
  return std::string_view::npos;
}

/// The number that follows, behind blanks and one of = and :.
std::string_view number_after(std::string_view line, std::size_t at) {
  at = std::min(line.find_first_not_of(" \t=:", at), line.size());
  std::size_t const end = std::min(line.find_first_not_of("0123456789.+-eEdD", at), line.size());
  auto word = line.substr(at, end - at);
  // "0.01E" of "0.01EVERY", "401D": what is no number as a whole may still begin with one.
  while (!word.empty() && !core::read_decimal(word)) word.remove_suffix(1);
  return word;
}

/// The number that ends just before a place, behind blanks.
std::string_view number_before(std::string_view line, std::size_t at) {
  auto head = line.substr(0, at);
  auto const last = head.find_last_not_of(" \t");
  if (last == std::string_view::npos) return {};
  head = head.substr(0, last + 1);
  auto const blank = head.find_last_of(" \t,;=:(");
  auto const word = blank == std::string_view::npos ? head : head.substr(blank + 1);
  return core::read_decimal(word) ? word : std::string_view{};
}

void take_step(std::string_view written, double scale, SeriesHeader& header) {
  auto const value = core::read_decimal(written);
  if (header.step > 0 || !value || !(*value > 0)) return;
  header.step = *value * scale;
  header.step_written = written;
}

void take_count(std::string_view written, SeriesHeader& header) {
  auto const value = core::read_decimal(written);
  if (header.count > 0 || !value || *value < 2 || *value > 1e9 || *value != std::floor(*value)) return;
  header.count = static_cast<long>(*value);
}

/// Milliseconds, where the word behind the number says so.
double unit_of_time(std::string_view line, std::string_view number) {
  std::size_t const begin = static_cast<std::size_t>(number.data() - line.data()) + number.size();
  auto const at = line.find_first_not_of(" \t", begin);
  if (at == std::string_view::npos) return 1;
  auto const word = line.substr(at, 4);
  return word.starts_with("MS") || word.starts_with("MILL") ? 1e-3 : 1;
}

void look_for_step(std::string_view line, SeriesHeader& header) {
  for (std::string_view const key : {"DT", "DELT", "DELTA T", "TIME STEP", "TIMESTEP", "TIME INTERVAL",
                                     "SAMPLING INTERVAL", "SAMPLING PERIOD", "SAMPLE INTERVAL", "SAMPLED AT"})
    if (auto const at = find_word(line, key); at != std::string_view::npos) {
      auto const number = number_after(line, at + key.size());
      if (!number.empty()) take_step(number, unit_of_time(line, number), header);
    }
  if (auto const sec = find_word(line, "SEC"); sec != std::string_view::npos) {
    auto const number = number_before(line, sec); // "EQUALLY SPACED INTERVALS OF .010 SEC", "AT .010 SEC"
    auto const at = number.empty() ? 0 : static_cast<std::size_t>(number.data() - line.data());
    auto const before = line.substr(0, at);
    bool const spaced = find_word(before, "AT") != std::string_view::npos ||
                        before.find("INTERVAL") != std::string_view::npos;
    if (!number.empty() && spaced) take_step(number, 1, header);
  }
  for (std::string_view const key : {"SAMPLING FREQ(HZ)", "SAMPLING FREQUENCY (HZ)", "SAMPLING RATE (HZ)",
                                     "SAMPLING FREQUENCY", "SAMPLING RATE"})
    if (auto const at = line.find(key); at != std::string_view::npos && header.step == 0) {
      auto const number = number_after(line, at + key.size());
      auto const value = core::read_decimal(number);
      if (value && *value > 0) header.step = 1 / *value, header.step_written = std::string(number) + " Hz";
    }
}

void look_for_count(std::string_view line, SeriesHeader& header) {
  for (std::string_view const key : {"NPTS", "NPT", "NUMBER OF POINTS", "NO. OF POINTS", "NUMBER OF DATA"})
    if (auto const at = find_word(line, key); at != std::string_view::npos)
      take_count(number_after(line, at + key.size()), header);
  if (auto const at = find_word(line, "POINTS"); at != std::string_view::npos)
    take_count(number_before(line, at), header);
}

void look_for_unit(std::string_view line, SeriesHeader& header) {
  static constexpr std::array<std::pair<std::string_view, char const*>, 15> units{{{"MM/S/S", "mm/s2"},
                                                                                   {"MM/SEC/SEC", "mm/s2"},
                                                                                   {"MM/S2", "mm/s2"},
                                                                                   {"CM/S/S", "cm/s2"},
                                                                                   {"CM/SEC/SEC", "cm/s2"},
                                                                                   {"CM/SEC2", "cm/s2"},
                                                                                   {"CM/S2", "cm/s2"},
                                                                                   {"CM/SEC**2", "cm/s2"},
                                                                                   {"GAL", "cm/s2"},
                                                                                   {"M/S/S", "m/s2"},
                                                                                   {"M/SEC/SEC", "m/s2"},
                                                                                   {"M/S2", "m/s2"},
                                                                                   {"M/SEC2", "m/s2"},
                                                                                   {"UNITS OF G", "g"},
                                                                                   {"(G)", "g"}}};
  for (auto const& [written, unit] : units)
    if (header.unit.empty() && find_word(line, written) != std::string_view::npos) header.unit = unit;
}

} // namespace

void read_header_line(std::string_view text, SeriesHeader& header) {
  std::string const line = upper(text);
  look_for_step(line, header);
  look_for_count(line, header);
  look_for_unit(line, header);
}

} // namespace fissura::model
