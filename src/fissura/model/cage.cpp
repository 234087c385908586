#include "fissura/model/cage.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace fissura::model {

namespace {

constexpr double least_clear = 0.02; ///< [m] between parallel bars, EN 1992-1-1:2004, 8.2 (2)

double mm(double metres) {
  return metres * 1e3;
}

/// A row of equal bars across the section: centres `first`, `first + step`, ...
struct Row {
  int count = 0;
  double first = 0, step = 0; ///< [m]
};

/// The member as the cage sees it: lengths along, across and up, and where they are in space.
class Builder {
 public:
  Builder(CageSpec const& cage_, std::vector<CageFault>& faults_)
      : cage(cage_), faults(faults_), along(axis_of(cage_)), up(up_of(cage_)), across(3 - along - up) {
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(cage.from[k], cage.to[k]), high[k] = std::max(cage.from[k], cage.to[k]);
  }

  std::vector<BarSpec> build() {
    if (!has_room()) return {};
    if (cage.kind == CageSpec::Kind::beam)
      build_beam();
    else
      build_column();
    if (cage.stirrups.diameter > 0) build_stirrups();
    return std::move(bars);
  }

 private:
  double end_cover(int end) const { return cage.end_cover[end] < 0 ? cage.cover : cage.end_cover[end]; }
  double size(int axis) const { return high[axis] - low[axis]; }
  /// From a face of the concrete to the surface of a longitudinal bar.
  double inset() const { return cage.cover + cage.stirrups.diameter; }
  double clear(double diameter) const {
    return cage.clear < 0 ? std::max(least_clear, diameter) : cage.clear;
  }

  void fault(std::string key, std::string message) { faults.push_back({std::move(key), std::move(message)}); }

  bool has_room() {
    double const d = cage.stirrups.diameter, s = cage.stirrups.spacing;
    if (s < d) {
      fault("stirrups", fmt::format("stirrups of {:.4g} mm cannot be {:.4g} mm apart: write \"diameter / "
                                    "spacing\", e.g. \"8 mm / 150 mm\"",
                                    mm(d), mm(s)));
      return false;
    }
    double const thickest = thickest_bar(), least = std::min(size(across), size(up));
    double const needed = 2 * (inset() + thickest);
    if (needed > least)
      fault("cover",
            fmt::format("a cover of {:.4g} mm leaves no room for bars in the {:.4g} mm x {:.4g} mm "
                        "section: with these bars at most {:.4g} mm (is the unit right, and `axis`?)",
                        mm(cage.cover), mm(size(across)), mm(size(up)),
                        mm(std::max(0.0, 0.5 * least - cage.stirrups.diameter - thickest))));
    if (end_cover(0) + end_cover(1) >= size(along))
      fault("end_cover", fmt::format("the covers of the ends, {:.4g} mm + {:.4g} mm, leave nothing of the "
                                     "{:.4g} mm long member",
                                     mm(end_cover(0)), mm(end_cover(1)), mm(size(along))));
    return faults.empty();
  }

  double thickest_bar() const {
    double d = std::max(cage.sides.diameter, cage.bars.diameter);
    for (auto const& l : cage.bottom) d = std::max(d, l.diameter);
    for (auto const& l : cage.top) d = std::max(d, l.diameter);
    return d;
  }

  /// `count` bars between the stirrup's legs along one axis of the section, the outer ones in the corners.
  Row row(BarLayer const& layer, int axis, std::string const& key) {
    double const first = low[axis] + inset() + 0.5 * layer.diameter;
    double const span = size(axis) - 2 * inset() - layer.diameter;
    if (layer.count == 1) return {1, first + 0.5 * span, 0};
    double const step = span / (layer.count - 1), gap = clear(layer.diameter);
    // a thousandth of a millimetre is no reason to refuse a layer
    if (step - layer.diameter < gap - 1e-6) {
      int const most = std::max(0, 1 + static_cast<int>((span + 1e-6) / (layer.diameter + gap)));
      fault(key,
            fmt::format("{} x {:.4g} mm do not fit in one layer: {:.4g} mm between the faces less cover and "
                        "stirrups hold {} of them {:.4g} mm apart; use more layers, fewer bars, or a "
                        "smaller `clear`",
                        layer.count, mm(layer.diameter), mm(size(axis) - 2 * inset()), most, mm(gap)));
    }
    return {layer.count, first, step};
  }

  /// Straight bars along the member: `count` copies from the place (across, up) with this offset.
  void add_row(std::string const& name, BarLayer const& layer, double at_across, double at_up, int count,
               int axis, double step) {
    if (count < 1) return;
    BarSpec bar;
    bar.place = cage.place;
    bar.cage = cage.name;
    bar.name = cage.name + "_" + name;
    bar.steel = cage.steel;
    bar.diameter = layer.diameter;
    bar.slip_reduction = cage.slip_reduction, bar.crack_spacing = cage.crack_spacing;
    bar.l_cr_from = cage.l_cr_from, bar.l_cr = cage.l_cr;
    Vec3 from;
    from[across] = at_across, from[up] = at_up, from[along] = low[along] + end_cover(0);
    Vec3 to = from;
    to[along] = high[along] - end_cover(1);
    bar.points = {from, to};
    bar.count = count;
    bar.spacing[axis] = count > 1 ? step : 0;
    bars.push_back(std::move(bar));
  }

