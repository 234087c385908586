#include <algorithm>
#include <cmath>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::concrete {

using model::Model;
using state::JointHistories;
using state::JointStatus;
using state::State;

namespace {

constexpr std::size_t items_per_chunk = 512;

/// W = G/2 (tr B - 3 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J), written in H = F - I so that small strains keep
/// their digits.
double hyperelastic_density(double G, double lambda, Mat3 const& H) {
  double const first = trace(H), second = 0.5 * (first * first - contract(H, transpose(H))),
               third = determinant(H);
  double const j = first + second + third, log_j = std::log1p(j); // J = 1 + j
  return 0.5 * G * (2 * first + contract(H, H) - 2 * log_j) + 0.25 * lambda * (j * (2 + j) - 2 * log_j);
}

/// Energy of a linear law in the strain of Eq. 7. The law `paper` has no potential; this is the small-strain
/// one.
double paper_density(double G, double lambda, Mat3 const& H) {
  Mat3 const E = 0.5 * (H + transpose(H) + H * transpose(H));
  return G * contract(E, E) + 0.5 * lambda * trace(E) * trace(E);
}

double damaged_joint_energy(Model const& m, State const& s, int joint) {
  auto const status = static_cast<JointStatus>(s.joint_status[static_cast<std::size_t>(joint)]);
  if (status == JointStatus::released) return 0;
  auto const k = joint_kinematics(m, s, joint);
  auto const history = s.joint_history.of(static_cast<std::size_t>(joint));
  auto const law = laws::with_strength(m.joints.law(joint), state::strength_factor(s, joint));
  double sum = 0;
  for (int q = 0; q < 3; ++q)
    sum += laws::cohesive_stored(law, history.point[q], k.at[q], status >= JointStatus::broken);
  return (1 - history.handed_over) * m.joints.joints[joint].area / 3 * sum;
}

Mat3 gradient_rows(model::TetBlocks const& t, std::size_t tet) {
  Mat3 g;
  for (int i = 0; i < 3; ++i)
    for (int r = 0; r < 3; ++r) g[i][r] = t.gradient[model::at(tet, 3 * i + r, 9)];
  return g;
}

} // namespace

Mat3 gradient_in(Model const& m, core::NodeField const& field, int tet) {
  Mat3 const g = gradient_rows(m.tets, static_cast<std::size_t>(tet));
  double const* const f = field.of_tet(static_cast<std::size_t>(tet));
  Mat3 d;
  for (int a = 0; a < 3; ++a)
    for (int r = 0; r < 3; ++r) d[a][r] = f[core::per_node * (a + 1) + r] - f[r];
  return transpose(d) * g;
}

Mat3 displacement_gradient(Model const& m, State const& s, int tet) {
  return gradient_in(m, s.u, tet);
}

double strain_energy(Model const& m, State const& s) {
  return parallel::sum_chunks<double>(
      static_cast<std::size_t>(m.tets.count), items_per_chunk, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t t = begin; t < end; ++t) {
          Mat3 const H = displacement_gradient(m, s, static_cast<int>(t));
          double const G = m.tets.shear_modulus(t), lambda = m.tets.lame(t);
          bool const paper = m.tets.is_paper[t];
          sum +=
              m.tets.volume[t] * (paper ? paper_density(G, lambda, H) : hyperelastic_density(G, lambda, H));
        }
        return sum;
      });
}

double joint_energy(Model const& m, State const& s) {
  JointPass const pass{&m.joints, s.u.data(), nullptr, s.joint_status.data()};
  auto const& set = kernels();
  return parallel::sum_chunks<double>(
      m.joints.blocks(), items_per_chunk / model::block, [&](std::size_t begin, std::size_t end) {
        double sum = set.intact_joint_energy(pass, begin, end);
        std::size_t const last = std::min(end * model::block, static_cast<std::size_t>(m.joints.count));
        for (std::size_t j = begin * model::block; j < last; ++j)
          if (s.joint_status[j] > 0) sum += damaged_joint_energy(m, s, static_cast<int>(j));
        return sum;
      });
}

double joint_energy(Model const& m, State const& s, state::JointSlots const& slots) {
  JointPass const intact{&m.joints, s.u.data(), nullptr, s.joint_status.data()};
  DamagedPass const damaged{s.u.data(), slots.laws.data(), nullptr};
  auto const& set = kernels();
  return parallel::sum_chunks<double>(
      m.joints.blocks(), JointHistories::group / model::block, [&](std::size_t begin, std::size_t end) {
        double sum = set.intact_joint_energy(intact, begin, end);
        auto const lanes =
            static_cast<std::size_t>(slots.lanes[begin * model::block / JointHistories::group].at_work);
        for (std::size_t row = begin; row < begin + (lanes + model::block - 1) / model::block; ++row)
          sum += set.batch_energy(damaged, slots.batches[row], s.joint_history.rows[row]);
        return sum;
      });
}

laws::Dissipation joint_dissipation(Model const& m, State const& s) {
  return parallel::sum_chunks<laws::Dissipation>(static_cast<std::size_t>(m.joints.count), items_per_chunk,
                                                 [&](std::size_t begin, std::size_t end) {
                                                   laws::Dissipation sum{};
                                                   for (std::size_t j = begin; j < end; ++j)
                                                     if (s.joint_status[j] != 0)
                                                       sum += s.joint_history.dissipated(j);
                                                   return sum;
                                                 });
}

std::array<double, 6> tet_stress(Model const& m, State const& s, int tet) {
  auto const t = static_cast<std::size_t>(tet);
  double const G = m.tets.shear_modulus(t), lambda = m.tets.lame(t);
  Mat3 const H = displacement_gradient(m, s, tet), F = H + Mat3::identity();
  Mat3 const E2 = H + transpose(H) + H * transpose(H); // B - I
  Mat3 T;
  if (m.tets.is_paper[t]) {
    T = G * E2 + (0.5 * lambda * trace(E2)) * Mat3::identity();
  } else {
    double const J = determinant(F);
    T = (1 / J) * (G * E2 + (0.5 * lambda * (J * J - 1)) * Mat3::identity());
  }
  return {T[0].x, T[1].y, T[2].z, T[0].y, T[1].z, T[0].z};
}

JointCounts count_joints(Model const& m, State const& s) {
  JointCounts n;
  for (int j = 0; j < m.joints.count; ++j) {
    auto const status = static_cast<JointStatus>(s.joint_status[j]);
    if (status == JointStatus::intact) continue;
    ++n.damaged;
    auto const point = s.joint_history.of(static_cast<std::size_t>(j)).point;
    n.cracked += point[0].kappa > 0 && point[1].kappa > 0 && point[2].kappa > 0;
    n.broken += status >= JointStatus::broken;
    n.released += status == JointStatus::released;
  }
  return n;
}

} // namespace fissura::concrete
