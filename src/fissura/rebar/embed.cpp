#include "fissura/rebar/embed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/core.h>

#include "fissura/core/ensure.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/geometry/triangle.hpp"
#include "fissura/rebar/crack_spacing.hpp"
#include "fissura/rebar/merge_short.hpp"
#include "fissura/rebar/polyline.hpp"
#include "fissura/rebar/trace.hpp"

namespace fissura::rebar {

namespace {

model::BarProperties properties_of(model::BarSpec const& bar, std::span<model::SteelSpec const> steels) {
  auto const steel =
      std::find_if(steels.begin(), steels.end(), [&](auto const& s) { return s.name == bar.steel; });
  if (steel == steels.end())
    throw core::InputError(bar.place, fmt::format("bar '{}': there is no steel '{}'", bar.name, bar.steel));
  model::BarProperties p;
  p.name = bar.name;
  p.steel = *steel;
  p.diameter = bar.diameter > 0 ? bar.diameter : std::sqrt(4 * bar.area / std::numbers::pi);
  p.area = bar.area > 0 ? bar.area : std::numbers::pi / 4 * bar.diameter * bar.diameter;
  if (!(p.area > 0))
    throw core::InputError(bar.place,
                           fmt::format("bar '{}' needs a diameter or an area above zero", bar.name));
  p.initial_strain = bar.initial_strain;
  p.slip_reduction = bar.slip_reduction;
  p.l_cr_from = bar.l_cr_from, p.l_cr = bar.l_cr;
  p.spacing_is_given = bar.crack_spacing > 0;
  return p;
}

/// Builds the elements and joints of one copy of one bar.
class Builder {
 public:
  Builder(TraceContext const& c, std::span<int const> joint_of, model::Bars& bars)
      : c_(c), joint_of_(joint_of), bars_(bars) {}

  void add(Polyline const& line, Chain const& chain, int bar, int copy) {
    bar_ = bar, copy_ = copy;
    int const first = static_cast<int>(bars_.elements.size());
    for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
      int const before = static_cast<int>(bars_.elements.size());
      add_elements(line, chain.pieces[i]);
      if (i > 0) add_joint(before - 1, before, chain.pieces[i - 1], chain.pieces[i], chain.crossed[i]);
    }
    int const last = static_cast<int>(bars_.elements.size()) - 1;
    if (line.closed && bars_.elements[last].tet != bars_.elements[first].tet)
      add_joint(last, first, chain.pieces.back(), chain.pieces.front(), chain.crossed.front());
  }

 private:
  /// One element, or several where the polyline has kinks inside the tet.
  void add_elements(Polyline const& line, Piece const& piece) {
    double const tiny = 1e-9 * cell_size(c_.mesh, piece.tet);
    double begin = piece.begin;
    for (int k = line.segment_at(begin); k < line.segments(); ++k) {
      bool const last = line.arc[k + 1] >= piece.end - tiny;
      double const end = last ? piece.end : line.arc[k + 1];
      if (last || end - begin > tiny) add_element(line, piece.tet, k, begin, end), begin = end;
      if (last) return;
    }
  }

  void add_element(Polyline const& line, int tet, int segment, double begin, double end) {
    auto const x = corners(c_.mesh, tet);
    double const from = line.arc[segment], to = line.arc[segment + 1];
    Vec3 const a = line.points[segment], d = line.points[segment + 1] - a;
    Vec3 const p0 = a + ((begin - from) / (to - from)) * d, p1 = a + ((end - from) / (to - from)) * d;
    model::BarElement e;
    e.tet = tet;
    e.w0 = geometry::barycentric(x, p0);
    e.w1 = geometry::barycentric(x, p1);
    e.length = end - begin;
    e.axis = (e.length / (to - from)) * d;
    e.start = begin;
    e.bar = bar_;
    e.copy = copy_;
    bars_.elements.push_back(e);
  }

