#pragma once
// Run folders made by hand: two tets that share a face, one joint between them, a bar through both.
#include <fstream>
#include <string>

#include "fissura/output/pvd.hpp"
#include "fissura/output/vtp.hpp"
#include "fissura/output/vtu.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::report::testing {

using output::testing::read_bytes;
using output::testing::TemporaryFolder;

inline void write_text(std::string const& path, std::string const& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline void add_cell(output::Grid& g, std::uint8_t type, std::initializer_list<Vec3> corners) {
  for (Vec3 const& x : corners) {
    g.connectivity.push_back(static_cast<std::int64_t>(g.points.size()));
    g.points.push_back(x);
  }
  g.offsets.push_back(static_cast<std::int64_t>(g.points.size()));
  g.types.push_back(type);
}

inline output::Array displacement(output::Grid const& g, float x) {
  std::vector<float> u;
  for (std::size_t i = 0; i < g.points.size(); ++i) u.insert(u.end(), {x, 0, 0});
  return {"displacement", 3, u, "m"};
}

/// Two tets on either side of the plane x = 0; with `parted` each is a fragment of its own.
inline output::Grid two_tets(bool parted) {
  output::Grid g;
  Vec3 const a{0, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  add_cell(g, output::cell_type::tetrahedron, {a, b, c, {1, 0, 0}});
  add_cell(g, output::cell_type::tetrahedron, {a, c, b, {-1, 0, 0}});
  g.point_data = {displacement(g, 1e-3F)};
  g.cell_data = {{"group", 1, std::vector<std::int32_t>{0, 1}, ""},
                 {"fragment", 1, std::vector<std::int32_t>{0, parted ? 1 : 0}, ""}};
  return g;
}

/// Joints as triangles in the plane x = 0 at the given heights.
inline output::Grid joints(std::vector<double> const& heights, std::vector<float> const& opening,
                           float damage) {
  output::Grid g;
  for (double const z : heights)
    add_cell(g, output::cell_type::triangle, {{0, 0, z}, {0, 0.03, z}, {0, 0, z + 0.03}});
  std::size_t const n = heights.size();
  g.point_data = {displacement(g, 0)};
  g.cell_data = {{"opening", 1, opening, "m"},
                 {"sliding", 1, std::vector<float>(n, 1e-5F), "m"},
                 {"damage", 1, std::vector<float>(n, damage), "-"},
                 {"mode", 1, std::vector<std::int32_t>(n, 1), "-"},
                 {"time_of_failure", 1, std::vector<float>(n, 0.02F), "s"}};
  return g;
}

/// A bar of two elements along x and the joint between them; a ruptured bar is two lines.
inline output::Grid one_bar(float stress, bool ruptured = false) {
  output::Grid g;
  g.points = {{-0.4, 0.1, 0.1}, {0, 0.1, 0.1}, {0, 0.1, 0.1}, {0.5, 0.1, 0.1}};
  g.connectivity = {0, 1, 2, 3};
  g.offsets = ruptured ? std::vector<std::int64_t>{2, 4} : std::vector<std::int64_t>{4};
  g.types.assign(g.offsets.size(), output::cell_type::poly_line);
  std::int32_t const broken = ruptured ? 1 : 0;
  g.point_data = {displacement(g, 0),
                  {"stress", 1, std::vector<float>{stress, stress, stress / 2, stress / 2}, "Pa"},
                  {"joint", 1, std::vector<std::int32_t>{-1, 0, 0, -1}, "-"},
                  {"joint_stress", 1, std::vector<float>{0, 2 * stress, 2 * stress, 0}, "Pa"},
                  {"joint_strain", 1, std::vector<float>{0, 1e-3F, 1e-3F, 0}, "-"},
                  {"slip", 1, std::vector<float>{0, 2e-4F, 2e-4F, 0}, "m"},
                  {"yielded", 1, std::vector<std::int32_t>{0, 1, 1, 0}, "-"},
                  {"broken", 1, std::vector<std::int32_t>{0, broken, broken, 0}, "-"}};
  std::vector<std::int32_t> const none(g.types.size(), 0);
  g.cell_data = {{"bar", 1, none, "-"}, {"copy", 1, none, "-"}};
  return g;
}

inline std::string history_text(int rows, double factor = 1) {
  std::string text = "time [s],load [N],\"sag, mid [raw]\" [m],energy_residual [-],joints_cracked [-]\n";
  for (int i = 0; i < rows; ++i) {
    double const t = 0.001 * i, load = factor * (i < 60 ? 1000.0 * i : 60000.0 - 500 * (i - 60));
    text += std::to_string(t) + "," + std::to_string(load) + "," + std::to_string(1e-4 * i) + ",0.001," +
            (i < 20 ? "0" : "5") + "\n";
  }
  return text;
}

/// A run that goes on: curves, log and `frames` frames, no run.json.
inline void make_running(std::string const& folder, int frames, double factor = 1) {
  std::filesystem::create_directories(folder + "/frames");
  write_text(folder + "/history.csv", history_text(100, factor) + "0.1,12"); // a last line without its end
  write_text(
      folder + "/log.txt",
      "2026-01-31 12:00:00 info: mesh: 2 tets\n2026-01-31 12:00:00 warning: few <b>elements</b>\n"
      "2026-01-31 12:00:01 info: time step 1e-06 s, limited by x; 200 steps to t = 0.2 s; 1 threads\n");
  output::PvdWriter fields(folder + "/fields.pvd"), cracks(folder + "/cracks.pvd"),
      bars(folder + "/bars.pvd");
  for (int i = 0; i < frames; ++i) {
    auto const add = [&](output::PvdWriter& list, std::string const& kind, output::Grid const& g) {
      bool const lines = kind == "bars";
      std::string const file = "frames/" + kind + "_" + std::to_string(i) + (lines ? ".vtp" : ".vtu");
      (lines ? output::write_vtp : output::write_vtu)(folder + "/" + file, g);
      list.add(0.01 * i, {file});
    };
    bool const last = i + 1 == frames;
    add(fields, "fields", two_tets(last));
    add(cracks, "cracks",
        i == 0 ? output::Grid{joints({}, {}, 0)}
               : joints({0, 0.5}, {1e-4F * static_cast<float>(i), 5e-5F}, 0.9F));
    add(bars, "bars", one_bar(1e8F * static_cast<float>(i)));
  }
}

inline void finish(std::string const& folder, std::string const& title = "two <tets> & a bar",
                   std::string const& hash = "00ff") {
  write_text(folder + "/run.json", R"({"status": "complete", "reason": "end time reached", "title": ")" +
                                       title + R"(", "state_hash": ")" + hash + R"("})");
}

} // namespace fissura::report::testing
