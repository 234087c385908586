// Every number of the state outside of the nodes, field by field, through one list.
#include <cstring>
#include <fmt/core.h>
#include <type_traits>
#include <vector>

#include "fissura/core/finite.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/spots.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

constexpr std::size_t blocks_per_chunk = 512; // of joints

template <class... Numbers> bool finite(Numbers... x) {
  double const list[] = {x...};
  return core::all_finite(list, sizeof...(x));
}
bool finite(Vec3 const& v) {
  return finite(v.x, v.y, v.z);
}
/// Of a list of numbers, or of structs of numbers.
template <class Struct> bool all_finite(std::vector<Struct> const& list) {
  static_assert(std::is_trivially_copyable_v<Struct> && sizeof(Struct) % sizeof(double) == 0);
  return core::all_finite(reinterpret_cast<double const*>(list.data()),
                          list.size() * sizeof(Struct) / sizeof(double));
}

// ---- joints -------------------------------------------------------------------------------------

/// The accounts of a damaged joint. Its points and last separations need no look: a number there that is not
/// finite makes the tractions so in the next step, or is overwritten.
bool finite(state::JointHistory const& h) {
  return finite(h.dissipated.mode_I, h.dissipated.mode_II, h.dissipated.friction, h.handed_over,
                h.farthest_squared, h.time_of_failure);
}

/// Bits of a status byte, any of which makes a joint worth a look.
enum class Look : std::uint8_t { at_all_damaged = 7, at_released = 4 };
static_assert(static_cast<int>(state::JointStatus::released) == 4);

/// Whether a joint of a block is worth a look; the status is padded to blocks.
bool has_any(State const& s, std::size_t block, std::uint8_t bits) {
  std::uint64_t eight = 0;
  static_assert(sizeof eight == model::block);
  std::memcpy(&eight, s.joint_status.data() + block * model::block, sizeof eight);
  return (eight & (bits * 0x0101010101010101U)) != 0;
}

bool joints_are_finite(State const& s, Look look) {
  auto const bits = static_cast<std::uint8_t>(look);
  int const bad = parallel::sum_chunks<int>(
      s.joint_status.size() / model::block, blocks_per_chunk, [&](std::size_t begin, std::size_t end) {
        bool found = false;
        for (std::size_t b = begin; b < end; ++b) {
          if (!has_any(s, b, bits)) continue;
          for (std::size_t j = b * model::block; j < (b + 1) * model::block; ++j)
            if ((s.joint_status[j] & bits) != 0) found |= !finite(s.joint_history.of(j));
        }
        for (std::size_t j = begin * model::block; j < end * model::block && !s.joint_rate.empty(); ++j) {
          auto const& r = s.joint_rate[j];
          found |= !finite(r.sum[0], r.sum[1], r.sum[2], r.weight, r.excess);
        }
        return static_cast<int>(found);
      });
  return bad == 0;
}

std::optional<Spot> find_in_joints(Model const& m, State const& s) {
  std::optional<Spot> spot;
  for (std::size_t j = 0; !spot && j < static_cast<std::size_t>(m.joints.count); ++j)
    if (s.joint_status[j] != 0 && !finite(s.joint_history.of(j)))
      spot = joint_spot(m, static_cast<int>(j), "history");
  for (std::size_t j = 0; !spot && j < s.joint_rate.size(); ++j) {
    auto const& r = s.joint_rate[j];
    if (!finite(r.sum[0], r.sum[1], r.sum[2], r.weight, r.excess))
      spot = joint_spot(m, static_cast<int>(j), "strain rate");
  }
  return spot;
}

// ---- bars ---------------------------------------------------------------------------------------

bool finite(laws::Branch const& b) {
  return finite(b.strain, b.stress, b.own_1, b.own_2, b.left);
}
bool finite(laws::BranchList const& list) {
  bool good = true;
  for (auto const& b : list.at) good &= finite(b); // those not in use are zero
  return good;
}
bool finite(laws::SteelHistory const& h) {
  return finite(h.strain, h.stress, h.eps_largest, h.eps_smallest, h.eps_z) && finite(h.now) &&
         finite(h.rising) && finite(h.falling);
}
bool finite(laws::BondCurve const& c) {
  return finite(c.strength, c.eps_y, c.s_y, c.ramp, c.H1, c.H2, c.eps_0, c.s_0);
}
bool finite(laws::BarJointHistory const& h) {
  auto const& b = h.bond;
  auto const& d = h.dowel;
  return finite(h.S_0, h.t_0.x, h.t_0.y, h.t_0.z, h.stored_0, h.S, h.t_s, h.sigma, h.V_s, h.strain,
                b.sigma_cr, b.s_max, b.shift, b.eps_max, b.K, d.DI, d.softening, d.V_max, d.strength) &&
         finite(b.curve) && finite(h.steel);
}

bool bar_joint_is_finite(state::BarState const& b, std::size_t i) {
  auto const& moved = b.motion[i];
  auto const& a = b.account[i];
  return finite(moved.axial, moved.slip_from_start, moved.t_1, moved.t_2, moved.held, a.bond_steel, a.dowel,
                a.rupture, b.joint_stress[i], b.joint_strain[i], b.slip[i], b.normalised_slip[i],
                b.dowel_force[i]) &&
         (!b.is_activated(i) || finite(b.history[i])); // before that the history is not in use
}

