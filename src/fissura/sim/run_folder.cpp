#include "fissura/sim/run_folder.hpp"

#include <filesystem>
#include <fmt/core.h>
#include <set>

#include "fissura/core/error.hpp"

namespace fissura::sim {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(char const* doing, fs::path const& path, std::error_code ec) {
  throw core::Error(core::Failure::io, fmt::format("cannot {} '{}': {}", doing, path.string(), ec.message()));
}

void remove_file(fs::path const& path) {
  std::error_code ec;
  fs::remove(path, ec);
  if (ec) fail("remove", path, ec);
}

/// The paths are gathered first: a folder must not change while it is read.
std::vector<fs::path> files_in(fs::path const& folder) {
  std::vector<fs::path> files;
  std::error_code ec;
  for (auto const& entry : fs::directory_iterator(folder, ec)) files.push_back(entry.path());
  return files;
}

std::set<std::string> frame_names(std::size_t count) {
  std::set<std::string> names;
  for (std::string_view const collection : collections)
    for (std::size_t i = 0; i < count; ++i)
      names.insert(fs::path(frame_file(collection, i)).filename().string());
  return names;
}

/// Frames as the program names them, and what it left half written.
bool is_our_frame(fs::path const& file) {
  for (std::string_view const collection : collections)
    if (file.filename().string().starts_with(std::string(collection) + "_"))
      return file.extension() == ".vtu" || file.extension() == ".vtp" || file.extension() == ".part";
  return false;
}

void copy_over(fs::path const& from, fs::path const& to) {
  std::error_code ec;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, ec);
  if (ec) fail("copy", from, ec);
}

void shorten(fs::path const& file, std::uint64_t bytes) {
  if (size_of(file.string()) <= bytes) return;
  std::error_code ec;
  fs::resize_file(file, bytes, ec);
  if (ec) fail("cut back", file, ec);
}

} // namespace

std::uint64_t size_of(std::string const& path) {
  std::error_code ec;
  auto const size = fs::file_size(path, ec);
  return ec ? 0 : size;
}

void make_folder(std::string const& folder, bool force) {
  std::error_code ec;
  if (fs::exists(folder, ec) && !force)
    throw core::Error(core::Failure::io,
                      fmt::format("{} exists already; choose another --out or add --force", folder));
  if (force) {
    for (char const* old :
         {"run.json", "history.csv", "fields.pvd", "cracks.pvd", "bars.pvd", "surface.pvd", "rigid.pvd",
          "frames", "checkpoints", "log.txt", "case.toml", "report.html", "stop", "output_now"}) {
      fs::remove_all(fs::path(folder) / old, ec);
      if (ec) fail("remove", fs::path(folder) / old, ec);
    }
  }
  fs::create_directories(folder, ec);
  if (ec)
    throw core::Error(core::Failure::io,
                      fmt::format("{}: cannot create the run folder: {}", folder, ec.message()));
}

bool is_same_folder(std::string const& a, std::string const& b) {
  std::error_code ec;
  return fs::equivalent(a, b, ec) && !ec;
}

void cut_back(std::string const& folder, FileMarks const& marks) {
  fs::path const run(folder);
  for (char const* old : {"run.json", "stop", "output_now"}) remove_file(run / old);
  for (auto const& file : files_in(run))
    if (file.extension() == ".part") remove_file(file);
  auto const keep = frame_names(marks.frames.size());
  for (auto const& file : files_in(run / "frames"))
    if (is_our_frame(file) && !keep.contains(file.filename().string())) remove_file(file);
  shorten(run / "log.txt", marks.log);
}

void copy_start(std::string const& from, std::string const& to, FileMarks const& marks) {
  fs::path const source(from), target(to);
  std::error_code ec;
  fs::create_directories(target / "frames", ec);
  if (ec) fail("create the folder", target / "frames", ec);
  copy_over(source / "history.csv", target / "history.csv");
  if (fs::exists(source / "log.txt", ec)) {
    copy_over(source / "log.txt", target / "log.txt");
    shorten(target / "log.txt", marks.log);
  }
  for (auto const& name : frame_names(marks.frames.size()))
    if (fs::exists(source / "frames" / name, ec))
      copy_over(source / "frames" / name, target / "frames" / name);
}

} // namespace fissura::sim
