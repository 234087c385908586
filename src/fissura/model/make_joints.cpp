#include "fissura/model/make_joints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fissura/core/error.hpp"
#include "fissura/model/defaults.hpp"
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
  in.p = joint_penalty(c);
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

constexpr double never = 1e300;

/// The numbers by which the undamaged branch knows that it has come to its end.
std::array<double, 5> limits_of(laws::CohesiveParams const& law) {
  if (!law.crackable) return {0, never, 0, 0, never};
  double const share = law.straight_tension ? look_share : 1;
  return {law.straight_tension ? 0 : 1 / (4 * law.f_t), share * (law.straight_shear ? law.f_s : 2 * law.f_s),
          share * law.tan_phi, law.straight_shear ? 0 : 1 / (4 * law.f_s),
          law.straight_tension ? look_share * law.f_t : never};
}

/// Padding joints sit on tet 0 with no stiffness and no area.
void make_joint_data(Model& m, std::vector<double> const& k) {
  auto& j = m.joints;
  std::size_t const n = j.blocks() * block;
  j.node = core::Buffer<int>(6 * n);
  j.edge = core::Buffer<float>(6 * n);
  j.stiffness = core::Buffer<double>(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i >= static_cast<std::size_t>(j.count)) {
      j.edge[at(i, 0, 6)] = j.edge[at(i, 4, 6)] = 1;
      continue;
    }
    auto const& joint = j.joints[i];
    auto const g = geometry_of(m, m.adjacency.shared[joint.shared_face]);
    for (int c = 0; c < 3; ++c) {
      j.node[at(i, c, 6)] = core::per_node * joint.node_a[c];
      j.node[at(i, c + 3, 6)] = core::per_node * joint.node_b[c];
      j.edge[at(i, c, 6)] = static_cast<float>((g.x[1] - g.x[0])[c]);
      j.edge[at(i, c + 3, 6)] = static_cast<float>((g.x[2] - g.x[0])[c]);
    }
    j.stiffness[at(i, 0, 2)] = k[i];
    j.stiffness[at(i, 1, 2)] = joint.area / 6;
  }
  j.limits = SharedRows<5, block>(n, [&](std::size_t i) {
    return i < j.kind.size() ? limits_of(j.kinds[j.kind[i]]) : std::array<double, 5>{0, never, 0, 0, never};
  });
  for (auto const& kind : j.kinds) j.any_rate |= kind.crackable && kind.straight_tension;
}

} // namespace

void JointBlocks::add(Joint const& joint, laws::CohesiveParams const& law) {
  auto const unit_law = laws::with_stiffness(law, 1);
  auto at = std::find(kinds.rbegin(), kinds.rend(), unit_law);
  if (at == kinds.rend()) {
    if (kinds.size() > 0xffff)
      throw core::Error(core::Failure::input, "more than 65,536 kinds of joints (regions times concretes)");
    kinds.push_back(unit_law);
    at = kinds.rbegin();
  }
  kind.push_back(static_cast<std::uint16_t>(kinds.rend() - at - 1));
  joints.push_back(joint);
}

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
  std::vector<double> k;
  m.joint_of_shared_face.assign(m.adjacency.shared.size(), -1);
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f) {
    auto const& face = m.adjacency.shared[f];
    auto const& a = m.source.concretes[m.material_of_tet[face.a.tet]];
    auto const& b = m.source.concretes[m.material_of_tet[face.b.tet]];
    if (!a.joints && !b.joints) continue;
    m.joint_of_shared_face[f] = j.count++;
    Joint joint;
    joint.shared_face = static_cast<int>(f);
    for (int c = 0; c < 3; ++c) {
      joint.node_a[c] = node_of(face.a.tet, face.corner_a[c]);
      joint.node_b[c] = node_of(face.b.tet, face.corner_b[c]);
    }
    joint.area = geometry_of(m, face).area;
    joint.h = joint_size(m, static_cast<int>(f), weaker_side(m, face));
    auto const law = joint_law(m, regions, static_cast<int>(f));
    j.add(joint, law);
    k.push_back(law.k);
  }
  make_joint_data(m, k);
}

WeakestPlane weakest_plane(Model const& m, int axis) {
  WeakestPlane worst;
  for (int i = 0; i < m.joints.count; ++i) {
    auto const law = m.joints.law(i);
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
