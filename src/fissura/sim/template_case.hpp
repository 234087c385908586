#pragma once
#include <span>
#include <string>

namespace fissura::sim {

struct Template {
  char const* name;
  char const* text; ///< case.toml
};
/// The files of sim/templates, in the order of their names; the build writes them into the program.
std::span<Template const> templates();

/// "beam, block, tie"
std::string template_names();
/// Creates the folder with a commented case.toml; returns what to do next. Throws core::Error for an unknown
/// name or an existing case.
std::string write_template(std::string const& name, std::string const& folder);

} // namespace fissura::sim
