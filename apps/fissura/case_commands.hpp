#pragma once
// The commands that take a case or make one: run, check, new, bench.
#include <string>
#include <vector>

#include "fissura/sim/bench.hpp"
#include "fissura/sim/run.hpp"

namespace CLI {
class App;
}

namespace fissura::app {

class CaseCommands {
 public:
  /// Adds the commands to the command line.
  CaseCommands(CLI::App& app, std::string version);
  /// Does the one that was given and returns the exit code.
  int run();

 private:
  void add_run(CLI::App& app);
  void add_check(CLI::App& app);
  void add_new(CLI::App& app);
  void add_bench(CLI::App& app);

  int run_case();
  int check() const;
  int write_template() const;
  int bench() const;

  std::string version_;
  CLI::App *run_, *check_, *new_, *bench_;
  std::string deck_, until_, walltime_, picture_, template_, folder_;
  std::vector<std::string> set_;
  bool no_report_ = false;
  sim::RunOptions options_;
  sim::BenchOptions bench_options_;
};

} // namespace fissura::app
