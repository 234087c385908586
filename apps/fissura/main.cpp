// The command line: parse, call the library, print, choose the exit code. Exit codes: 0 complete or stopped
// as asked, 1 failed run, 2 bad input, 3 input/output failure.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/deck/nearest.hpp"
#include "fissura/sim/bench.hpp"
#include "fissura/sim/bench_scenes.hpp"
#include "fissura/sim/check.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/template_case.hpp"
#include "look.hpp"
#include "python_tool.hpp"
#include "seconds.hpp"
#include "signals.hpp"

namespace {

using fissura::core::Error;

struct RunArguments {
  std::string deck;
  std::vector<std::string> set;
  std::string until;
  fissura::sim::RunOptions options;
};

int run(RunArguments const& a) {
  auto const c = fissura::deck::read_case(a.deck, a.set);
  auto options = a.options;
  if (!a.until.empty()) options.until = fissura::app::seconds("--until", a.until);
  options.version = FISSURA_VERSION;
  options.deck_echo = fissura::deck::echo(c);
  options.signal = caught_signal;
  catch_signals();
  auto const result = fissura::sim::run_case(c, options);
  if (result.status == "failed") {
    fmt::print(stderr, "fissura: the run failed: {}\n", result.reason);
    return 1;
  }
  if (!options.quiet) fmt::print("results in {}\n", result.folder);
  return 0;
}

/// Frames for one picture; gone afterwards.
class FramesFolder {
 public:
  FramesFolder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("fissura_check_{}", ::getpid())) {}
  ~FramesFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FramesFolder(FramesFolder const&) = delete;
  FramesFolder& operator=(FramesFolder const&) = delete;
  std::string name() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

int check(std::string const& deck, std::vector<std::string> const& set, std::string const& picture) {
  auto const c = fissura::deck::read_case(deck, set);
  if (picture.empty()) {
    fmt::print("{}", fissura::sim::check_case(c));
    return 0;
  }
  FramesFolder const frames;
  fmt::print("{}", fissura::sim::check_case(c, frames.name()));
  std::fflush(stdout);
  return fissura::app::run_python_tool(
      "picture.py", {frames.name(), "--out", picture, "--title", c.title.empty() ? deck : c.title});
}

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
  fmt::print(stderr, "fissura: there is no command `{}`{}\n", word,
             hint.empty() ? "; there are " + fissura::deck::listed(names) : hint);
  return 2;
}

int program(int argc, char** argv) {
  CLI::App app{"Fissura: how reinforced concrete cracks, slips, yields and falls apart (3-D finite-discrete "
               "elements)"};
  app.set_version_flag("--version", FISSURA_VERSION);
  app.require_subcommand(1);

  RunArguments run_arguments;
  auto* run_command = app.add_subcommand("run", "Run a case file and leave a run folder");
  run_command->add_option("case", run_arguments.deck, "Case file (TOML)")->required();
  run_command->add_option("--out", run_arguments.options.out, "Run folder (default: <case>.run)");
  run_command->add_option("--threads", run_arguments.options.threads,
                          "Threads (default: all, or as the deck says)");
  run_command->add_option("--until", run_arguments.until,
                          "Stop at this time: seconds, or with a unit, \"3 ms\"");
  run_command->add_option("--walltime", run_arguments.options.walltime,
                          "Stop after so many seconds of wall time");
  run_command->add_option("--restart", run_arguments.options.restart,
                          "Go on from a checkpoint, or from the newest one of a run folder");
  run_command->add_option("--set", run_arguments.set, "Change the deck: key=value, repeatable")
      ->allow_extra_args(false);
  run_command->add_flag("--quiet", run_arguments.options.quiet, "Nothing on the terminal but errors");
  bool no_report = false;
  run_command->add_flag("--no-report", no_report, "Write no report page");
  run_command->add_flag("--force", run_arguments.options.force, "Overwrite an existing run folder");

  std::string deck;
  std::vector<std::string> set;
  auto* check_command =
      app.add_subcommand("check", "Report every error of a case file, or forecast its cost");
  check_command->add_option("case", deck, "Case file (TOML)")->required();
  check_command->add_option("--set", set, "Change the deck: key=value, repeatable")->allow_extra_args(false);
  std::string check_picture;
  check_command->add_option("--picture", check_picture, "Also draw the body and its bars as a PNG");

  std::string template_name, template_folder;
  auto* new_command = app.add_subcommand("new", "Write a commented starting case");
  new_command->add_option("template", template_name, "One of: " + fissura::sim::template_names())->required();
  new_command->add_option("folder", template_folder, "Folder to create")->required();

  fissura::sim::BenchOptions bench;
  auto* bench_command = app.add_subcommand("bench", "Time the step: ns per tet-step");
  bench_command->add_option("--scene", bench.scene, "One of: " + fissura::sim::bench_scene_names());
  bench_command->add_option("--tets", bench.tets, "Tets, about (default 6000)");
  bench_command->add_option("--threads", bench.threads, "Threads (default 1)");
  bench_command->add_option("--steps", bench.steps, "Steps (default: about two seconds)");

  fissura::app::LookCommands look(app, FISSURA_VERSION);

  if (argc > 1 && argv[1][0] != '-' && !knows(app, argv[1])) return unknown_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& e) {
    return app.exit(e) == 0 ? 0 : 2; // --help and --version are no errors
  }
  try {
    run_arguments.options.report = !no_report;
    if (*run_command) return run(run_arguments);
    if (look.asked()) return look.run();
    if (*check_command) return check(deck, set, check_picture);
    if (*new_command) {
      fmt::print("{}\n", fissura::sim::write_template(template_name, template_folder));
      return 0;
    }
    fmt::print("{}", fissura::sim::bench(bench));
    return 0;
  } catch (fissura::core::InputError const& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (Error const& e) {
    fmt::print(stderr, "fissura: {}\n", e.what());
    return static_cast<int>(e.failure);
  } catch (std::bad_alloc const&) {
    fmt::print(stderr, "fissura: out of memory; `fissura check` tells what a case needs\n");
    return 1;
  } catch (std::system_error const& e) { // of the file system, or of a terminal that takes no more
    fmt::print(stderr, "fissura: {}\n", e.what());
    return 3;
  } catch (std::exception const& e) {
    fmt::print(stderr, "fissura: internal error: {}\n", e.what());
    return 1;
  }
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file that grows beyond its limit is an error of its write, not the end
  int const code = program(argc, argv);
  if (std::fflush(stdout) == 0) return code;
  fmt::print(stderr, "fissura: cannot write to the standard output: {}\n", std::strerror(errno));
  return code == 0 ? 3 : code;
}
