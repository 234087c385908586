#include "fissura/model/make_joints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fissura/model/make_blocks.hpp"
#include "fissura/model/select.hpp"

namespace fissura::model {

namespace {

struct FaceGeometry {
  std::array<Vec3, 3> x;
  Vec3 centroid, normal;
  double area;
};

FaceGeometry geometry_of(Model const& m, mesh::SharedFace const& f) {
  FaceGeometry g;
  auto const& tet = m.mesh.tets[f.a.tet];
  for (int k = 0; k < 3; ++k) g.x[k] = m.mesh.points[tet[f.corner_a[k]]];
  g.centroid = (1.0 / 3) * (g.x[0] + g.x[1] + g.x[2]);
  Vec3 const n = cross(g.x[1] - g.x[0], g.x[2] - g.x[0]);
  g.area = 0.5 * norm(n);
  g.normal = unit(n);
  return g;
}

laws::CohesiveInput law_of(ConcreteSpec const& c, double h) {
  laws::CohesiveInput in;
  in.p = c.penalty > 0 ? c.penalty : 20 * c.E;
  in.h = h;
  in.f_t = c.f_t;
  in.G_f = c.G_f > 0 ? c.G_f : default_fracture_energy(c.f_c);
  in.G_s = c.G_s;
  in.mohr_coulomb = c.shear == ShearStrength::mohr_coulomb;
  in.f_s = c.f_s;
  in.cohesion = c.cohesion > 0 ? c.cohesion : default_cohesion(c.f_c, c.friction_angle);
  in.friction_angle = c.friction_angle;
  in.friction = c.friction;
  in.law = c.joint_law == JointLaw::paper ? laws::CohesiveLaw::paper : laws::CohesiveLaw::energy_consistent;
  in.range =
      c.softening_range == SofteningRange::exact ? laws::CohesiveRange::exact : laws::CohesiveRange::y3d;
  in.crackable = c.crackable;
  in.straight = c.rate_factor != RateFactor::none;
  return in;
}

bool along_axis(Vec3 normal, int axis) {
  return std::abs(normal[axis]) > std::cos(10 * std::numbers::pi / 180);
}

/// Joints whose strength depends on the strain rate go to the full law from this share of it on: their strain
/// rate is gathered there.
constexpr double look_share = 0.5;

/// Padding joints sit on tet 0 with no stiffness and no area.
void make_joint_data(Model& m) {
  auto& j = m.joints;
  std::size_t const n = j.blocks() * block;
  j.node = core::Buffer<int>(6 * n);
  j.edge = core::Buffer<double>(6 * n);
  j.elastic = core::Buffer<double>(6 * n);
  bool const rate = std::any_of(j.law.begin(), j.law.end(), [](auto const& l) { return l.straight_tension; });
  if (rate) j.look_above = core::Buffer<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (rate) j.look_above[i] = 1e300;
    if (i >= static_cast<std::size_t>(j.count)) {
      j.edge[at(i, 0, 6)] = j.edge[at(i, 4, 6)] = 1;
      continue;
    }
    auto const& joint = j.joints[i];
    auto const g = geometry_of(m, m.adjacency.shared[joint.shared_face]);
    for (int k = 0; k < 3; ++k) {
      j.node[at(i, k, 6)] = 4 * joint.node_a[k];
      j.node[at(i, k + 3, 6)] = 4 * joint.node_b[k];
      j.edge[at(i, k, 6)] = (g.x[1] - g.x[0])[k];
      j.edge[at(i, k + 3, 6)] = (g.x[2] - g.x[0])[k];
    }
    auto const& law = j.law[i];
    double const never = 1e300;
    j.elastic[at(i, 0, 6)] = law.k;
    double const share = law.straight_tension ? look_share : 1;
    j.elastic[at(i, 1, 6)] = law.crackable && !law.straight_tension ? 1 / (4 * law.f_t) : 0;
    j.elastic[at(i, 2, 6)] = !law.crackable ? never : share * (law.straight_shear ? law.f_s : 2 * law.f_s);
    j.elastic[at(i, 3, 6)] = law.crackable ? share * law.tan_phi : 0;
    j.elastic[at(i, 4, 6)] = law.crackable && !law.straight_shear ? 1 / (4 * law.f_s) : 0;
    j.elastic[at(i, 5, 6)] = joint.area / 6;
    if (law.crackable && law.straight_tension) j.look_above[i] = look_share * law.f_t;
  }
}

} // namespace

