#pragma once
// What the standard output is: a terminal or a file, how wide, and whether colours are welcome.
namespace fissura::sim {

struct Terminal {
  bool is_terminal = false;
  bool colour = false; ///< a terminal, and neither NO_COLOR nor TERM=dumb says no (no-color.org)
  int width = 80;      ///< characters
};

Terminal standard_output();

} // namespace fissura::sim