std::optional<Spot> find_in_bars(Model const& m, State const& s) {
  auto const& b = s.bars;
  for (std::size_t i = 0; i < b.elongation.size(); ++i)
    if (!finite(b.elongation[i], b.element_stress[i])) return bar_element_spot(m, i, "elongation or stress");
  for (std::size_t i = 0; i < b.history.size(); ++i)
    if (!bar_joint_is_finite(b, i)) return bar_joint_spot(m, i, "slip, stress or history");
  return std::nullopt;
}

bool bars_are_finite(State const& s) {
  auto const& b = s.bars;
  bool good = all_finite(b.elongation) && all_finite(b.element_stress) && all_finite(b.motion) &&
              all_finite(b.account) && all_finite(b.joint_stress) && all_finite(b.joint_strain) &&
              all_finite(b.slip) && all_finite(b.normalised_slip) && all_finite(b.dowel_force);
  for (std::size_t i = 0; i < b.history.size(); ++i)
    if (b.is_activated(i)) good &= finite(b.history[i]);
  return good;
}

// ---- contact, rigid bodies, loads ---------------------------------------------------------------

Spot nameless(std::string what, std::string field) {
  Spot s;
  s.what = std::move(what), s.field = std::move(field);
  return s;
}

std::optional<Spot> find_in_contact(Model const& m, State const& s) {
  for (auto const& p : s.contact.pairs) {
    if (finite(p.energy_at_start, p.stiffness) && finite(p.stretch)) continue;
    Spot spot = tet_spot(m, p.a, "contact spring");
    spot.what += fmt::format(" with tet {}", m.mesh.input_id[static_cast<std::size_t>(p.b)]);
    return spot;
  }
  if (!finite(s.contact.stored, s.contact.travel, s.contact.skin)) return nameless("contact", "search state");
  for (auto const& t : s.rigid.touch)
    if (!finite(t.offset) || !finite(t.stretch)) return tet_spot(m, t.tet, "spring to a rigid body");
  for (std::size_t i = 0; i < s.rigid.body.size(); ++i) {
    auto const& b = s.rigid.body[i];
    if (!finite(b.u) || !finite(b.v) || !finite(b.force) || !finite(b.impulse))
      return nameless(fmt::format("rigid body `{}`", m.rigid[i].name), "motion or force");
  }
  return std::nullopt;
}

std::optional<Spot> find_in_loads(Model const& m, State const& s) {
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    std::string const name = fmt::format("`{}` along {}", m.prescribed[i].name, "xyz"[m.prescribed[i].axis]);
    if (!finite(s.reaction[i])) return nameless(name, "reaction");
    if (!finite(s.prescribed_velocity[i])) return nameless(name, "prescribed velocity");
  }
  for (std::size_t i = 0; i < s.paths.size(); ++i) {
    auto const& p = s.paths[i];
    if (!finite(p.turned_at, p.velocity, p.acceleration, p.toward))
      return nameless(fmt::format("`{}`", m.paths[i].name), "path");
  }
  for (std::size_t i = 0; i < s.stage_start.size(); ++i)
    if (!finite(s.stage_start[i])) return nameless(fmt::format("stage `{}`", m.stages[i].name), "start");
  return std::nullopt;
}

std::optional<Spot> find_in_ledger(State const& s) {
  auto const& l = s.ledger;
  std::pair<char const*, double> const accounts[] = {{"work_supports", l.work_supports},
                                                     {"work_forces", l.work_forces},
                                                     {"work_gravity", l.work_gravity},
                                                     {"viscous", l.viscous},
                                                     {"mass_damping", l.mass_damping},
                                                     {"local_damping", l.local_damping},
                                                     {"contact_friction", l.contact_friction},
                                                     {"absorbed", l.absorbed},
                                                     {"start", l.start},
                                                     {"kinetic", l.kinetic_before},
                                                     {"absolute_work", l.absolute_work}};
  for (auto const& [name, value] : accounts)
    if (!finite(value)) return nameless(fmt::format("the energy ledger"), fmt::format("account `{}`", name));
  return std::nullopt;
}

} // namespace

bool memory_is_finite(Model const& m, State const& s) {
  return idle_memory_is_finite(m, s) && joints_are_finite(s, Look::at_all_damaged);
}

bool idle_memory_is_finite(Model const& m, State const& s) {
  return joints_are_finite(s, Look::at_released) && bars_are_finite(s) && !find_in_contact(m, s) &&
         !find_in_loads(m, s) && !find_in_ledger(s);
}

std::optional<Spot> find_non_finite_memory(Model const& m, State const& s) {
  if (auto spot = find_in_joints(m, s)) return spot;
  if (auto spot = find_in_bars(m, s)) return spot;
  if (auto spot = find_in_contact(m, s)) return spot;
  if (auto spot = find_in_loads(m, s)) return spot;
  return find_in_ledger(s);
}

} // namespace fissura::sim
