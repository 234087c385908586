// The command line: parse, call the library, print, choose the exit code. Exit codes: 0 complete or stopped
// as asked, 1 failed run, 2 bad input, 3 input/output failure.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "case_commands.hpp"
#include "fissura/core/error.hpp"
#include "fissura/core/printable.hpp"
#include "fissura/deck/nearest.hpp"
#include "look.hpp"

namespace {

namespace core = fissura::core;
using core::Error;

/// The names live as long as `app`.
std::vector<std::string_view> commands(CLI::App const& app) {
  std::vector<std::string_view> names;
  for (auto const* c : app.get_subcommands([](CLI::App const*) { return true; }))
    names.emplace_back(c->get_name());
  return names;
}

bool knows(CLI::App const& app, std::string_view word) {
  auto const names = commands(app);
  return std::find(names.begin(), names.end(), word) != names.end();
}

int unknown_command(CLI::App const& app, std::string_view word) {
  auto const names = commands(app);
  auto const hint = fissura::deck::did_you_mean(word, names);
  fmt::print(stderr, "fissura: there is no command `{}`{}\n", core::printable_line(word),
             hint.empty() ? "; there are " + fissura::deck::listed(names) : hint);
  return 2;
}

/// What `command` returns, or the code of its failure, which is told.
int code_of(std::function<int()> const& command) {
  try {
    return command();
  } catch (fissura::core::InputError const& e) {
    fmt::print(stderr, "{}\n", core::printable(e.what()));
    return 2;
  } catch (Error const& e) {
    fmt::print(stderr, "fissura: {}\n", core::printable(e.what()));
    return static_cast<int>(e.failure);
  } catch (std::bad_alloc const&) {
    fmt::print(stderr, "fissura: out of memory; `fissura check` tells what a case needs\n");
    return 1;
  } catch (std::system_error const& e) { // of the file system, or of a terminal that takes no more
    fmt::print(stderr, "fissura: {}\n", core::printable(e.what()));
    return 3;
  } catch (std::exception const& e) {
    fmt::print(stderr, "fissura: internal error: {}\n", core::printable(e.what()));
    return 1;
  }
}

int program(int argc, char** argv) {
  CLI::App app{"Fissura: how reinforced concrete cracks, slips, yields and falls apart (3-D finite-discrete "
               "elements)"};
  app.set_version_flag("--version", FISSURA_VERSION);
  app.require_subcommand(1);

  fissura::app::CaseCommands cases(app, FISSURA_VERSION);
  fissura::app::LookCommands look(app, FISSURA_VERSION);

  if (argc > 1 && argv[1][0] != '-' && !knows(app, argv[1])) return unknown_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& e) {
    return app.exit(e) == 0 ? 0 : 2; // --help and --version are no errors
  }
  return code_of([&] { return look.asked() ? look.run() : cases.run(); });
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file that grows beyond its limit is an error of its write, not the end
  int const code = program(argc, argv);
  if (std::fflush(stdout) == 0) return code;
  fmt::print(stderr, "fissura: cannot write to the standard output: {}\n", std::strerror(errno));
  return code == 0 ? 3 : code;
}
