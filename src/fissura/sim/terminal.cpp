#include "fissura/sim/terminal.hpp"

#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace fissura::sim {

Terminal standard_output() {
  Terminal t;
  t.is_terminal = ::isatty(STDOUT_FILENO) != 0;
  char const *no_color = std::getenv("NO_COLOR"), *term = std::getenv("TERM");
  bool const refused = no_color != nullptr && *no_color != '\0';
  t.colour = t.is_terminal && !refused && !(term != nullptr && std::string_view(term) == "dumb");
  winsize size{};
  if (t.is_terminal && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    t.width = size.ws_col;
  return t;
}

} // namespace fissura::sim