double joint_size(Model const& m, int shared_face, ConcreteSpec const& c) {
  auto const& f = m.adjacency.shared[shared_face];
  switch (c.element_size) {
  case ElementSize::given:
    return c.h;
  case ElementSize::joint_edge: {
    auto const g = geometry_of(m, f);
    return (norm(g.x[1] - g.x[0]) + norm(g.x[2] - g.x[1]) + norm(g.x[0] - g.x[2])) / 3;
  }
  case ElementSize::volume:
    break;
  }
  double const mean = 0.5 * (m.tets.volume[f.a.tet] + m.tets.volume[f.b.tet]);
  return std::cbrt(6 * std::numbers::sqrt2 * mean);
}

JointRegions::JointRegions(Model const& m) : specs_(m.source.joint_regions) {
  for (auto const& spec : specs_) {
    std::vector<char> mask(m.adjacency.shared.size(), 0);
    for (int const f : select_shared_faces(m.mesh, m.adjacency, spec.where))
      mask[f] = !spec.only_axis || along_axis(geometry_of(m, m.adjacency.shared[f]).normal, spec.axis);
    member_.push_back(std::move(mask));
  }
}

void JointRegions::apply(int shared_face, laws::CohesiveInput& in) const {
  for (std::size_t r = 0; r < specs_.size(); ++r) {
    if (!member_[r][shared_face]) continue;
    in.f_t *= specs_[r].strength_factor;
    in.f_s *= specs_[r].strength_factor;
    in.cohesion *= specs_[r].strength_factor;
    in.crackable = in.crackable && specs_[r].crackable;
  }
}

namespace {

/// The concrete that governs a joint: the one that can crack, else the one with the lower tensile strength.
ConcreteSpec const& weaker_side(Model const& m, mesh::SharedFace const& face) {
  auto const& a = m.source.concretes[m.material_of_tet[face.a.tet]];
  auto const& b = m.source.concretes[m.material_of_tet[face.b.tet]];
  bool const a_cracks = a.joints && a.crackable, b_cracks = b.joints && b.crackable;
  bool const a_weaker = a_cracks != b_cracks ? a_cracks : a.f_t <= b.f_t;
  return a_weaker ? a : b;
}

} // namespace

laws::CohesiveParams joint_law(Model const& m, JointRegions const& regions, int shared_face) {
  auto const& weaker = weaker_side(m, m.adjacency.shared[shared_face]);
  auto in = law_of(weaker, joint_size(m, shared_face, weaker));
  regions.apply(shared_face, in);
  return laws::make_cohesive_params(in);
}

void make_joints(Model& m) {
  auto& j = m.joints;
  JointRegions const regions(m);
  m.joint_of_shared_face.assign(m.adjacency.shared.size(), -1);
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f) {
    auto const& face = m.adjacency.shared[f];
    auto const& a = m.source.concretes[m.material_of_tet[face.a.tet]];
    auto const& b = m.source.concretes[m.material_of_tet[face.b.tet]];
    if (!a.joints && !b.joints) continue;
    m.joint_of_shared_face[f] = j.count++;
    Joint joint;
    joint.shared_face = static_cast<int>(f);
    for (int k = 0; k < 3; ++k) {
      joint.node_a[k] = node_of(face.a.tet, face.corner_a[k]);
      joint.node_b[k] = node_of(face.b.tet, face.corner_b[k]);
    }
    joint.area = geometry_of(m, face).area;
    joint.h = joint_size(m, static_cast<int>(f), weaker_side(m, face));
    j.joints.push_back(joint);
    j.law.push_back(joint_law(m, regions, static_cast<int>(f)));
  }
  make_joint_data(m);
}

WeakestPlane weakest_plane(Model const& m, int axis) {
  WeakestPlane worst;
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& law = m.joints.law[i];
    if (!law.crackable) continue;
    double const cosine =
        std::abs(geometry_of(m, m.adjacency.shared[m.joints.joints[i].shared_face]).normal[axis]);
    double const sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    double const drive =
        cosine * (sine - cosine * law.tan_phi); // tau - |sigma_n| tan(phi), per unit of stress
    if (drive <= 1e-9) continue;
    double const stress = law.f_s / drive;
    if (worst.stress == 0 || stress < worst.stress) worst = {stress, std::asin(cosine), axis};
  }
  return worst;
}

} // namespace fissura::model
