// Every number of the state outside of the nodes. Both the look and the search walk the description that
// checkpoints are written by (checkpoint/fields.hpp), which knows every member: none can be forgotten. What
// is left out on purpose is named here, as an overload of its own.
#include <cstddef>
#include <fmt/core.h>
#include <type_traits>
#include <vector>

#include "fissura/checkpoint/walk.hpp"
#include "fissura/core/finite.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/spots.hpp"

namespace fissura::sim {

using model::Model;
using state::State;
namespace described = checkpoint::detail;

namespace {

constexpr std::size_t groups_per_chunk = 16;  // of joints
constexpr std::size_t items_per_chunk = 4096; // of any other list

// ---- the look: is everything finite? --------------------------------------------------------------

template <class T> bool is_fine(T const& x);

/// Displacements and velocities: whatever moves is found by its kinetic energy (find_non_finite_motion).
bool is_fine(core::NodeField const& /*moves*/) {
  return true;
}
/// Only damaged joints have a history, and the status says which (joints_are_finite).
bool is_fine(state::JointHistories const& /*by_status*/) {
  return true;
}
/// Before a crack crosses the bar the history is not in use.
bool is_fine(laws::BarJointHistory const& h) {
  return !h.activated ||
         std::apply([](auto const&... field) { return (is_fine(field) & ...); }, described::fields_of(h));
}

template <class T> constexpr std::size_t doubles_in();
template <class Fields> struct DoublesIn;
template <class... T> struct DoublesIn<std::tuple<T&...>> {
  static constexpr std::size_t value = (doubles_in<std::remove_const_t<T>>() + ...);
};
/// How many doubles lie in an item of fixed size.
template <class T> constexpr std::size_t doubles_in() {
  if constexpr (std::is_same_v<T, double>)
    return 1;
  else if constexpr (described::is_number<T>)
    return 0;
  else if constexpr (described::is_array<T>)
    return std::tuple_size_v<T> * doubles_in<typename T::value_type>();
  else
    return DoublesIn<decltype(described::fields_of(std::declval<T&>()))>::value;
}
/// Doubles and nothing else: a list of them is one row of numbers.
template <class T> constexpr bool is_all_doubles() {
  return std::is_trivially_copyable_v<T> && doubles_in<T>() * sizeof(double) == sizeof(T);
}

template <class T> bool items_are_fine(T const* items, std::size_t count) {
  if constexpr (described::is_number<T> && !std::is_floating_point_v<T>)
    return true;
  else
    return 0 == parallel::sum_chunks<int>(count, items_per_chunk, [&](std::size_t begin, std::size_t end) {
             if constexpr (is_all_doubles<T>()) {
               return static_cast<int>(!core::all_finite(reinterpret_cast<double const*>(items + begin),
                                                         (end - begin) * doubles_in<T>()));
             } else {
               bool good = true;
               for (std::size_t i = begin; i < end; ++i) good &= is_fine(items[i]);
               return static_cast<int>(!good);
             }
           });
}

template <class T> bool is_fine(T const& x) {
  static_assert(!std::is_same_v<T, float>, "the look knows doubles only");
  if constexpr (std::is_same_v<T, double>)
    return core::is_finite(x);
  else if constexpr (described::is_number<T>)
    return true;
  else if constexpr (described::is_list<T> || described::is_buffer<T>)
    return items_are_fine(x.data(), x.size());
  else if constexpr (described::is_array<T>)
    return std::apply([](auto const&... item) { return (is_fine(item) & ...); }, x);
  else
    return std::apply([](auto const&... field) { return (is_fine(field) & ...); }, described::fields_of(x));
}

// ---- joints ---------------------------------------------------------------------------------------

/// What a number that is not finite does to a joint that acts: its accounts and separations spoil its forces
/// or are computed anew, the memory of its points may lie idle for long. Rows of HistoryRows: points come
/// first.
constexpr std::size_t rows_of_points = sizeof(state::JointHistory::point) / sizeof(double);
static_assert(offsetof(state::JointHistory, point) == 0);

bool is_all_intact(State const& s, std::size_t group) {
  std::uint8_t any = 0;
  std::size_t const first = state::JointHistories::first_of(group);
  for (std::size_t j = 0; j < s.joint_history.room(group); ++j) any |= s.joint_status[first + j];
  return any == 0;
}

/// The first `rows` numbers of the joints at work and all of the released ones.
bool group_is_finite(State const& s, std::size_t group, std::size_t rows) {
  if (is_all_intact(s, group)) return true;
  auto const lanes = state::count_lanes(s, group);
  auto const at_work = static_cast<std::size_t>(lanes.at_work),
             released = static_cast<std::size_t>(lanes.released), room = s.joint_history.room(group);
  auto const* const first = &s.joint_history.rows[state::JointHistories::first_of(group) / model::block];
  auto const look = [&](std::size_t begin, std::size_t end, std::size_t numbers) {
    bool good = true;
    for (std::size_t eight = begin / model::block; eight * model::block < end; ++eight)
      good &= core::all_finite(first[eight].row[0].data(), numbers * model::block);
    return good;
  };
  return look(0, at_work, rows) && look(room - released, room, state::JointHistory::doubles);
}

bool joints_are_finite(State const& s, std::size_t rows) {
  return 0 == parallel::sum_chunks<int>(s.joint_history.groups(), groups_per_chunk,
                                        [&](std::size_t begin, std::size_t end) {
                                          bool good = true;
                                          for (std::size_t g = begin; g < end; ++g)
                                            good &= group_is_finite(s, g, rows);
                                          return static_cast<int>(!good);
                                        });
}

// ---- the search: which one is not? ----------------------------------------------------------------

/// A number that is not finite: `bars.history[17].bond.K`, and the first index in it.
struct Found {
  std::string path;
  std::size_t index = 0;

