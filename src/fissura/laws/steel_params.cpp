#include "fissura/laws/steel_params.hpp"

#include <string>

#include "fissura/core/error.hpp"

namespace fissura::laws {

void check_steel_params(SteelParams const& p) {
  auto require = [](bool ok, char const* what) {
    if (!ok) throw core::Error(core::Failure::input, std::string("steel: ") + what);
  };
  require(p.E_s > 0, "Young's modulus E_s must be positive");
  require(p.f_y > 0, "the yield stress f_y must be positive");
  require(p.f_u >= p.f_y, "the tensile strength f_u must not be less than f_y");
  require(p.eps_sh > p.eps_y(), "the onset of hardening eps_sh must exceed f_y/E_s");
  require(p.eps_u > p.eps_sh, "eps_u must exceed eps_sh");
  require(p.eps_br > p.eps_u, "the rupture strain eps_br must exceed eps_u");
}

} // namespace fissura::laws
