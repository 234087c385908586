#pragma once
// The commands that look at run folders: report, picture, plot, compare, watch.
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fissura::app {

class LookCommands {
 public:
  /// Adds the commands to the command line.
  LookCommands(CLI::App& app, std::string version);
  /// Whether one of them was given.
  bool asked() const;
  /// Does it and returns the exit code.
  int run() const;

 private:
  int report() const;
  int picture() const;
  int plot() const;
  int compare() const;
  int watch() const;

  std::string version_;
  CLI::App *report_, *picture_, *plot_, *compare_, *watch_;
  std::string folder_, other_, out_, title_, field_ = "opening", time_ = "last", warp_ = "auto",
                                             least_ = "auto", up_ = "z", x_ = "time";
  std::vector<std::string> columns_;
  double tolerance_ = 0.02, every_ = 2, min_damage_ = 0.2;
  bool fragments_ = false, peak_ = false, once_ = false;
};

} // namespace fissura::app