  void add_joint(int elem_a, int elem_b, Piece const& a, Piece const& b,
                 std::vector<Crossed> const& crossed) {
    model::BarJoint j;
    j.faces_begin = static_cast<int>(bars_.faces.size());
    for (auto const& face : crossed)
      if (joint_of_[face.shared_face] >= 0) bars_.faces.push_back(face_crossing(face));
    j.faces_end = static_cast<int>(bars_.faces.size());
    if (j.faces_begin == j.faces_end) return; // the tets are bonded: nothing can open between them
    int const index = static_cast<int>(bars_.joints.size());
    model::BarElement &ea = bars_.elements[elem_a], &eb = bars_.elements[elem_b];
    ea.joint1 = index, eb.joint0 = index;
    j.elem_a = elem_a, j.elem_b = elem_b;
    j.tet_a = ea.tet, j.tet_b = eb.tet;
    j.w_a = ea.w1, j.w_b = eb.w0;
    j.length_a = a.length(), j.length_b = b.length();
    for (int f = j.faces_begin; f < j.faces_end; ++f) j.h += bars_.faces[f].h / (j.faces_end - j.faces_begin);
    j.frame_edge = frame_edge(ea.tet, unit(unit(ea.axis) + unit(eb.axis)));
    j.bar = bar_, j.copy = copy_;
    bars_.joints.push_back(j);
  }

  model::FaceCrossing face_crossing(Crossed const& crossed) const {
    auto const& shared = c_.adjacency.shared[crossed.shared_face];
    auto const xa = corners(c_.mesh, shared.a.tet), xb = corners(c_.mesh, shared.b.tet);
    geometry::Triangle const t{xa[shared.corner_a[0]], xa[shared.corner_a[1]], xa[shared.corner_a[2]]};
    model::FaceCrossing f;
    f.shared_face = crossed.shared_face;
    f.joint = joint_of_[crossed.shared_face];
    f.weights = limited(geometry::barycentric(t, crossed.point));
    f.cosine = std::abs(dot(geometry::normal(t), crossed.direction));
    f.h = geometry::regular_edge(0.5 * (geometry::volume(xa) + geometry::volume(xb)));
    return f;
  }

  /// The point on the triangle: a bar along an edge of the mesh may cross a face just outside it.
  static std::array<double, 3> limited(std::array<double, 3> w) {
    double sum = 0;
    for (double& x : w) sum += x = std::max(x, 0.0);
    for (double& x : w) x /= sum;
    return w;
  }

  /// The edge of the tet that is most nearly normal to r.
  std::array<int, 2> frame_edge(int tet, Vec3 r) const {
    auto const x = corners(c_.mesh, tet);
    std::array<int, 2> best{0, 1};
    double most = -1;
    for (int i = 0; i < 4; ++i)
      for (int k = i + 1; k < 4; ++k)
        if (double const s = norm(cross(unit(x[k] - x[i]), r)); s > most + 1e-9) most = s, best = {i, k};
    return best;
  }

  TraceContext const& c_;
  std::span<int const> joint_of_;
  model::Bars& bars_;
  int bar_ = 0, copy_ = 0;
};

/// The elements must make up the bar: same length, each beginning where the one before ends.
void check_length(model::Bars const& bars, std::size_t first, double length) {
  double at = 0;
  for (std::size_t e = first; e < bars.elements.size(); ++e) {
    core::ensure(std::abs(bars.elements[e].start - at) <= 1e-9 * length && bars.elements[e].length > 0,
                 "the embedding of a bar lost its way");
    at += bars.elements[e].length;
  }
  core::ensure(std::abs(at - length) <= 1e-9 * length, "the embedding of a bar did not keep its length");
}

void account(BarReport& r, model::Bars const& bars, std::size_t first_element, std::size_t first_joint) {
  for (std::size_t i = first_element; i < bars.elements.size(); ++i) {
    auto const& e = bars.elements[i];
    auto const& p = bars.properties[e.bar];
    r.length_kept += e.length;
    r.steel_mass += p.steel.density * p.area * e.length;
    r.shortest = std::min(r.shortest, e.length);
    for (int k = 0; k < 4; ++k) r.largest_weight = std::max({r.largest_weight, e.w0[k], e.w1[k]});
  }
  r.elements += static_cast<int>(bars.elements.size() - first_element);
  r.joints += static_cast<int>(bars.joints.size() - first_joint);
}

/// What makes the results of a bar doubtful.
void warn(Embedding& out, int bar) {
  auto const& p = out.bars.properties[bar];
  int hanging = 0, elements = 0, long_cracks = 0, joints = 0;
  double largest_weight = 0, largest_l = 0, largest_h = 0;
  for (auto const& e : out.bars.elements) {
    if (e.bar != bar) continue;
    ++elements;
    double w = 0;
    for (int k = 0; k < 4; ++k) w = std::max({w, e.w0[k], e.w1[k]});
    hanging += w > 0.9;
    largest_weight = std::max(largest_weight, w);
  }
  for (auto const& j : out.bars.joints) {
    if (j.bar != bar) continue;
    ++joints;
    if (p.slip_reduction == model::SlipReduction::paper) {
      double const l = crack_length(p, j);
      long_cracks += l > 10 * p.diameter;
      largest_l = std::max(largest_l, l);
    }
    largest_h = std::max(largest_h, j.h);
  }
  if (hanging > 0)
    out.warnings.push_back(
        fmt::format("bar '{}': {} of {} bar elements hang on one node (barycentric weight up to {:.2f}, "
                    "more than 0.9) and may be torn out; move the bar off the edges of the mesh",
                    p.name, hanging, elements, largest_weight));
  if (long_cracks > 0)
    out.warnings.push_back(
        fmt::format("bar '{}': l_cr reaches {:.3g} m, more than 10 D = {:.3g} m, at {} of {} bar "
                    "joints; use a finer mesh",
                    p.name, largest_l, 10 * p.diameter, long_cracks, joints));
  if (largest_h > 20 * p.diameter)
    out.warnings.push_back(
        fmt::format("bar '{}': element size up to {:.3g} m, more than 20 D = {:.3g} m; use a finer mesh",
                    p.name, largest_h, 20 * p.diameter));
}

} // namespace

