#include "fissura/report/run_folder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <pugixml.hpp>

#include "fissura/core/error.hpp"

namespace fissura::report {

namespace fs = std::filesystem;

namespace {

std::string text_of(std::string const& path) {
  std::ifstream in(path, std::ios::binary);
  return in ? std::string{std::istreambuf_iterator<char>(in), {}} : std::string{};
}

[[noreturn]] void refuse(std::string const& path, std::string const& why) {
  throw core::Error(core::Failure::io, fmt::format("cannot read '{}': {}", path, why));
}

/// The fields of one CSV line (RFC 4180); quotes may hold commas and doubled quotes, but no line breaks.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    char const c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += c, ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

double number(std::string const& text) {
  double value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? value
                                                                  : std::numeric_limits<double>::quiet_NaN();
}

/// "load [N]" -> name and unit.
History::Column column_of(std::string const& title) {
  std::size_t const open = title.rfind(" [");
  if (open == std::string::npos || title.back() != ']') return {title, "-", {}};
  return {title.substr(0, open), title.substr(open + 2, title.size() - open - 3), {}};
}

output::Json read_json(std::string const& path) {
  std::string const text = text_of(path);
  if (text.empty()) return nullptr;
  auto value = output::Json::parse(text, nullptr, false);
  if (!value.is_object()) refuse(path, "no JSON object");
  return value;
}

} // namespace

History::Column const* History::find(std::string_view name) const {
  auto const found =
      std::find_if(columns.begin(), columns.end(), [&](auto const& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

History read_history(std::string const& path) {
  History h;
  std::string const text = text_of(path);
  std::size_t at = 0;
  while (true) {
    std::size_t const end = text.find('\n', at);
    if (end == std::string::npos) break; // a run that is still writing may leave a last line without its end
    auto const fields = fields_of(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (h.columns.empty()) {
      for (auto const& title : fields) h.columns.push_back(column_of(title));
      continue;
    }
    if (fields.size() != h.columns.size()) continue;
    for (std::size_t i = 0; i < fields.size(); ++i) h.columns[i].values.push_back(number(fields[i]));
  }
  if (!h.columns.empty() && h.columns.front().name != "time") refuse(path, "its first column is not `time`");
  return h;
}

std::vector<Frame> read_frames(std::string const& path) {
  if (!fs::exists(path)) return {};
  pugi::xml_document document;
  if (!document.load_file(path.c_str())) refuse(path, "no PVD list");
  std::vector<Frame> frames;
  for (pugi::xml_node const n : document.child("VTKFile").child("Collection").children("DataSet"))
    frames.push_back({n.attribute("timestep").as_double(),
                      (fs::path(path).parent_path() / n.attribute("file").value()).string()});
  std::stable_sort(frames.begin(), frames.end(),
                   [](auto const& a, auto const& b) { return a.time < b.time; });
  return frames;
}

std::vector<LogLine> read_log(std::string const& path) {
  std::vector<LogLine> lines;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    // "2026-01-31 12:00:00 warning: text"; what has no date goes on with the line before it.
    std::size_t const colon = line.find(": ", 20);
    bool const dated = line.size() > 20 && line[4] == '-' && line[10] == ' ' && line[19] == ' ';
    if (dated && colon != std::string::npos)
      lines.push_back({line.substr(20, colon - 20), line.substr(colon + 2)});
    else if (!lines.empty())
      lines.back().text += "\n" + line;
  }
  return lines;
}

std::string RunFolder::name() const {
  auto const absolute = fs::absolute(path_).lexically_normal();
  return absolute.has_filename() ? absolute.filename().string() : absolute.parent_path().filename().string();
}

RunFolder::RunFolder(std::string path) : path_(std::move(path)) {
  std::error_code ec;
  if (!fs::is_directory(path_, ec))
    throw core::Error(core::Failure::io, fmt::format("{}: no such run folder", path_));
  if (!fs::exists(path_ + "/history.csv", ec) && !fs::exists(path_ + "/run.json", ec))
    throw core::Error(core::Failure::io,
                      fmt::format("{}: no run folder (it holds neither history.csv nor run.json)", path_));
  summary = read_json(path_ + "/run.json");
  history = read_history(path_ + "/history.csv");
  for (char const* kind : {"fields", "cracks", "bars", "rigid"})
    frames[kind] = read_frames(fmt::format("{}/{}.pvd", path_, kind));
  log = read_log(path_ + "/log.txt");
  deck = text_of(path_ + "/case.toml");
}

} // namespace fissura::report
