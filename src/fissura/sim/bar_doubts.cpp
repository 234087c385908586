#include "fissura/sim/bar_doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <map>

namespace fissura::sim {

using model::BarElement;
using model::Model;

namespace {

/// Axes nearer than this share of the mean diameter: the steel of the one lies in that of the other.
constexpr double in_each_other = 0.9;
constexpr double parallel = 0.966; ///< cosine of 15 degrees
/// Reinforcement beyond this share of the concrete's volume is no reinforcement any more [-].
constexpr double most_steel = 0.2;

struct Piece {
  Vec3 from, to;
  double diameter;
  int bar, copy;

  Vec3 middle() const { return 0.5 * (from + to); }
};

Vec3 place_of(Model const& m, BarElement const& e, std::array<double, 4> const& weights) {
  Vec3 x;
  auto const corners = mesh::corners(m.mesh, e.tet);
  for (std::size_t k = 0; k < 4; ++k) x += weights[k] * corners[k];
  return x;
}

std::vector<Piece> pieces_of(Model const& m) {
  std::vector<Piece> pieces;
  pieces.reserve(m.bars.elements.size());
  for (auto const& e : m.bars.elements)
    pieces.push_back({place_of(m, e, e.w0), place_of(m, e, e.w1),
                      m.bars.properties[static_cast<std::size_t>(e.bar)].diameter, e.bar, e.copy});
  return pieces;
}

/// Distance of the axes where the two run side by side; a large number where they do not.
double apart(Piece const& a, Piece const& b) {
  constexpr double far = 1e300;
  Vec3 const r = a.to - a.from, s = b.to - b.from;
  double const la = norm(r), lb = norm(s);
  if (!(la > 0) || !(lb > 0) || std::abs(dot(r, s)) < parallel * la * lb) return far;
  Vec3 const axis = (1 / la) * r;
  double const begin = dot(b.from - a.from, axis), end = dot(b.to - a.from, axis);
  double const overlap = std::min(la, std::max(begin, end)) - std::max(0.0, std::min(begin, end));
  if (overlap < 0.5 * std::min(la, lb)) return far;
  Vec3 const d = b.middle() - a.middle();
  return norm(d - dot(d, axis) * axis);
}

/// Finds pairs by the cells of a grid that both pieces reach.
class Neighbours {
 public:
  explicit Neighbours(std::vector<Piece> const& pieces) : pieces_(pieces), origin_(pieces.front().from) {
    double size = 0;
    for (auto const& p : pieces) size += norm(p.to - p.from) / static_cast<double>(pieces.size());
    for (auto const& p : pieces) size = std::max(size, p.diameter);
    for (std::size_t i = 0; i < pieces.size(); ++i) insert(static_cast<int>(i), size);
    std::sort(entries_.begin(), entries_.end());
  }

  /// see(i, j) for every pair in a cell, possibly more than once, until it returns false.
  template <class See> void for_pairs(See see) const {
    for (std::size_t begin = 0, end = 0; begin < entries_.size(); begin = end) {
      while (end < entries_.size() && entries_[end].first == entries_[begin].first) ++end;
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = i + 1; j < end; ++j)
          if (!see(entries_[i].second, entries_[j].second)) return;
    }
  }

 private:
  using Cell = std::array<std::int32_t, 3>;

  void insert(int index, double size) {
    auto const& p = pieces_[static_cast<std::size_t>(index)];
    Cell low{}, high{};
    for (int k = 0; k < 3; ++k) {
      auto const at = static_cast<std::size_t>(k);
      low[at] = static_cast<std::int32_t>(
          std::floor((std::min(p.from[k], p.to[k]) - origin_[k] - 0.5 * p.diameter) / size));
      high[at] = static_cast<std::int32_t>(
          std::floor((std::max(p.from[k], p.to[k]) - origin_[k] + 0.5 * p.diameter) / size));
    }
    for (auto x = low[0]; x <= high[0]; ++x)
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z) entries_.push_back({{x, y, z}, index});
  }

  std::vector<Piece> const& pieces_;
  Vec3 origin_;
  std::vector<std::pair<Cell, int>> entries_;
};

