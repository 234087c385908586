#pragma once
// Elastic constants of tets beside joints that are not rigid.
//
// Under a uniform stress sigma a joint of stiffness k per area with normal n opens by (sigma n)/k and adds to
// the mean strain of the volume V the share A sym(sigma n x n)/(k V). With normals in all directions that is
// c sigma, c = sum A/(3 k V): a body of tets with E and nu has 1/E + c in place of 1/E, and its Poisson ratio
// falls alike. Tets with
//
//   1/E' = 1/E - c,   nu' = nu E'/E
//
// give a body of E and nu. c is taken tet by tet, half a joint to each side, so that regions without joints
// stay as they are. Derivation and what is left: docs/theory/tets.md.
#include <vector>

#include "fissura/model/model.hpp"

namespace fissura::model {

struct Elastic {
  double E = 0, nu = 0;
  double G() const { return E / (2 * (1 + nu)); }
  double lame() const { return E * nu / ((1 + nu) * (1 - 2 * nu)); }
};

/// E' and nu' of a material whose joints add the compliance c [1/Pa].
Elastic compensated(ConcreteSpec const& concrete, double c);

/// Per tet what its joints add [1/Pa]; 0 where the concrete's `elastic` is as given. The joints are made.
std::vector<double> joint_compliance(Model const& m);

} // namespace fissura::model