  bool is_in(std::string_view prefix) const { return path.starts_with(prefix); }
  /// What follows the first index, or the last of its names.
  std::string field() const {
    auto const bracket = path.find(']'), dot = path.rfind('.');
    if (bracket != std::string::npos && bracket + 2 < path.size()) return path.substr(bracket + 2);
    std::string const all = path.substr(0, path.find('['));
    return dot == std::string::npos || dot > all.size() ? all : all.substr(dot + 1);
  }
};

std::optional<Found> search(State const& s) {
  std::optional<Found> found;
  checkpoint::walk_numbers(s, "", [&](double x, std::string const& path) {
    if (core::is_finite(x) || path.starts_with("u.") || path.starts_with("v.") ||
        path.starts_with("joint_history."))
      return false;
    auto const bracket = path.find('[');
    std::size_t const index = bracket == std::string::npos ? 0 : std::stoul(path.substr(bracket + 1));
    if (path.starts_with("bars.history") && !s.bars.is_activated(index)) return false;
    found = Found{path, index};
    return true;
  });
  return found;
}

std::optional<Spot> find_in_joints(Model const& m, State const& s) {
  for (std::size_t j = 0; j < static_cast<std::size_t>(m.joints.count); ++j)
    if (s.joint_status[j] != 0 && !is_fine(s.joint_history.of(j)))
      return joint_spot(m, static_cast<int>(j), "history");
  return std::nullopt;
}

Spot nameless(std::string what, std::string field) {
  Spot s;
  s.what = std::move(what), s.field = std::move(field);
  return s;
}

Spot contact_spot(Model const& m, state::ContactPair const& p, std::string field) {
  Spot spot = tet_spot(m, p.a, std::move(field));
  spot.what += fmt::format(" in contact with tet {}", m.mesh.input_id[static_cast<std::size_t>(p.b)]);
  return spot;
}

/// What in the model the number belongs to.
Spot spot_of(Model const& m, State const& s, Found const& f) {
  std::string const field = "`" + f.field() + "`";
  std::size_t const i = f.index;
  auto const prescribed = [&] {
    return fmt::format("`{}` along {}", m.prescribed[i].name, "xyz"[m.prescribed[i].axis]);
  };
  if (f.is_in("joint_rate")) return joint_spot(m, static_cast<int>(i), "strain rate " + field);
  if (f.is_in("bars.elongation") || f.is_in("bars.element_")) return bar_element_spot(m, i, field);
  if (f.is_in("bars.")) return bar_joint_spot(m, i, field);
  if (f.is_in("contact.pairs")) return contact_spot(m, s.contact.pairs[i], field);
  if (f.is_in("contact")) return nameless("the search for contact", field);
  if (f.is_in("rigid.touch")) return tet_spot(m, s.rigid.touch[i].tet, "spring to a rigid body: " + field);
  if (f.is_in("rigid.body")) return nameless(fmt::format("rigid body `{}`", m.rigid[i].name), field);
  if (f.is_in("reaction") || f.is_in("prescribed")) return nameless(prescribed(), field);
  if (f.is_in("paths")) return nameless(fmt::format("path `{}`", m.paths[i].name), field);
  if (f.is_in("stage_start")) return nameless(fmt::format("stage `{}`", m.stages[i].name), field);
  if (f.is_in("ledger")) return nameless("the energy ledger", "account " + field);
  return nameless("the loads' time", field);
}

} // namespace

bool memory_is_finite(Model const& /*m*/, State const& s) {
  return is_fine(s) && joints_are_finite(s, state::JointHistory::doubles);
}

bool idle_memory_is_finite(Model const& /*m*/, State const& s) {
  return is_fine(s) && joints_are_finite(s, rows_of_points);
}

std::optional<Spot> find_non_finite_memory(Model const& m, State const& s) {
  if (auto spot = find_in_joints(m, s)) return spot;
  auto const found = search(s);
  return found ? std::optional(spot_of(m, s, *found)) : std::nullopt;
}

} // namespace fissura::sim
