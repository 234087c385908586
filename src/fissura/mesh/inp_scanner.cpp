#include "fissura/mesh/inp_scanner.hpp"

#include <algorithm>

namespace fissura::mesh {

namespace {

/// Characters of a logical line after which it goes on no more: nobody writes longer ones.
constexpr std::size_t longest_line = 4096;

std::string_view trimmed(std::string_view s) {
  auto const first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquoted(std::string_view s) {
  return s.size() > 1 && s.front() == '"' && s.back() == '"' ? s.substr(1, s.size() - 2) : s;
}

std::vector<std::string> split(std::string_view s) {
  std::vector<std::string> fields;
  while (true) {
    auto const comma = s.find(',');
    fields.emplace_back(trimmed(s.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    s.remove_prefix(comma + 1);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back(); // a comma at the end
  return fields;
}

void read_keyword(InpLine& line, std::string_view text) {
  auto const fields = split(text.substr(1));
  line.name = fields.empty() ? "" : in_capitals(fields[0]);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    std::string_view const field = fields[i];
    auto const equals = field.find('=');
    auto const value = equals == std::string_view::npos ? std::string_view{} : field.substr(equals + 1);
    line.parameters.emplace_back(in_capitals(trimmed(field.substr(0, equals))), unquoted(trimmed(value)));
  }
}

} // namespace

std::string in_capitals(std::string_view text) {
  std::string s(text);
  std::transform(s.begin(), s.end(), s.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return s;
}

std::string const* InpLine::parameter(std::string_view wanted) const {
  for (auto const& [key, value] : parameters)
    if (key == wanted) return &value;
  return nullptr;
}

/// The next line that is neither empty nor a comment.
bool InpScanner::raw(std::string_view& line) {
  while (!rest.empty()) {
    auto const end = rest.find('\n');
    line = trimmed(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    ++count;
    if (!line.empty() && !line.starts_with("**")) return true;
  }
  return false;
}

bool InpScanner::next(InpLine& line, Data data) {
  std::string_view part;
  if (!raw(part)) return false;
  line = {};
  line.number = count;
  line.keyword = part.front() == '*';
  std::string text(part);
  bool const goes_on = line.keyword || data == Data::goes_on;
  while (goes_on && text.back() == ',' && text.size() < longest_line) {
    auto const here = *this;
    if (!raw(part)) break;
    if (part.front() == '*') { // the comma was the last one of a list
      *this = here;
      break;
    }
    text += part;
  }
  if (line.keyword)
    read_keyword(line, text);
  else
    line.fields = split(text);
  return true;
}

} // namespace fissura::mesh
