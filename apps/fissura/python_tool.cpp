#include "python_tool.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fissura/core/error.hpp"

namespace fissura::app {

namespace fs = std::filesystem;

namespace {

/// Debian's, unless FISSURA_PYTHON names another one.
std::string python() {
  char const* const given = std::getenv("FISSURA_PYTHON");
  return given && *given ? given : "/usr/bin/python3";
}

/// Where the tools may lie: only where FISSURA_TOOLS says, if it is set.
std::vector<fs::path> tool_folders() {
  if (char const* given = std::getenv("FISSURA_TOOLS"); given && *given) return {given};
  std::error_code ec;
  fs::path const program = fs::read_symlink("/proc/self/exe", ec);
  return {program.parent_path().parent_path() / "share/fissura/tools", FISSURA_SOURCE_TOOLS};
}

std::string find_tool(std::string const& name) {
  std::error_code ec;
  for (auto const& place : tool_folders())
    if (fs::exists(place / name, ec)) return (place / name).string();
  throw core::Error(
      core::Failure::io,
      fmt::format("the drawing tool {} is not beside this program; install it with `make install`, or name "
                  "its folder in FISSURA_TOOLS",
                  name));
}

/// Exit code of a program; 127 if it cannot be started.
int run_program(std::vector<std::string> const& words) {
  std::vector<char*> argv;
  for (auto const& w : words) argv.push_back(const_cast<char*>(w.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  if (::posix_spawn(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) return 127;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 127;
}

/// Says what is missing before a traceback does.
void check_python(std::string const& python) {
  std::error_code ec;
  if (!fs::exists(python, ec))
    throw core::Error(core::Failure::io,
                      fmt::format("{} is missing: apt install python3-numpy python3-matplotlib", python));
  for (char const* module : {"numpy", "matplotlib"})
    if (run_program(
            {python, "-c",
             fmt::format("import importlib.util, sys; sys.exit(importlib.util.find_spec('{}') is None)",
                         module)}) != 0)
      throw core::Error(core::Failure::io,
                        fmt::format("pictures are drawn with Python's {0}, which is missing: apt install "
                                    "python3-{0}",
                                    module));
}

} // namespace

int run_python_tool(std::string const& name, std::vector<std::string> const& arguments) {
  std::string const tool = find_tool(name);
  std::string const interpreter = python();
  check_python(interpreter);
  std::vector<std::string> words{interpreter, tool};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::fflush(stdout);
  int const code = run_program(words);
  bool const is_known = code == 0 || code == static_cast<int>(core::Failure::input);
  return is_known ? code : static_cast<int>(core::Failure::io);
}

} // namespace fissura::app
