#include "fissura/sim/template_case.hpp"

#include <array>
#include <filesystem>
#include <fmt/format.h>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"

namespace fissura::sim {

namespace {

struct Template {
  char const* name;
  char const* text;
};

constexpr char const* tie = R"(# A reinforced-concrete tie pulled to failure: one bar in a prism.
title = "tie"

[[mesh.box]]
name = "concrete"
from = ["0 m", "0 m", "0 m"]
to = ["600 mm", "150 mm", "150 mm"]
cells = [8, 2, 2]              # 6 tets per cell; keep h below 20 bar diameters

[[concrete]]
name = "C30"
E = "33 GPa"
nu = 0.2
f_t = "2.9 MPa"
f_c = "30 MPa"                 # gives G_f (fib MC2010) and the shear strength (Mohr-Coulomb)

[[steel]]
name = "B500"
E_s = "200 GPa"
f_y = "500 MPa"
f_u = "550 MPa"

[[bar]]
name = "bar"
steel = "B500"
diameter = "20 mm"
points = [["0 mm", "75 mm", "75 mm"], ["600 mm", "75 mm", "75 mm"]]

[[support]]
name = "left"
where = {plane = "x", at = "0 m"}
fix = ["x", "y", "z"]

[[motion]]
name = "pull"
where = {plane = "x", at = "600 mm"}
axis = "x"
velocity = {value = "0.1 m/s", over = "5 ms"}  # a smooth start: at least 10 wave transits

[run]
end_time = "40 ms"

[[gauge]]
name = "force"
kind = "reaction"
of = ["pull"]
axis = "x"

[[gauge]]
name = "elongation"
kind = "displacement"
where = {plane = "x", at = "600 mm"}
axis = "x"

[[stop]]
gauge = "force"
falls_to = 0.3
after = "100 kN"
)";

constexpr char const* block = R"(# A plain concrete prism pulled apart: the smallest case there is.
title = "block"

[[mesh.box]]
from = ["0 m", "0 m", "0 m"]
to = ["200 mm", "100 mm", "100 mm"]
cells = [4, 2, 2]

[[concrete]]
name = "C30"
E = "33 GPa"
f_t = "2.9 MPa"
f_c = "30 MPa"

[[support]]
name = "left"
where = {plane = "x", at = "0 m"}
fix = ["x", "y", "z"]

[[motion]]
name = "pull"
where = {plane = "x", at = "200 mm"}
axis = "x"
displacement = {value = "0.3 mm", over = "20 ms"}

[run]
end_time = "20 ms"

[[gauge]]
name = "force"
kind = "reaction"
of = ["pull"]
axis = "x"
)";

constexpr std::array<Template, 2> templates{{{"tie", tie}, {"block", block}}};

} // namespace

std::string template_names() {
  std::string names;
  for (auto const& t : templates) names += fmt::format("{}{}", names.empty() ? "" : ", ", t.name);
  return names;
}

std::string write_template(std::string const& name, std::string const& folder) {
  for (auto const& t : templates) {
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
