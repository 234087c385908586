#include "fissura/sim/fields.hpp"

#include <filesystem>
#include <fmt/core.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/core/error.hpp"
#include "fissura/output/vtp.hpp"
#include "fissura/output/vtu.hpp"
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

/// Cracks only where there are joints, rigid bodies only where there are some, the surface unless it is
/// switched off.
bool is_written(Model const& m, std::string_view collection) {
  if (collection == "cracks") return m.joints.count > 0;
  if (collection == "rigid") return !m.rigid.empty();
  return collection != "surface" || m.source.output.surface;
}

Grid grid_of(std::string_view collection, Model const& m, State const& s) {
  if (collection == "fields") return tet_grid(m, s);
  if (collection == "cracks") return crack_frame(m, s);
  if (collection == "bars") return bar_lines(m, s);
  return collection == "surface" ? surface_grid(m, s) : rigid_grid(m, s);
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

bool is_poly_data(std::string_view collection) {
  return collection == "bars" || collection == "surface";
}

FieldWriter::FieldWriter(std::string const& folder) : folder_(folder) {
  for (std::string_view const name : collections) lists_.emplace_back(fmt::format("{}/{}.pvd", folder, name));
  std::error_code ec;
  std::filesystem::create_directories(folder + "/frames", ec);
  if (ec)
    throw core::Error(core::Failure::io,
                      fmt::format("{}/frames: cannot create the folder: {}", folder, ec.message()));
}

std::string frame_file(std::string_view collection, std::size_t number) {
  return fmt::format("frames/{}_{:05}.{}", collection, number, is_poly_data(collection) ? "vtp" : "vtu");
}

void FieldWriter::write(Model const& m, State const& s) {
  for (std::size_t i = 0; i < collections.size(); ++i) {
    std::string_view const name = collections[i];
    if (!is_written(m, name)) continue;
    Grid grid = grid_of(name, m, s);
    grid.time = s.time;
    std::string const file = frame_file(name, frames_.size());
    (is_poly_data(name) ? output::write_vtp : output::write_vtu)(folder_ + "/" + file, grid);
    lists_[i].add(s.time, std::vector<std::string>{file});
  }
  frames_.push_back({s.time});
}

void FieldWriter::start_with(Model const& m, std::vector<Frame> const& frames) {
  frames_ = frames;
  for (std::size_t i = 0; i < collections.size(); ++i) {
    if (!is_written(m, collections[i])) continue;
    std::vector<std::pair<double, std::string>> entries;
    for (std::size_t n = 0; n < frames.size(); ++n) {
      std::string const file = frame_file(collections[i], n);
      std::error_code ec; // a collection that is switched on later has no frames from before
      if (collections[i] != "surface" || std::filesystem::exists(folder_ + "/" + file, ec))
        entries.emplace_back(frames[n].time, file);
    }
    lists_[i].start_with(entries);
  }
}

} // namespace fissura::sim
