#include "arrays.hpp"

#include <algorithm>
#include <numeric>
#include <variant>

#include <fmt/core.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/core/error.hpp"
#include "fissura/model/model.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/fragments.hpp"
#include "fissura/sim/history.hpp"
#include "fissura/state/state.hpp"

namespace fissura::python {

using model::Model;
using state::State;

namespace {

using Shape = std::vector<py::ssize_t>;

/// What a view shows of a run.
struct View {
  char const *name, *doc;
  py::array (*make)(Model const&, State const&, py::handle owner);
};

template <class T> py::array on(T const* data, Shape shape, Shape strides, py::handle owner) {
  py::array a(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  // The owner is no buffer, so numpy refuses to make the array writable again.
  py::detail::array_proxy(a.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return a;
}

/// [tet][corner][x, y, z]
py::array nodal(Model const& m, core::NodeField const& values, py::handle owner) {
  constexpr py::ssize_t d = sizeof(double);
  return on(values.data(), {m.tets.count, 4, 3}, {12 * d, 3 * d, d}, owner);
}

py::array per_item(std::vector<double> const& values, py::handle owner) {
  return on(values.data(), {static_cast<py::ssize_t>(values.size())}, {sizeof(double)}, owner);
}

constexpr View views[] = {
    {"u", "[tet][corner][xyz] displacement [m]",
     [](Model const& m, State const& s, py::handle o) { return nodal(m, s.u, o); }},
    {"v", "[tet][corner][xyz] velocity half a step ago [m/s]",
     [](Model const& m, State const& s, py::handle o) { return nodal(m, s.v, o); }},
    {"position", "[tet][corner][xyz] place at t = 0 [m]",
     [](Model const& m, State const&, py::handle o) { return nodal(m, m.position, o); }},
    {"joint_status", "[joint] 0 intact, 1 damaged, 2 broken, 3 parting, 4 released",
     [](Model const& m, State const& s, py::handle o) {
       return on(s.joint_status.data(), {m.joints.count}, {1}, o);
     }},
    {"element_stress", "[bar element] stress [Pa]",
     [](Model const&, State const& s, py::handle o) { return per_item(s.bars.element_stress, o); }},
    {"joint_stress", "[bar joint] stress of the bar [Pa]",
     [](Model const&, State const& s, py::handle o) { return per_item(s.bars.joint_stress, o); }},
    {"joint_strain", "[bar joint] strain of the bar",
     [](Model const&, State const& s, py::handle o) { return per_item(s.bars.joint_strain, o); }},
    {"slip", "[bar joint] slip since the crack [m]",
     [](Model const&, State const& s, py::handle o) { return per_item(s.bars.slip, o); }},
    {"normalised_slip", "[bar joint] slip over the diameter, with the strength of the concrete",
     [](Model const&, State const& s, py::handle o) { return per_item(s.bars.normalised_slip, o); }},
    {"dowel_force", "[bar joint] dowel force [N]",
     [](Model const&, State const& s, py::handle o) { return per_item(s.bars.dowel_force, o); }},
    {"reaction", "[held component] reaction of supports and motions [N]",
     [](Model const&, State const& s, py::handle o) { return per_item(s.reaction, o); }},
};

/// Rows of the state in the order of the input's numbers.
std::vector<int> input_order(Model const& m) {
  std::vector<int> order(static_cast<std::size_t>(m.tets.count));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return m.mesh.input_id[static_cast<std::size_t>(a)] < m.mesh.input_id[static_cast<std::size_t>(b)];
  });
  return order;
}

template <class T> py::array filled(std::vector<T> const& values, Shape shape) {
  return py::array_t<T>(std::move(shape), values.data());
}

py::array nodal_copy(Model const& m, core::NodeField const& from) {
  std::vector<double> values;
  for (int const t : input_order(m))
    for (int k = 0; k < core::per_tet; ++k) values.push_back(from.of_tet(static_cast<std::size_t>(t))[k]);
  return filled(values, {m.tets.count, 4, 3});
}

template <class Value> py::array per_tet(Model const& m, Value value) {
  std::vector<int> values;
  for (int const t : input_order(m)) values.push_back(value(static_cast<std::size_t>(t)));
  return filled(values, {m.tets.count});
}

/// What the joints remember; zeros for those that never were damaged.
template <class Value> py::array per_joint(Model const& m, State const& s, py::ssize_t each, Value value) {
  std::vector<double> values(static_cast<std::size_t>(m.joints.count * each));
  for (int j = 0; j < m.joints.count; ++j)
    if (state::status_of(s, j) != state::JointStatus::intact)
      for (py::ssize_t k = 0; k < each; ++k)
        values[static_cast<std::size_t>(j * each + k)] =
            value(s.joint_history.of(static_cast<std::size_t>(j)), static_cast<std::size_t>(k));
  return filled(values, each == 1 ? Shape{m.joints.count} : Shape{m.joints.count, each});
}

struct Field {
  char const *name, *doc;
  py::array (*make)(Model const&, State const&);
};

constexpr Field fields[] = {
    {"position", "[tet][corner][xyz] place at t = 0 [m]",
     [](Model const& m, State const&) { return nodal_copy(m, m.position); }},
    {"displacement", "[tet][corner][xyz] [m]",
     [](Model const& m, State const& s) { return nodal_copy(m, s.u); }},
    {"velocity", "[tet][corner][xyz] half a step ago [m/s]",
     [](Model const& m, State const& s) { return nodal_copy(m, s.v); }},
    {"stress", "[tet][xx yy zz xy yz zx] Cauchy stress, tension > 0 [Pa]",
     [](Model const& m, State const& s) {
       std::vector<double> values;
       for (int const t : input_order(m))
         for (double const x : concrete::tet_stress(m, s, t)) values.push_back(x);
       return filled(values, {m.tets.count, 6});
     }},
    {"group", "[tet] number of the volume group",
     [](Model const& m, State const&) {
       return per_tet(m, [&](std::size_t t) { return m.mesh.tet_group[t]; });
     }},
    {"input_id", "[tet] number in the input: ascending",
     [](Model const& m, State const&) {
       return per_tet(m, [&](std::size_t t) { return m.mesh.input_id[t]; });
     }},
    {"kappa", "[joint][point] damage, 0 to 1, in the order of the view joint_status",
     [](Model const& m, State const& s) {
       return per_joint(m, s, 3, [](auto const& h, std::size_t q) { return h.point[q].kappa; });
     }},
    {"time_of_failure", "[joint] 0 = has not failed [s], in the order of the view joint_status",
     [](Model const& m, State const& s) {
       return per_joint(m, s, 1, [](auto const& h, std::size_t) { return h.time_of_failure; });
     }},
    {"fragment", "[tet] number of the connected body",
     [](Model const& m, State const& s) {
       auto const of_tet = sim::find_fragments(m, s).of_tet;
       return per_tet(m, [&](std::size_t t) { return static_cast<int>(of_tet[t]); });
     }},
};

[[noreturn]] void unknown(char const* what, std::string const& name,
                          std::vector<std::pair<std::string, std::string>> const& known) {
  std::string names;
  for (auto const& k : known) names += fmt::format("{}`{}`", names.empty() ? "" : ", ", k.first);
  throw core::Error(core::Failure::input,
                    fmt::format("there is no {} `{}`; there are: {}", what, name, names));
}

template <class Items> std::vector<std::pair<std::string, std::string>> names_of(Items const& items) {
  std::vector<std::pair<std::string, std::string>> names;
  for (auto const& i : items) names.emplace_back(i.name, i.doc);
  return names;
}

void add_array(py::dict& to, output::Array const& array) {
  std::visit(
      [&](auto const& values) {
        auto const n = static_cast<py::ssize_t>(values.size());
        Shape const shape = array.components == 1 ? Shape{n} : Shape{n / array.components, array.components};
        to[py::str(array.name)] = filled(values, shape);
      },
      array.values);
}

} // namespace

std::vector<std::pair<std::string, std::string>> view_names() {
  return names_of(views);
}

py::array view(sim::Run const& run, std::string const& name, py::handle owner) {
  for (auto const& v : views)
    if (v.name == name) return v.make(run.model(), run.state(), owner);
  unknown("view", name, view_names());
}

std::vector<std::pair<std::string, std::string>> field_names() {
  return names_of(fields);
}

py::array field(sim::Run const& run, std::string const& name) {
  for (auto const& f : fields)
    if (f.name == name) return f.make(run.model(), run.state());
  unknown("field", name, field_names());
}

py::dict grid(sim::Run const& run, std::string const& which) {
  output::Grid const g = which == "cracks" ? sim::crack_grid(run.model(), run.state())
                         : which == "bars" ? sim::bar_grid(run.model(), run.state())
                                           : sim::rigid_grid(run.model(), run.state());
  py::dict result;
  std::vector<double> points;
  for (Vec3 const p : g.points) points.insert(points.end(), {p.x, p.y, p.z});
  result["points"] = filled(points, {static_cast<py::ssize_t>(g.points.size()), 3});
  result["cells"] = filled(g.connectivity, {static_cast<py::ssize_t>(g.connectivity.size())});
  result["offsets"] = filled(g.offsets, {static_cast<py::ssize_t>(g.offsets.size())});
  for (auto const& a : g.point_data) add_array(result, a);
  for (auto const& a : g.cell_data) add_array(result, a);
  return result;
}

py::array history(sim::Run const& run) {
  auto const& h = run.history();
  auto const columns = static_cast<py::ssize_t>(h.columns().size());
  return filled(h.rows(), {static_cast<py::ssize_t>(h.rows().size()) / columns, columns});
}

} // namespace fissura::python
