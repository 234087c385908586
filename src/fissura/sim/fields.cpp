#include "fissura/sim/fields.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/core/error.hpp"
#include "fissura/sim/fragments.hpp"

namespace fissura::sim {

using model::Model;
using output::Array;
using output::Grid;
using state::State;

namespace {

void append(std::vector<float>& to, Vec3 v) {
  for (int r = 0; r < 3; ++r) to.push_back(static_cast<float>(v[r]));
}

/// Adds a cell whose points are the next `count` ones.
void add_cell(Grid& g, std::uint8_t type, int count) {
  std::int64_t const first = g.offsets.empty() ? 0 : g.offsets.back();
  for (int i = 0; i < count; ++i) g.connectivity.push_back(first + i);
  g.offsets.push_back(first + count);
  g.types.push_back(type);
}

} // namespace

Grid tet_grid(Model const& m, State const& s) {
  Grid g;
  std::vector<float> displacement, velocity, stress;
  std::vector<std::int32_t> group, number;
  auto const fragment = find_fragments(m, s).of_tet;
  for (int t = 0; t < m.tets.count; ++t) {
    for (int a = 0; a < 4; ++a) {
      int const node = model::node_of(t, a);
      g.points.push_back(m.position.at(node));
      append(displacement, s.u.at(node));
      append(velocity, s.v.at(node));
    }
    add_cell(g, output::cell_type::tetrahedron, 4);
    for (double const x : concrete::tet_stress(m, s, t)) stress.push_back(static_cast<float>(x));
    group.push_back(m.mesh.tet_group[t]);
    number.push_back(m.mesh.input_id[t]);
  }
  g.point_data = {{"displacement", 3, displacement, "m"}, {"velocity", 3, velocity, "m/s"}};
  g.cell_data = {{"stress", 6, stress, "Pa"},
                 {"group", 1, group, ""},
                 {"input_id", 1, number, ""},
                 {"fragment", 1, std::vector<std::int32_t>(fragment.begin(), fragment.end()), ""}};
  return g;
}

Grid crack_grid(Model const& m, State const& s) {
  Grid g;
  std::vector<float> displacement, opening, sliding, damage, failed, lost_I, lost_II;
  std::vector<std::int32_t> mode, broken;
  for (int j = 0; j < m.joints.count; ++j) {
    auto const status = static_cast<state::JointStatus>(s.joint_status[j]);
    if (status == state::JointStatus::intact) continue;
    auto const& joint = m.joints.joints[j];
    auto const history = s.joint_history.of(static_cast<std::size_t>(j));
    for (int k = 0; k < 3; ++k) {
      g.points.push_back(m.position.at(joint.node_a[k]));
      append(displacement, 0.5 * (s.u.at(joint.node_a[k]) + s.u.at(joint.node_b[k])));
    }
    add_cell(g, output::cell_type::triangle, 3);
    auto const kinematics = concrete::joint_kinematics(m, s, j);
    double o = 0, slid = 0, kappa = 0;
    for (int q = 0; q < 3; ++q) {
      o += kinematics.at[q].opening / 3;
      slid += std::hypot(kinematics.at[q].sliding_1, kinematics.at[q].sliding_2) / 3;
      kappa += history.point[q].kappa / 3;
    }
    opening.push_back(static_cast<float>(o));
    sliding.push_back(static_cast<float>(slid));
    damage.push_back(static_cast<float>(kappa));
    failed.push_back(static_cast<float>(history.time_of_failure));
    lost_I.push_back(static_cast<float>(history.dissipated.mode_I));
    lost_II.push_back(static_cast<float>(history.dissipated.mode_II));
    mode.push_back(static_cast<std::int32_t>(laws::crack_mode(history.dissipated)));
    broken.push_back(status >= state::JointStatus::broken);
  }
  g.point_data = {{"displacement", 3, displacement, "m"}};
  g.cell_data = {{"opening", 1, opening, "m"},        {"sliding", 1, sliding, "m"},
                 {"damage", 1, damage, "-"},          {"mode", 1, mode, "-"},
                 {"time_of_failure", 1, failed, "s"}, {"broken", 1, broken, "-"},
                 {"fracture_I", 1, lost_I, "J"},      {"fracture_II", 1, lost_II, "J"}};
  return g;
}

Grid bar_grid(Model const& m, State const& s) {
  Grid g;
  std::vector<float> displacement, stress, strain, slip, normalised;
  std::vector<std::int32_t> bar, copy, yielded, broken;
  auto place = [&](int tet, std::array<double, 4> const& w) {
    Vec3 x, u;
    for (int a = 0; a < 4; ++a) {
      x += w[a] * m.position.at(model::node_of(tet, a));
      u += w[a] * s.u.at(model::node_of(tet, a));
    }
    g.points.push_back(x);
    append(displacement, u);
  };
  auto& b = s.bars;
  auto row = [&](double sigma, double eps, double S, double normal, int of_bar, int of_copy, int y, int r) {
    stress.push_back(static_cast<float>(sigma));
    strain.push_back(static_cast<float>(eps));
    slip.push_back(static_cast<float>(S));
    normalised.push_back(static_cast<float>(normal));
    bar.push_back(of_bar);
    copy.push_back(of_copy);
    yielded.push_back(y);
    broken.push_back(r);
  };
  for (std::size_t i = 0; i < m.bars.elements.size(); ++i) {
    auto const& e = m.bars.elements[i];
    place(e.tet, e.w0);
    place(e.tet, e.w1);
    add_cell(g, output::cell_type::line, 2);
    double const stretch =
        b.elongation[i] / e.length + m.bars.properties[static_cast<std::size_t>(e.bar)].initial_strain;
    row(b.element_stress[i], stretch, 0, 0, e.bar, e.copy, 0, 0);
  }
  for (std::size_t i = 0; i < m.bars.joints.size(); ++i) {
    auto const& j = m.bars.joints[i];
    place(j.tet_a, j.w_a);
    add_cell(g, output::cell_type::vertex, 1);
    row(b.joint_stress[i], b.joint_strain[i], b.slip[i], b.normalised_slip[i], j.bar, j.copy,
        b.has_yielded(i), b.is_broken(i));
  }
  g.point_data = {{"displacement", 3, displacement, "m"}};
  g.cell_data = {{"stress", 1, stress, "Pa"}, {"strain", 1, strain, "-"},
                 {"slip", 1, slip, "m"},      {"normalised_slip", 1, normalised, "-"},
                 {"bar", 1, bar, ""},         {"copy", 1, copy, ""},
                 {"yielded", 1, yielded, ""}, {"broken", 1, broken, ""}};
  return g;
}

FieldWriter::FieldWriter(std::string const& folder)
    : folder_(folder), fields_(folder + "/fields.pvd"), cracks_(folder + "/cracks.pvd"),
      bars_(folder + "/bars.pvd"), rigid_(folder + "/rigid.pvd") {
  std::error_code ec;
  std::filesystem::create_directories(folder + "/frames", ec);
  if (ec)
    throw core::Error(core::Failure::io,
                      fmt::format("{}/frames: cannot create the folder: {}", folder, ec.message()));
}

std::string frame_file(char const* collection, std::size_t number) {
  return fmt::format("frames/{}_{:05}.vtu", collection, number);
}

void FieldWriter::add(output::PvdWriter& list, char const* name, double time, Grid const& grid) {
  std::string const file = frame_file(name, frames_.size());
  output::write_vtu(folder_ + "/" + file, grid);
  list.add(time, std::vector<std::string>{file});
}

void FieldWriter::write(Model const& m, State const& s) {
  add(fields_, "fields", s.time, tet_grid(m, s));
  add(cracks_, "cracks", s.time, crack_grid(m, s));
  add(bars_, "bars", s.time, bar_grid(m, s));
  if (!m.rigid.empty()) add(rigid_, "rigid", s.time, rigid_grid(m, s));
  frames_.push_back({s.time});
}

void FieldWriter::start_with(Model const& m, std::vector<Frame> const& frames) {
  frames_ = frames;
  auto start = [&](output::PvdWriter& list, char const* name) {
    std::vector<std::pair<double, std::string>> entries;
    for (std::size_t i = 0; i < frames.size(); ++i) entries.emplace_back(frames[i].time, frame_file(name, i));
    list.start_with(entries);
  };
  start(fields_, "fields");
  start(cracks_, "cracks");
  start(bars_, "bars");
  if (!m.rigid.empty()) start(rigid_, "rigid");
}

} // namespace fissura::sim
