#include "case_commands.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "fissura/core/printable.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/sim/bench_scenes.hpp"
#include "fissura/sim/check.hpp"
#include "fissura/sim/template_case.hpp"
#include "python_tool.hpp"
#include "seconds.hpp"
#include "signals.hpp"

namespace fissura::app {

namespace {

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

void add_deck(CLI::App* command, std::string& deck, std::vector<std::string>& set) {
  command->add_option("case", deck, "Case file (TOML)")->required();
  command->add_option("--set", set, "Change the deck: key=value, repeatable")->allow_extra_args(false);
}

} // namespace

CaseCommands::CaseCommands(CLI::App& app, std::string version) : version_(std::move(version)) {
  add_run(app);
  add_check(app);
  add_new(app);
  add_bench(app);
}

void CaseCommands::add_run(CLI::App& app) {
  run_ = app.add_subcommand("run", "Run a case file and leave a run folder");
  add_deck(run_, deck_, set_);
  run_->add_option("--out", options_.out, "Run folder (default: <case>.run)");
  run_->add_option("--threads", options_.threads, "Threads, 0 for all (default: all, or as the deck says)")
      ->check(CLI::Range(0, sim::most_threads));
  run_->add_option("--until", until_, "Stop at this time: seconds, or with a unit, \"3 ms\"");
  run_->add_option("--walltime", walltime_, "Stop after so much wall time: seconds, or with a unit, \"2 h\"");
  run_->add_option("--restart", options_.restart,
                   "Go on from a checkpoint, or from the newest one of a run folder");
  run_->add_flag("--quiet", options_.quiet, "Nothing on the terminal but errors");
  run_->add_flag("--no-report", no_report_, "Write no report page");
  run_->add_flag("--force", options_.force, "Overwrite an existing run folder");
}

void CaseCommands::add_check(CLI::App& app) {
  check_ = app.add_subcommand("check", "Report every error of a case file, or forecast its cost");
  add_deck(check_, deck_, set_);
  check_->add_option("--picture", picture_, "Also draw the body and its bars as a PNG");
}

void CaseCommands::add_new(CLI::App& app) {
  new_ = app.add_subcommand("new", "Write a commented starting case");
  new_->add_option("template", template_, "One of: " + sim::template_names())->required();
  new_->add_option("folder", folder_, "Folder to create")->required();
}

void CaseCommands::add_bench(CLI::App& app) {
  bench_ = app.add_subcommand("bench", "Time the step: ns per tet-step");
  bench_->add_option("--scene", bench_options_.scene, "One of: " + sim::bench_scene_names());
  bench_->add_option("--tets", bench_options_.tets, "Tets, about (default 6000)")
      ->check(CLI::Range(1L, 100'000'000L));
  bench_->add_option("--threads", bench_options_.threads, "Threads, 0 for all (default 1)")
      ->check(CLI::Range(0, sim::most_threads));
  bench_->add_option("--steps", bench_options_.steps, "Steps (default, or 0: about two seconds)")
      ->check(CLI::Range(0L, 1'000'000'000L));
}

int CaseCommands::run() {
  if (*run_) return run_case();
  if (*check_) return check();
  return *new_ ? write_template() : bench();
}

int CaseCommands::run_case() {
  catch_signals();
  if (run_->count("--until") > 0) options_.until = seconds("--until", until_);
  if (run_->count("--walltime") > 0) options_.walltime = seconds("--walltime", walltime_);
  auto const c = deck::read_case(deck_, set_);
  options_.report = !no_report_;
  options_.version = version_;
  options_.deck_echo = deck::echo(c);
  options_.signal = caught_signal;
  auto const result = sim::run_case(c, options_);
  if (result.status == "failed") {
    fmt::print(stderr, "fissura: the run failed: {}\n", core::printable(result.reason));
    return 1;
  }
  if (result.folder.empty())
    fmt::print("{}; nothing has been written\n", core::printable(result.reason));
  else if (!options_.quiet)
    fmt::print("results in {}\n", core::printable_line(result.folder));
  return 0;
}

int CaseCommands::check() const {
  auto const c = deck::read_case(deck_, set_);
  if (picture_.empty()) {
    fmt::print("{}", core::printable(sim::check_case(c)));
    return 0;
  }
  FramesFolder const frames;
  fmt::print("{}", core::printable(sim::check_case(c, frames.name())));
  std::fflush(stdout);
  return run_python_tool("picture.py",
                         {frames.name(), "--out", picture_, "--title", c.title.empty() ? deck_ : c.title});
}

int CaseCommands::write_template() const {
  fmt::print("{}\n", core::printable(sim::write_template(template_, folder_)));
  return 0;
}

int CaseCommands::bench() const {
  fmt::print("{}", sim::bench(bench_options_));
  return 0;
}

} // namespace fissura::app