  /// Layers from one face inwards; `sense` is +1 from the bottom, -1 from the top. Returns the level of the
  /// first layer and where the innermost one ends.
  struct Levels {
    double first = 0, inner = 0;
  };
  Levels add_layers(std::string const& key, std::vector<BarLayer> const& layers, double face, double sense) {
    Levels levels{face + sense * inset(), face + sense * inset()};
    double before = 0; // diameter of the layer before
    for (std::size_t i = 0; i < layers.size(); ++i) {
      auto const& layer = layers[i];
      double const gap = i == 0 ? 0 : clear(std::max(before, layer.diameter));
      double const level = levels.inner + sense * (gap + 0.5 * layer.diameter);
      if (i == 0) levels.first = level;
      levels.inner = level + sense * 0.5 * layer.diameter;
      before = layer.diameter;
      Row const r = row(layer, across, key);
      add_row(i == 0 ? key : fmt::format("{}_{}", key, i + 1), layer, r.first, level, r.count, across,
              r.step);
    }
    return levels;
  }

  void build_beam() {
    auto const bottom = add_layers("bottom", cage.bottom, low[up], 1);
    auto const top = add_layers("top", cage.top, high[up], -1);
    if (!cage.bottom.empty() && !cage.top.empty() && top.inner - bottom.inner < clear(thickest_bar()) - 1e-6)
      fault("top",
            fmt::format("the layers of `bottom` and `top` leave {:.4g} mm between them; at least {:.4g} "
                        "mm are needed: use fewer layers or thinner bars",
                        mm(top.inner - bottom.inner), mm(clear(thickest_bar()))));
    if (cage.sides.count > 0) build_sides(bottom.first, top.first);
  }

  void build_sides(double bottom, double top) {
    int const n = cage.sides.count;
    double const d = cage.sides.diameter, step = (top - bottom) / (n + 1);
    if (step - d < clear(d) - 1e-6)
      fault("sides",
            fmt::format("{} x {:.4g} mm do not fit between bottom and top: they would be {:.4g} mm apart, "
                        "at least {:.4g} mm are needed",
                        n, mm(d), mm(step - d), mm(clear(d))));
    add_row("side_1", cage.sides, low[across] + inset() + 0.5 * d, bottom + step, n, up, step);
    add_row("side_2", cage.sides, high[across] - inset() - 0.5 * d, bottom + step, n, up, step);
  }

  /// Corner bars, and the others in pairs on opposite faces where the gap is widest.
  void build_column() {
    if (cage.bars.count == 0) return;
    double const d = cage.bars.diameter;
    double const span_across = size(across) - 2 * inset() - d, span_up = size(up) - 2 * inset() - d;
    int in_row = 2, in_side = 0;
    for (int left = (cage.bars.count - 4) / 2; left > 0; --left) {
      if (span_across / (in_row - 1) >= span_up / (in_side + 1))
        ++in_row;
      else
        ++in_side;
    }
    Row const r = row({in_row, d}, across, "bars");
    double const bottom = low[up] + inset() + 0.5 * d, top = high[up] - inset() - 0.5 * d;
    add_row("row_1", cage.bars, r.first, bottom, r.count, across, r.step);
    add_row("row_2", cage.bars, r.first, top, r.count, across, r.step);
    Row const s = row({in_side + 2, d}, up, "bars");
    add_row("side_1", cage.bars, low[across] + inset() + 0.5 * d, bottom + s.step, in_side, up, s.step);
    add_row("side_2", cage.bars, high[across] - inset() - 0.5 * d, bottom + s.step, in_side, up, s.step);
  }

  /// As many as fit at their spacing between the end covers; what is left over is shared by both ends.
  void build_stirrups() {
    double const d = cage.stirrups.diameter, s = cage.stirrups.spacing;
    double const first = low[along] + end_cover(0) + 0.5 * d;
    double const room = size(along) - end_cover(0) - end_cover(1) - d;
    if (room < 0) return fault("stirrups", "the member is too short for a stirrup between its end covers");
    if (room / s > 1e5)
      return fault("stirrups", fmt::format("stirrups every {:.4g} mm would be {:.3g}: is the unit right?",
                                           mm(s), room / s));
    int const n = 1 + static_cast<int>(room / s + 1e-9);
    double const edge = cage.cover + 0.5 * d;
    BarSpec bar;
    bar.place = cage.place;
    bar.cage = cage.name;
    bar.name = cage.name + "_stirrups";
    bar.steel = cage.stirrup_steel.empty() ? cage.steel : cage.stirrup_steel;
    bar.diameter = d;
    bar.closed = true;
    bar.slip_reduction = cage.slip_reduction;
    for (auto const& [right, upper] : {std::pair{false, false}, {true, false}, {true, true}, {false, true}}) {
      Vec3 p;
      p[along] = first + 0.5 * (room - (n - 1) * s);
      p[across] = right ? high[across] - edge : low[across] + edge;
      p[up] = upper ? high[up] - edge : low[up] + edge;
      bar.points.push_back(p);
    }
    bar.count = n;
    bar.spacing[along] = n > 1 ? s : 0;
    bars.push_back(std::move(bar));
  }

  CageSpec const& cage;
  std::vector<CageFault>& faults;
  int along, up, across;
  Vec3 low, high;
  std::vector<BarSpec> bars;
};

} // namespace

int axis_of(CageSpec const& cage) {
  if (cage.axis >= 0) return cage.axis;
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(cage.to[k] - cage.from[k]) > std::abs(cage.to[longest] - cage.from[longest])) longest = k;
  return longest;
}

int up_of(CageSpec const& cage) {
  int const along = axis_of(cage);
  if (cage.kind == CageSpec::Kind::column) return along == 2 ? 1 : 2;
  if (cage.up >= 0 && cage.up != along) return cage.up;
  return along == 2 ? 1 : 2;
}

std::vector<BarSpec> make_bars(CageSpec const& cage, std::vector<CageFault>& faults) {
  std::vector<CageFault> found;
  auto bars = Builder(cage, found).build();
  if (!found.empty()) bars.clear();
  for (auto& f : found) faults.push_back(std::move(f));
  return bars;
}

} // namespace fissura::model
