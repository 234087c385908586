#include "fissura/sim/template_case.hpp"

#include <filesystem>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::sim {

std::string template_names() {
  std::string names;
  for (auto const& t : templates()) names += fmt::format("{}{}", names.empty() ? "" : ", ", t.name);
  return names;
}

std::string write_template(std::string const& name, std::string const& folder) {
  for (auto const& t : templates()) {
    if (name != t.name) continue;
    std::string const file = folder + "/case.toml";
    std::error_code ec;
    if (std::filesystem::exists(file, ec))
      throw core::Error(core::Failure::input, file + " exists already; choose another folder");
    std::filesystem::create_directories(folder, ec);
    if (ec)
      throw core::Error(core::Failure::io,
                        fmt::format("{}: cannot create the folder: {}", folder, ec.message()));
    output::replace_file(file, t.text);
    return fmt::format("wrote {0}; next: fissura check {0}, then fissura run {0}", file);
  }
  throw core::Error(core::Failure::input,
                    fmt::format("there is no template `{}`; there are: {}", name, template_names()));
}

} // namespace fissura::sim
