#pragma once
#include <string>

namespace fissura::sim {

/// "beam, tie, block"
std::string template_names();
/// Creates the folder with a commented case.toml; returns what to do next. Throws core::Error for an unknown
/// name or an existing case.
std::string write_template(std::string const& name, std::string const& folder);

} // namespace fissura::sim
