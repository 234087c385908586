#include "fissura/report/scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "fissura/output/read_frame.hpp"
#include "fissura/report/bars.hpp"
#include "fissura/report/body.hpp"
#include "fissura/report/cracks.hpp"

namespace fissura::report {

using output::FrameFile;
using output::Json;

namespace {

constexpr std::size_t table_rows = 25;

template <class T> std::span<T const> all(std::vector<T> const& v) {
  return v;
}

/// Files of one kind for the chosen moments; lists are as long as each other but for one that is just
/// growing.
class Frames {
 public:
  Frames(RunFolder const& run, std::string const& kind) : list_(run.frames.at(kind)) {}
  std::size_t size() const { return list_.size(); }
  double time(std::size_t i) const { return list_[i].time; }
  FrameFile read(std::size_t i) const { return FrameFile(list_[std::min(i, list_.size() - 1)].file); }

 private:
  std::vector<Frame> const& list_;
};

void add_body(Blob& blob, Body const& body, Frames const& files, std::vector<std::size_t> const& chosen) {
  blob.add("body/points", all(body.points));
  blob.add("body/triangles", all(body.triangles));
  blob.add("body/group", all(body.group));
  Appearance appearance(body, chosen.size());
  Json scales = Json::array();
  std::vector<float> shown(3 * body.node.size());
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    FrameFile const frame = files.read(chosen[n]);
    auto const u = frame.floats("PointData", "displacement", 3);
    if (frame.cells() != body.tets || frame.points() != 4 * body.tets)
      frame.refuse("it has other tets than the first frame");
    for (std::size_t i = 0; i < body.node.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) shown[3 * i + k] = u[3 * body.node[i] + k];
    scales.push_back(blob.add_quantised(fmt::format("body/u/{}", n), all(shown)));
    appearance.take(body, frame, n);
    if (n + 1 < chosen.size() || !frame.has("CellData", "fragment")) continue;
    auto const fragment = frame.integers("CellData", "fragment");
    std::vector<std::uint16_t> of_triangle;
    for (std::uint32_t const t : body.tet)
      of_triangle.push_back(static_cast<std::uint16_t>(std::min<std::int64_t>(fragment[t], 65535)));
    blob.add("body/fragment", all(of_triangle));
  }
  blob.add("body/first", all(appearance.first()));
  blob.meta["scene"]["body"] = {{"u", scales}, {"low", body.low}, {"high", body.high}, {"edge", body.edge}};
}

void add_cracks(Blob& blob, Cracks const& cracks) {
  blob.add("cracks/points", all(cracks.points));
  blob.add("cracks/mode", all(cracks.mode));
  blob.add("cracks/failed", all(cracks.time_of_failure));
  blob.add("cracks/shown", all(cracks.shown));
  Json u = Json::array(), opening = Json::array(), sliding = Json::array();
  for (std::size_t n = 0; n < cracks.frames.size(); ++n) {
    auto const& f = cracks.frames[n];
    std::size_t const shown = cracks.shown[n];
    auto const first = [&](std::vector<float> const& v, std::size_t width) {
      return std::span<float const>(v.data(), width * shown);
    };
    u.push_back(blob.add_quantised(fmt::format("cracks/u/{}", n), first(f.displacement, 9)));
    opening.push_back(blob.add_quantised(fmt::format("cracks/opening/{}", n), first(f.opening, 1)));
    sliding.push_back(blob.add_quantised(fmt::format("cracks/sliding/{}", n), first(f.sliding, 1)));
  }
  blob.meta["scene"]["cracks"] = {{"u", u}, {"opening", opening}, {"sliding", sliding}};
}

void add_bars(Blob& blob, Bars const& bars) {
  blob.add("bars/points", all(bars.points));
  blob.add("bars/along", all(bars.along));
  blob.add("bars/bar", all(bars.bar));
  blob.add("bars/copy", all(bars.copy));
  blob.add("bars/joint_along", all(bars.joint_along));
  blob.add("bars/joint_bar", all(bars.joint_bar));
  blob.add("bars/joint_copy", all(bars.joint_copy));
  blob.add("bars/joint_state", all(bars.joint_state));
  Json scales = Json::object();
  for (std::size_t n = 0; n < bars.frames.size(); ++n) {
    auto const& f = bars.frames[n];
    auto const add = [&](char const* name, std::vector<float> const& v) {
      scales[name].push_back(blob.add_quantised(fmt::format("bars/{}/{}", name, n), all(v)));
    };
    add("u", f.displacement), add("stress", f.stress), add("joint_stress", f.joint_stress);
    add("joint_strain", f.joint_strain), add("slip", f.slip);
  }
  blob.meta["scene"]["bars"] = scales;
}

/// Planes and impactors: triangles, which of them move, and their displacement.
void add_rigid(Blob& blob, Frames const& files, std::vector<std::size_t> const& chosen) {
  if (files.size() == 0) return;
  FrameFile const first = files.read(0);
  auto const body = first.integers("CellData", "impactor");
  std::vector<std::uint8_t> moves;
  for (auto const b : body) moves.push_back(b != 0);
  if (first.points() != 3 * first.cells()) first.refuse("its triangles do not have three points each");
  blob.add("rigid/points", all(first.floats("Points", "Points", 3)));
  blob.add("rigid/moves", all(moves));
  Json scales = Json::array();
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    FrameFile const frame = files.read(chosen[n]);
    if (frame.points() != first.points()) frame.refuse("it has other triangles than the first frame");
    scales.push_back(
        blob.add_quantised(fmt::format("rigid/u/{}", n), all(frame.floats("PointData", "displacement", 3))));
  }
  blob.meta["scene"]["rigid"] = {{"u", scales}};
}

