#include "fissura/sim/run_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <pwd.h>
#include <set>
#include <unistd.h>

#include "fissura/core/error.hpp"
#include "fissura/sim/run_lock.hpp"

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

std::string home() {
  if (char const* named = std::getenv("HOME"); named && *named) return named;
  auto const* user = ::getpwuid(::geteuid());
  return user && user->pw_dir ? user->pw_dir : "/";
}

bool begins_with(fs::path const& file, std::string_view words) {
  std::ifstream in(file, std::ios::binary);
  std::string start(words.size(), '\0');
  return in.read(start.data(), static_cast<std::streamsize>(start.size())) && start == words;
}

bool has_checkpoint(fs::path const& folder) {
  for (auto const& file : files_in(folder / "checkpoints"))
    if (file.extension() == ".bin" && file.filename().string().starts_with("checkpoint_")) return true;
  return false;
}

/// By what only a run leaves behind; a case.toml may be somebody's deck.
bool holds_a_run(fs::path const& folder) {
  if (begins_with(folder / "history.csv", "time [s]") || has_checkpoint(folder)) return true;
  if (RunLock::was_left_in(folder.string())) return true; // killed before it had written anything
  std::ifstream in(folder / "run.json");
  std::string const summary{std::istreambuf_iterator<char>(in), {}};
  return summary.find("\"state_hash\"") != std::string::npos;
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

void check_may_force(std::string const& folder, std::string const& deck_file) {
  std::error_code ec;
  if (!fs::exists(folder, ec)) return;
  auto const refuse = [&](std::string const& why) {
    throw core::Error(core::Failure::io,
                      fmt::format("--force does not clear {}: {}; choose another --out", folder, why));
  };
  if (!fs::is_directory(folder, ec)) refuse("it is no folder");
  if (is_same_folder(folder, "/")) refuse("it is the root of all files");
  if (is_same_folder(folder, home())) refuse("it is your home");
  if (!deck_file.empty() && is_same_folder(folder, fs::absolute(deck_file).parent_path().string()))
    refuse("the deck itself lies in it");
  if (files_in(folder).empty() || holds_a_run(folder)) return;
  refuse("it is no run folder (it holds files, but neither history.csv, run.json nor checkpoints of a run)");
}

void check_can_go_on_in(std::string const& folder) {
  std::error_code ec;
  for (char const* name : {"", "/checkpoints", "/frames", "/history.csv", "/log.txt"}) {
    std::string const path = folder + name;
    if (!fs::exists(path, ec)) continue;
    if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0)
      throw core::Error(core::Failure::io, fmt::format("cannot write '{}': {}; nothing has been changed",
                                                       path, std::strerror(errno)));
  }
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
