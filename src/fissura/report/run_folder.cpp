#include "fissura/report/run_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/report/run_json.hpp"

namespace fissura::report {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(std::string const& path, std::string const& why) {
  throw core::Error(core::Failure::io, fmt::format("cannot read '{}': {}", path, why));
}

/// The whole file; nothing where there is none. A pipe or a device would never end.
std::optional<std::string> text_of(std::string const& path) {
  std::error_code ec;
  auto const status = fs::status(path, ec);
  if (status.type() == fs::file_type::not_found) return std::nullopt;
  if (ec) refuse(path, ec.message());
  if (!fs::is_regular_file(status)) refuse(path, "it is no file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) output::throw_io_error("open", path, errno);
  return std::string{std::istreambuf_iterator<char>(in), {}};
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

std::optional<double> number(std::string const& text) {
  double value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "load [N]" -> name and unit.
History::Column column_of(std::string const& title) {
  std::size_t const open = title.rfind(" [");
  if (open == std::string::npos || title.back() != ']') return {title, "-", {}};
  return {title.substr(0, open), title.substr(open + 2, title.size() - open - 3), {}};
}

output::Json read_json(std::string const& path) {
  auto const text = text_of(path);
  if (!text) return nullptr;
  try {
    return parse_run_json(*text);
  } catch (std::runtime_error const& error) {
    refuse(path, error.what());
  }
}

/// A frame lies in the run folder: what a list names elsewhere is not this run's.
bool is_inside(fs::path const& file) {
  if (file.empty() || file.is_absolute()) return false;
  return std::none_of(file.begin(), file.end(), [](fs::path const& part) { return part == ".."; });
}

} // namespace

History::Column const* History::find(std::string_view name) const {
  auto const found =
      std::find_if(columns.begin(), columns.end(), [&](auto const& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

History read_history(std::string const& path) {
  History h;
  std::string const text = text_of(path).value_or("");
  std::size_t at = 0;
  for (std::size_t line = 1;; ++line) {
    std::size_t const end = text.find('\n', at);
    if (end == std::string::npos) break; // a run that is still writing may leave a last line without its end
    auto const fields = fields_of(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (h.columns.empty()) {
      for (auto const& title : fields) h.columns.push_back(column_of(title));
      if (h.columns.front().name != "time") refuse(path, "its first column is not `time`");
      continue;
    }
    if (fields.size() != h.columns.size())
      refuse(path,
             fmt::format("line {} has {} values for {} columns", line, fields.size(), h.columns.size()));
    for (std::size_t i = 0; i < fields.size(); ++i) {
      auto const value = number(fields[i]);
      if (!value) refuse(path, fmt::format("line {}: '{}' is no number", line, fields[i].substr(0, 40)));
      h.columns[i].values.push_back(*value);
    }
  }
  return h;
}

std::vector<Frame> read_frames(std::string const& path) {
  auto const text = text_of(path);
  if (!text) return {};
  pugi::xml_document document;
  if (!document.load_buffer(text->data(), text->size())) refuse(path, "no PVD list");
  std::vector<Frame> frames;
  for (pugi::xml_node const n : document.child("VTKFile").child("Collection").children("DataSet")) {
    auto const time = number(n.attribute("timestep").value());
    std::string const file = n.attribute("file").value();
    if (!time || !std::isfinite(*time)) refuse(path, fmt::format("frame {} has no time", frames.size() + 1));
    if (!is_inside(file))
      refuse(path, fmt::format("it names '{}', which does not lie in the run folder", file));
    frames.push_back({*time, (fs::path(path).parent_path() / file).string()});
  }
  std::stable_sort(frames.begin(), frames.end(),
                   [](auto const& a, auto const& b) { return a.time < b.time; });
  return frames;
}

std::vector<LogLine> read_log(std::string const& path) {
  std::vector<LogLine> lines;
  std::istringstream in(text_of(path).value_or(""));
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
  if (fs::exists(path_, ec) && !fs::is_directory(path_, ec))
    throw core::Error(core::Failure::io, fmt::format("{}: it is a file, no run folder", path_));
  if (!fs::is_directory(path_, ec))
    throw core::Error(core::Failure::io, fmt::format("{}: no such run folder", path_));
  if (!fs::exists(fs::symlink_status(path_ + "/history.csv", ec)) &&
      !fs::exists(fs::symlink_status(path_ + "/run.json", ec)))
    throw core::Error(core::Failure::io,
                      fmt::format("{}: no run folder (it holds neither history.csv nor run.json)", path_));
  summary = read_json(path_ + "/run.json");
  history = read_history(path_ + "/history.csv");
  for (char const* kind : {"fields", "cracks", "bars", "rigid"})
    frames[kind] = read_frames(fmt::format("{}/{}.pvd", path_, kind));
  log = read_log(path_ + "/log.txt");
  deck = text_of(path_ + "/case.toml").value_or("");
}

} // namespace fissura::report