/// Two bars of the deck, or one with its own copies, and where they are nearest.
struct Overlap {
  double apart;
  Vec3 at;
};

void find_overlaps(Model const& m, std::vector<std::string>& out) {
  constexpr long enough = 200000; // pairs: with so many it is no slip of a single bar
  constexpr std::size_t shown = 5;
  auto const pieces = pieces_of(m);
  std::map<std::pair<int, int>, Overlap> found; // by bar
  long pairs = 0;
  Neighbours(pieces).for_pairs([&](int i, int j) {
    auto const& a = pieces[static_cast<std::size_t>(std::min(i, j))];
    auto const& b = pieces[static_cast<std::size_t>(std::max(i, j))];
    if (a.bar == b.bar && a.copy == b.copy) return true;
    double const distance = apart(a, b);
    if (distance >= in_each_other * 0.5 * (a.diameter + b.diameter)) return true;
    auto const [where, fresh] = found.try_emplace({a.bar, b.bar}, Overlap{distance, a.middle()});
    if (!fresh && distance < where->second.apart) where->second = {distance, a.middle()};
    return ++pairs < enough;
  });
  for (auto const& [bars, overlap] : found) {
    if (out.size() == shown) {
      out.push_back(fmt::format("and {} more pairs of bars that lie in each other", found.size() - shown));
      return;
    }
    auto const& a = m.bars.properties[static_cast<std::size_t>(bars.first)];
    auto const& b = m.bars.properties[static_cast<std::size_t>(bars.second)];
    auto const who = bars.first == bars.second ? fmt::format("copies of the bar `{}`", a.name)
                                               : fmt::format("the bars `{}` and `{}`", a.name, b.name);
    out.push_back(fmt::format(
        "{} lie in each other at ({:.4g}, {:.4g}, {:.4g}) m: their axes are {:.3g} mm apart, their diameters "
        "are {:.3g} and {:.3g} mm, and their steel counts twice; move one or leave it out",
        who, overlap.at.x, overlap.at.y, overlap.at.z, 1e3 * overlap.apart, 1e3 * a.diameter,
        1e3 * b.diameter));
  }
}

void weigh_steel(Model const& m, std::vector<std::string>& out) {
  double steel = 0, concrete = 0;
  for (auto const& e : m.bars.elements)
    steel += e.length * m.bars.properties[static_cast<std::size_t>(e.bar)].area;
  for (int t = 0; t < m.tets.count; ++t) concrete += m.tets.volume[static_cast<std::size_t>(t)];
  if (steel > most_steel * concrete)
    out.push_back(fmt::format(
        "{}the bars fill {:.3g} % of the volume of the body, whose tets carry as if they were whole: are "
        "`diameter`, `area` and `count` right?",
        steel > concrete ? "there is more steel than concrete: " : "", 100 * steel / concrete));
}

} // namespace

void check_bar_sizes(Model const& m, mesh::Quality const& quality) {
  for (auto const& e : m.bars.elements) {
    auto const& bar = m.bars.properties[static_cast<std::size_t>(e.bar)];
    auto const& spec = m.source.bars[static_cast<std::size_t>(e.bar)];
    if (spec.area > 0 || !(e.length > 0)) continue; // lumped bars have a diameter for their bond
    for (int k = 0; k < 3; ++k) {
      double const width = quality.high[k] - quality.low[k];
      if (std::abs(e.axis[k]) > 0.5 * e.length || bar.diameter < width) continue;
      throw core::InputError(
          spec.place, fmt::format("the bar `{}` is {:.4g} mm thick and the body around it {:.4g} mm along "
                                  "{}: is the unit of `diameter` right?",
                                  bar.name, 1e3 * bar.diameter, 1e3 * width, "xyz"[k]));
    }
  }
}

std::vector<std::string> bar_doubts(Model const& m) {
  std::vector<std::string> out;
  if (m.bars.elements.empty()) return out;
  find_overlaps(m, out);
  weigh_steel(m, out);
  return out;
}

} // namespace fissura::sim
