#include "fissura/sim/material_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "fissura/model/defaults.hpp"
#include "fissura/model/make_blocks.hpp"
#include "fissura/units/units.hpp"

namespace fissura::sim {

using model::ConcreteSpec;
using model::Model;
using model::SteelSpec;
using units::Dimension;

namespace {

/// What is usual of a quantity [SI]; outside of it a unit is likely wrong.
struct Usual {
  double least, most;
  Dimension dimension;
};
constexpr Usual concrete_E{5e9, 80e9, Dimension::pressure}, concrete_f_t{0.3e6, 15e6, Dimension::pressure},
    concrete_f_c{5e6, 250e6, Dimension::pressure}, concrete_G_f{5, 1000, Dimension::energy_per_area},
    density{300, 12000, Dimension::density}, steel_E{50e9, 250e9, Dimension::pressure},
    steel_f_y{100e6, 2500e6, Dimension::pressure}, diameter{1e-3, 0.06, Dimension::length};

/// The joints' compliance: the sound body has E/(1 + softening E/p); measured, see docs/theory/limits.md.
constexpr double softening = 2.5;

std::string pressure(double value) {
  return units::from_si(std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr), Dimension::pressure);
}

class MaterialDoubts {
 public:
  MaterialDoubts(Model const& model, mesh::Quality const& quality) : m(model), q(quality) {}

  std::vector<std::string> all() {
    for (auto const& c : m.source.concretes) {
      elasticity(c);
      if (!c.joints || !c.crackable) continue; // plates of steel, lumped masses
      usual_concrete(c);
      shear(c);
      tension(c);
    }
    for (auto const& s : m.source.steels) steel(s);
    for (auto const& b : m.source.bars)
      if (b.area == 0) check(b.name, "diameter", b.diameter, diameter); // a lumped bar gives its area
    regions();
    return std::move(found);
  }

 private:
  void doubt(std::string text) { found.push_back(std::move(text)); }

  void check(std::string const& of, char const* key, double value, Usual const& usual) {
    if (value <= 0 || (value >= usual.least && value <= usual.most)) return;
    doubt(fmt::format("{}: `{}` = {} lies outside the usual {} to {}: is the unit right?", of, key,
                      units::from_si(value, usual.dimension), units::from_si(usual.least, usual.dimension),
                      units::from_si(usual.most, usual.dimension)));
  }

  void usual_concrete(ConcreteSpec const& c) {
    check(c.name, "density", c.density, density);
    check(c.name, "E", c.E, concrete_E);
    check(c.name, "f_t", c.f_t, concrete_f_t);
    check(c.name, "f_c", c.f_c, concrete_f_c);
    check(c.name, "G_f", c.G_f, concrete_G_f);
  }

  void elasticity(ConcreteSpec const& c) {
    if (c.nu < 0 || c.nu > 0.45)
      doubt(fmt::format("{}: `nu` = {:.4g} lies outside the usual 0 to 0.45{}", c.name, c.nu,
                        c.nu > 0 ? ": tets of a material that hardly changes its volume are far too stiff"
                                 : ""));
    if (c.density_factor < 1 || c.density_factor > 1000)
      doubt(
          fmt::format("{}: `density_factor` = {:.4g} makes the body {} times as inert as it is: mass scaling "
                      "is 1 to 1000",
                      c.name, c.density_factor, c.density_factor));
    if (!c.joints) return;
    double const ratio = model::joint_penalty(c) / c.E;
    if (ratio < 5)
      doubt(
          fmt::format("{}: `penalty` = {:.3g} E: the joints are so soft that the sound body has {:.2g} % of "
                      "its `E`; 20 E and more are usual",
                      c.name, ratio, 100 / (1 + softening / ratio)));
    if (ratio > 1000)
      doubt(
          fmt::format("{}: `penalty` = {:.3g} E makes the time step {:.2g} times shorter than 20 E does, for "
                      "a body that is hardly stiffer",
                      c.name, ratio, std::sqrt(ratio / 20)));
  }

  /// The stress of uniaxial compression at which a joint on the worst plane slides.
  static double slides_at(ConcreteSpec const& c) {
    if (c.shear == model::ShearStrength::constant) return 2 * c.f_s;
    return 2 * c.cohesion * std::cos(c.friction_angle) / (1 - std::sin(c.friction_angle));
  }

