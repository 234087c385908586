#pragma once
#include <string>
#include <vector>

namespace fissura::app {

/// Runs a drawing tool (picture.py, plot_history.py) with Debian's Python, or with that which FISSURA_PYTHON
/// names, and returns its exit code: 0, 2 for bad input (a column that is not there), 3 for what cannot be
/// read or written. The tools lie in ../share/fissura/tools beside an installed program, in the source folder
/// beside one that was built there, or only where FISSURA_TOOLS says, if it is set. Throws
/// core::Error(Failure::io) where the tool, Python, numpy or matplotlib is missing, with the package to
/// install.
int run_python_tool(std::string const& name, std::vector<std::string> const& arguments);

} // namespace fissura::app
