#include "fissura/rebar/crack_spacing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "fissura/geometry/tet.hpp"
#include "fissura/rebar/embed.hpp"

namespace fissura::rebar {

namespace {

constexpr int rays = 24;    // around the bar, from axis to axis of the section where the bar is along one
constexpr int stations = 5; // along a copy
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Tells concrete from air, quickly where the last answer was near.
class Inside {
 public:
  Inside(mesh::Mesh const& mesh, TetGrid const& grid) : mesh_(mesh), grid_(grid) {}
  bool operator()(Vec3 p) {
    if (last_ >= 0 && holds(last_, p)) return true;
    for (int const t : grid_.near_segment(p, p, 0))
      if (holds(t, p)) return last_ = t, true;
    return false;
  }

 private:
  bool holds(int tet, Vec3 p) const {
    auto const w = geometry::barycentric(corners(mesh_, tet), p);
    return *std::min_element(w.begin(), w.end()) >= -1e-9;
  }
  mesh::Mesh const& mesh_;
  TetGrid const& grid_;
  int last_ = -1;
};

struct Line {
  Vec3 from, axis;
};

/// The section of the concrete around one point of a bar.
class Station {
 public:
  Station(Inside& inside, std::vector<Line> const& others, Vec3 at, Vec3 along, double D)
      : at_(at), along_(unit(along)), D_(D), reach_(7.5 * D) {
    Vec3 const r = along_;
    Vec3 least{1, 0, 0}; // the axis most nearly normal to the bar
    if (std::abs(r.y) < std::abs(r.x)) least = {0, 1, 0};
    if (std::abs(r.z) < std::min(std::abs(r.x), std::abs(r.y))) least = {0, 0, 1};
    Vec3 const e_1 = unit(least - dot(least, r) * r), e_2 = cross(r, e_1);
    for (int k = 0; k < rays; ++k) {
      double const angle = 2 * std::numbers::pi * k / rays;
      direction_[k] = std::cos(angle) * e_1 + std::sin(angle) * e_2;
      surface_[k] = distance_to_surface(inside, direction_[k]);
    }
    mirror();
    find_neighbours(others);
  }

  /// Mean distance of cracks 4/3 (c + D/(7.2 rho)); 12 D where the mesh has no concrete around the bar.
  double crack_spacing(double A_s) const {
    double const nearest = *std::min_element(surface_.begin(), surface_.end());
    if (!(nearest <= reach_)) return 12 * D_;
    double const cover = std::max(0.0, nearest - 0.5 * D_);
    double const area = std::max(effective_area(2.5 * (cover + 0.5 * D_)), A_s);
    return 4.0 / 3 * (cover + D_ * area / (7.2 * A_s));
  }

 private:
  /// At most reach_.
  double distance_to_surface(Inside& inside, Vec3 e) const {
    double in = 0, out = 0;
    while (out < reach_) {
      out = std::min(reach_, out + D_);
      if (!inside(at_ + out * e)) break;
      in = out;
    }
    if (in == out) return reach_;
    for (int i = 0; i < 6; ++i) {
      double const middle = 0.5 * (in + out);
      (inside(at_ + middle * e) ? in : out) = middle;
    }
    return 0.5 * (in + out);
  }

  /// A surface within the bar is a plane of symmetry: behind it is what lies on the other side. Where that is
  /// no concrete either, nothing is known.
  void mirror() {
    auto const seen = surface_;
    for (int k = 0; k < rays; ++k)
      if (seen[k] < 0.5 * D_) {
        double const opposite = seen[(k + rays / 2) % rays];
        surface_[k] = opposite < 0.5 * D_ ? infinity : opposite;
      }
  }

  void find_neighbours(std::vector<Line> const& others) {
    for (auto const& o : others) {
      double const slope = dot(o.axis, along_), before = dot(at_ - o.from, along_);
      if (std::abs(slope) < 0.7 * norm(o.axis) || before / slope < 0 || before / slope > 1) continue;
      Vec3 const q = o.from + (before / slope) * o.axis - at_;
      if (double const d = norm(q); d > 0.5 * D_ && d < 2 * reach_) neighbours_.push_back(q);
    }
  }

  /// Concrete within 7.5 D of the bar and `depth` of a surface that is as near to the bar, and not nearer to
  /// another bar.
  double effective_area(double depth) const {
    double sum = 0;
    int known = 0;
    for (int k = 0; k < rays; ++k) {
      if (surface_[k] == infinity) continue;
      double rho = std::min({surface_[k], reach_, reach_within(depth, direction_[k])});
      for (Vec3 const q : neighbours_)
        if (double const c = dot(q, direction_[k]); c > 0) rho = std::min(rho, 0.5 * dot(q, q) / c);
      sum += rho * rho, ++known;
    }
    return std::numbers::pi * sum / known; // 1/2 rho^2 times the angle of a ray
  }