  void shear(ConcreteSpec const& c) {
    bool const coulomb = c.shear == model::ShearStrength::mohr_coulomb;
    double const degrees = c.friction_angle * 180 / std::numbers::pi;
    if (coulomb && (degrees < 10 || degrees > 60))
      doubt(fmt::format("{}: `friction_angle` = {:.3g} degrees lies outside the usual 10 to 60 degrees",
                        c.name, degrees));
    if (c.friction > 2)
      doubt(
          fmt::format("{}: `friction` = {:.3g}: crack faces that slide so hard hold like sound concrete; 0.4 "
                      "to 1 are usual",
                      c.name, c.friction));
    if (coulomb && c.cohesion <= 0) return; // follows from f_c
    double const strength = slides_at(c), f_c = c.f_c > 0 ? c.f_c : concrete_f_c.most;
    std::string const key = coulomb ? fmt::format("`cohesion` = {}", pressure(c.cohesion))
                                    : fmt::format("`f_s` = {}", pressure(c.f_s));
    if (strength > 3 * f_c)
      doubt(fmt::format(
          "{}: {}: joints slide at a compression of {} only, {:.3g} times `f_c`: nothing can crush, "
          "or crack by shear",
          c.name, key, pressure(strength), strength / f_c));
    if (c.f_c > 0 && strength < c.f_c / 3)
      doubt(fmt::format(
          "{}: {}: joints slide at a compression of {} already, {:.3g} of `f_c`: the body crushes "
          "long before",
          c.name, key, pressure(strength), strength / f_c));
  }

  void tension(ConcreteSpec const& c) {
    double const strain = c.f_t / c.E;
    if (strain > 2e-3)
      doubt(fmt::format(
          "{}: it cracks at a strain of {:.2g} (f_t/E), concrete at some 1e-4: as good as nothing "
          "can crack",
          c.name, strain));
    if (c.f_c > 0 && c.f_t < 0.01 * c.f_c)
      doubt(fmt::format("{}: `f_t` = {} is {:.2g} % of `f_c`: it cracks under next to nothing", c.name,
                        pressure(c.f_t), 100 * c.f_t / c.f_c));
    double const G_f = c.G_f > 0 ? c.G_f : model::default_fracture_energy(c.f_c);
    double const length = c.E * G_f / (c.f_t * c.f_t);
    if (q.mean_h > length)
      doubt(fmt::format(
          "{}: its elements ({:.3g} mm) are larger than E G_f/f_t^2 = {:.3g} mm: a crack releases "
          "more energy than it takes and runs through at once; is `G_f` right, or use a finer mesh",
          c.name, 1e3 * q.mean_h, 1e3 * length));
    double const relaxation = c.mu_bar / c.E;
    if (relaxation > 1e-2)
      doubt(fmt::format("{}: `mu_bar`/E = {:.3g} s: the load is carried by viscosity, not by stiffness",
                        c.name, relaxation));
  }

  void steel(SteelSpec const& s) {
    check(s.name, "E_s", s.E_s, steel_E);
    check(s.name, "f_y", s.f_y, steel_f_y);
    check(s.name, "density", s.density, density);
    if (s.f_u > 2.5 * s.f_y)
      doubt(fmt::format("{}: `f_u` = {} is {:.3g} times `f_y`; 1.05 to 1.5 are usual", s.name,
                        pressure(s.f_u), s.f_u / s.f_y));
    if (s.eps_br < 0.01)
      doubt(
          fmt::format("{}: `eps_br` = {:.3g}: bars break at {:.3g} %, soon after they yield; is it a strain, "
                      "not per cent?",
                      s.name, s.eps_br, 100 * s.eps_br));
  }

  void regions() {
    for (auto const& r : m.source.joint_regions)
      if (r.crackable && r.strength_factor > 100) // a small one is a notch
        doubt(fmt::format(
            "{}: `strength_factor` = {:.3g}: these joints cannot crack; crackable = false says so",
            core::to_string(r.place), r.strength_factor));
  }

  Model const& m;
  mesh::Quality const& q;
  std::vector<std::string> found;
};

} // namespace

std::vector<std::string> material_doubts(Model const& m, mesh::Quality const& quality) {
  return MaterialDoubts(m, quality).all();
}

} // namespace fissura::sim