double length_of_face(model::BarJoint const& joint) {
  return (joint.length_a + joint.length_b) / 4;
}

double crack_length(model::BarProperties const& bar, model::BarJoint const& joint) {
  switch (bar.l_cr_from) {
  case model::CrackLength::given:
    return bar.l_cr;
  case model::CrackLength::element_size:
    return joint.h / 2;
  case model::CrackLength::automatic:
    break;
  }
  return length_of_face(joint);
}

double EmbeddingReport::length() const {
  double sum = 0;
  for (auto const& b : bars) sum += b.length_kept;
  return sum;
}

double EmbeddingReport::steel_mass() const {
  double sum = 0;
  for (auto const& b : bars) sum += b.steel_mass;
  return sum;
}

Embedding embed_bars(mesh::Mesh const& mesh, mesh::Adjacency const& adjacency,
                     std::span<model::BarSpec const> specs, std::span<model::SteelSpec const> steels,
                     std::span<int const> joint_of_shared_face) {
  Embedding out;
  if (specs.empty()) return out;
  TetGrid const grid(mesh);
  TraceContext const context{mesh, adjacency, grid};
  Builder builder(context, joint_of_shared_face, out.bars);
  for (std::size_t b = 0; b < specs.size(); ++b) {
    auto const& spec = specs[b];
    out.bars.properties.push_back(properties_of(spec, steels));
    BarReport report;
    report.name = spec.name;
    auto const axes = axes_of(spec, mesh);
    int const lines = static_cast<int>(axes.size());
    out.bars.properties.back().copies = report.copies = spec.count * lines;
    if (spec.slip_reduction == model::SlipReduction::consistent)
      out.bars.properties.back().crack_spacing.assign(static_cast<std::size_t>(report.copies),
                                                      spec.crack_spacing);
    report.shortest = std::numeric_limits<double>::infinity();
    for (int copy = 0; copy < report.copies; ++copy) {
      Polyline const line = polyline_of(spec, axes[static_cast<std::size_t>(copy % lines)], copy / lines);
      Chain const raw = trace(context, line, spec.name, spec.place);
      Chain chain = merge_short(mesh, raw);
      snap_to_kinks(mesh, line, chain);
      auto const first_element = out.bars.elements.size(), first_joint = out.bars.joints.size();
      builder.add(line, chain, static_cast<int>(b), copy);
      check_length(out.bars, first_element, line.length());
      account(report, out.bars, first_element, first_joint);
      report.length_given += line.length();
      report.dropped += static_cast<int>(raw.pieces.size() - chain.pieces.size());
    }
    out.report.bars.push_back(report);
    warn(out, static_cast<int>(b));
  }
  set_crack_spacings(mesh, grid, out.bars);
  return out;
}

void add_steel_mass(model::Bars const& bars, std::span<double> mass) {
  for (auto const& e : bars.elements) {
    auto const& p = bars.properties[e.bar];
    double const half = 0.5 * p.steel.density * p.area * e.length;
    for (auto const* w : {&e.w0, &e.w1}) {
      double sum = 0;
      for (double x : *w) sum += std::max(x, 0.0);
      for (int c = 0; c < 4; ++c) mass[4 * e.tet + c] += half * std::max((*w)[c], 0.0) / sum;
    }
  }
}

std::vector<int> host_tets(model::Bars const& bars) {
  std::vector<int> tets;
  for (auto const& e : bars.elements) tets.push_back(e.tet);
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  return tets;
}

} // namespace fissura::rebar