  /// How far one may go along e and stay within `depth` of some face. A face lies where the surface is
  /// nearest among the directions beside it.
  double reach_within(double depth, Vec3 e) const {
    double farthest = 0;
    for (int j = 0; j < rays; ++j) {
      double const d = surface_[j];
      bool const is_face = d <= surface_[(j + 1) % rays] && d <= surface_[(j + rays - 1) % rays];
      if (!is_face || d > std::min(depth, reach_)) continue;
      double const away = -dot(direction_[j], e);
      farthest = std::max(farthest, away > 1e-9 ? (depth - d) / away : infinity);
    }
    return farthest;
  }

  Vec3 at_, along_;
  double D_, reach_;
  std::array<Vec3, rays> direction_{};
  std::array<double, rays> surface_{};
  std::vector<Vec3> neighbours_; ///< where they pass the section, from the bar
};

/// The elements of one copy: a range of Bars::elements.
struct Copy {
  std::size_t begin, end;
};

std::vector<Copy> copies_of(model::Bars const& bars) {
  std::vector<Copy> all;
  for (std::size_t e = 0; e < bars.elements.size(); ++e) {
    auto const& now = bars.elements[e];
    if (e == 0 || now.bar != bars.elements[e - 1].bar || now.copy != bars.elements[e - 1].copy)
      all.push_back({e, e});
    all.back().end = e + 1;
  }
  return all;
}

double median_spacing(Inside& inside, std::vector<Line> const& lines, Copy copy,
                      model::BarProperties const& bar) {
  std::size_t const n = copy.end - copy.begin, picked = std::min<std::size_t>(stations, n);
  std::vector<double> found;
  for (std::size_t i = 0; i < picked; ++i) {
    auto const& line = lines[copy.begin + (2 * i + 1) * n / (2 * picked)];
    Station const station(inside, lines, line.from + 0.5 * line.axis, line.axis, bar.diameter);
    found.push_back(station.crack_spacing(bar.area));
  }
  std::sort(found.begin(), found.end());
  return found[found.size() / 2];
}

std::string range(double low, double high, double unit, char const* name) {
  if (high - low < 0.005 * high) return fmt::format("{:.4g} {}", 0.5 * (low + high) / unit, name);
  return fmt::format("{:.4g} to {:.4g} {}", low / unit, high / unit, name);
}

std::string slip_of(model::Bars const& bars, int bar) {
  auto const& p = bars.properties[static_cast<std::size_t>(bar)];
  if (p.slip_reduction == model::SlipReduction::consistent) {
    auto const [low, high] = std::minmax_element(p.crack_spacing.begin(), p.crack_spacing.end());
    return fmt::format("consistent slip reduction, crack spacing {}{}", range(*low, *high, 1e-3, "mm"),
                       p.spacing_is_given ? "" : " (automatic)");
  }
  double low = infinity, high = 0;
  for (auto const& j : bars.joints)
    if (j.bar == bar) low = std::min(low, crack_length(p, j)), high = std::max(high, crack_length(p, j));
  char const* const from = p.l_cr_from == model::CrackLength::automatic      ? " (automatic)"
                           : p.l_cr_from == model::CrackLength::element_size ? " (element size)"
                                                                             : "";
  if (high == 0) return "the paper's slip reduction";
  return fmt::format("the paper's slip reduction, l_cr {}{}", range(low, high, 1e-3, "mm"), from);
}

} // namespace

void set_crack_spacings(mesh::Mesh const& mesh, TetGrid const& grid, model::Bars& bars) {
  auto const automatic = [](model::BarProperties const& p) {
    return p.slip_reduction == model::SlipReduction::consistent && !p.spacing_is_given;
  };
  if (std::none_of(bars.properties.begin(), bars.properties.end(), automatic)) return;
  std::vector<Line> lines;
  for (auto const& e : bars.elements) lines.push_back({geometry::at(corners(mesh, e.tet), e.w0), e.axis});
  Inside inside(mesh, grid);
  for (Copy const copy : copies_of(bars)) {
    auto const& first = bars.elements[copy.begin];
    auto& p = bars.properties[static_cast<std::size_t>(first.bar)];
    if (automatic(p))
      p.crack_spacing[static_cast<std::size_t>(first.copy)] = median_spacing(inside, lines, copy, p);
  }
}

std::vector<std::string> describe_slip(model::Bars const& bars) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (std::size_t b = 0; b < bars.properties.size(); ++b) {
    std::string const slip = slip_of(bars, static_cast<int>(b));
    auto const same =
        std::find_if(groups.begin(), groups.end(), [&](auto const& g) { return g.first == slip; });
    if (same == groups.end())
      groups.push_back({slip, {bars.properties[b].name}});
    else
      same->second.push_back(bars.properties[b].name);
  }
  std::vector<std::string> lines;
  for (auto const& [slip, names] : groups) {
    std::size_t const shown = std::min<std::size_t>(names.size(), 6);
    std::string list =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (names.size() > shown) list += fmt::format(" and {} more", names.size() - shown);
    lines.push_back(fmt::format("bond of {}: {}", list, slip));
  }
  return lines;
}

} // namespace fissura::rebar