/// Two places belong to one crack if they are nearer than half the smallest extent of the body, since cracks
/// are rarely closer than that, or hardly further apart than an edge of a tet.
double place_distance(Body const& body) {
  double least =
      std::min({body.high[0] - body.low[0], body.high[1] - body.low[1], body.high[2] - body.low[2]});
  return std::max(0.5 * least, 1.2 * body.edge);
}

Json table_of(std::vector<CrackRow> const& rows) {
  Json table = Json::array();
  for (CrackRow const& r : rows)
    table.push_back({{"place", r.place},
                     {"now", r.now},
                     {"sliding", r.sliding},
                     {"largest", r.largest},
                     {"time", r.time_of_largest},
                     {"failed", r.time_of_failure},
                     {"mode", r.mode}});
  return table;
}

/// Frames that fit: from the sizes of the last one, before compression.
std::size_t frames_that_fit(std::size_t bytes, Body const& body, std::size_t cracks, std::size_t bar_cells) {
  std::size_t const once = 24 * body.node.size() + 20 * body.tet.size() + 41 * cracks + 40 * bar_cells;
  std::size_t const each = 6 * body.node.size() + 15 * cracks + 14 * bar_cells + 1;
  return bytes > once ? std::max<std::size_t>(2, (bytes - once) / each) : 2;
}

} // namespace

std::vector<std::size_t> spread(std::size_t total, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (count >= total) {
    for (std::size_t i = 0; i < total; ++i) chosen.push_back(i);
    return chosen;
  }
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(static_cast<std::size_t>(std::lround(
        static_cast<double>(i * (total - 1)) / static_cast<double>(std::max<std::size_t>(count - 1, 1)))));
  return chosen;
}

void add_scene(Blob& blob, RunFolder const& run, std::size_t bytes) {
  Frames const fields(run, "fields"), cracks_files(run, "cracks"), bar_files(run, "bars"),
      rigid(run, "rigid");
  blob.meta["scene"] = nullptr;
  blob.meta["frames"] = Json::array();
  blob.meta["frames_saved"] = fields.size();
  if (fields.size() == 0) return;
  blob.meta["scene"] = Json::object();

  Body const body = find_body(fields.read(0), fields.read(fields.size() - 1));
  std::size_t const last_cracks =
      cracks_files.size() > 0 ? cracks_files.read(cracks_files.size() - 1).cells() : 0;
  std::size_t const bar_cells = bar_files.size() > 0 ? bar_files.read(0).points() : 0;
  auto const chosen = spread(fields.size(), frames_that_fit(bytes, body, last_cracks, bar_cells));
  std::vector<double> times;
  for (std::size_t const i : chosen) times.push_back(fields.time(i));
  blob.meta["frames"] = times;
  add_body(blob, body, fields, chosen);

  if (cracks_files.size() > 0) {
    Cracks cracks;
    for (std::size_t const i : chosen) cracks.take(cracks_files.read(i));
    cracks.finish();
    add_cracks(blob, cracks);
    double const distance = place_distance(body);
    blob.meta["crack_table"] = {{"distance", distance},
                                {"rows", table_of(crack_table(cracks, times, distance, table_rows))}};
  }
  if (bar_cells > 0) {
    Bars bars;
    for (std::size_t const i : chosen) bars.take(bar_files.read(i));
    add_bars(blob, bars);
  }
  add_rigid(blob, rigid, chosen);
}

} // namespace fissura::report
