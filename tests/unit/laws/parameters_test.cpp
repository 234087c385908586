// Parameters outside their range are refused by name: a caller that is no deck has no other check.
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/laws/bond_slip.hpp"
#include "fissura/laws/cohesive.hpp"
#include "fissura/laws/dowel.hpp"
#include "support/refusal.hpp"

namespace fissura::laws {
namespace {

std::string refusal(auto const& action) {
  return support::refusal(core::Failure::input, action);
}

/// A parameter that is not what it should be, and what is said about it.
template <class Input> struct Fault {
  double Input::*member;
  double value;
  char const* said;
};
template <class Input, class Make>
void expect_refusals(Input const& sound, std::initializer_list<Fault<Input>> faults, Make const& make) {
  EXPECT_EQ(refusal([&] { make(sound); }), "accepted");
  for (auto const& fault : faults) {
    Input faulty = sound;
    faulty.*fault.member = fault.value;
    EXPECT_EQ(refusal([&] { make(faulty); }), fault.said);
  }
}

SteelParams steel() {
  SteelParams s;
  s.f_y = 500e6, s.f_u = 600e6;
  return s;
}

// Requirement: a joint's law names the parameter that cannot be, with and without Mohr-Coulomb.
TEST(Parameters, of_joints) {
  using In = CohesiveInput;
  In in;
  in.p = 6e11, in.h = 0.1, in.f_t = 3e6, in.G_f = 100, in.cohesion = 5e6, in.friction_angle = 0.6;
  auto const make = [](In const& i) { make_cohesive_params(i); };
  expect_refusals<In>(
      in,
      {{&In::p, 0, "cohesive joint: the penalty p must be positive"},
       {&In::h, -1, "cohesive joint: the element size h must be positive"},
       {&In::f_t, 0, "cohesive joint: the tensile strength f_t must be positive"},
       {&In::G_f, 0, "cohesive joint: the fracture energy G_f must be positive"},
       {&In::G_s, -1, "cohesive joint: the fracture energy G_s must not be negative"},
       {&In::friction, -0.1, "cohesive joint: the friction mu must not be negative"},
       {&In::cohesion, 0, "cohesive joint: the cohesion c must be positive"},
       {&In::friction_angle, 1.6, "cohesive joint: the friction angle must lie in [0, 90 degrees)"}},
      make);
  in.mohr_coulomb = false, in.f_s = 5e6;
  expect_refusals<In>(in, {{&In::f_s, 0, "cohesive joint: the shear strength f_s must be positive"}}, make);
}

// Requirement: a steel's law names the parameter that cannot be.
TEST(Parameters, of_steels) {
  using In = SteelParams;
  expect_refusals<In>(steel(),
                      {{&In::E_s, 0, "steel: Young's modulus E_s must be positive"},
                       {&In::f_y, 0, "steel: the yield stress f_y must be positive"},
                       {&In::f_u, 400e6, "steel: the tensile strength f_u must not be less than f_y"},
                       {&In::eps_sh, 0.002, "steel: the onset of hardening eps_sh must exceed f_y/E_s"},
                       {&In::eps_u, 0.01, "steel: eps_u must exceed eps_sh"},
                       {&In::eps_br, 0.05, "steel: the rupture strain eps_br must exceed eps_u"}},
                      [](In const& i) { check_steel_params(i); });
}

// Requirement: bond and dowel action name the parameter that cannot be.
TEST(Parameters, of_bar_joints) {
  using Bond = BondInput;
  expect_refusals<Bond>(Bond{0.016, 30e6, 1},
                        {{&Bond::D, 0, "bond: the bar diameter D must be positive"},
                         {&Bond::f_c, 0, "bond: the compressive strength f_c must be positive"},
                         {&Bond::l_g, -1, "bond: the length l_g must not be negative"}},
                        [](Bond const& i) { make_bond_params(i, steel()); });
  using Dowel = DowelInput;
  expect_refusals<Dowel>(Dowel{0.016, 2e-4, 2e11, 5e8, 3e7},
                         {{&Dowel::D, 0, "dowel: the bar diameter D must be positive"},
                          {&Dowel::A_s, 0, "dowel: the steel area A_s must be positive"},
                          {&Dowel::E_s, 0, "dowel: Young's modulus E_s must be positive"},
                          {&Dowel::f_y, 0, "dowel: the yield stress f_y must be positive"},
                          {&Dowel::f_c, 0, "dowel: the compressive strength f_c must be positive"}},
                         [](Dowel const& i) { make_dowel_params(i); });
}

} // namespace
} // namespace fissura::laws
