#include "fissura/report/bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "fissura/output/vtu.hpp"

namespace fissura::report {

using output::VtuFile;

namespace {

double distance(float const* p, float const* q) {
  return std::hypot(static_cast<double>(p[0]) - q[0], static_cast<double>(p[1]) - q[1],
                    static_cast<double>(p[2]) - q[2]);
}

/// Which points each cell has: the first one of each, counted through the file.
std::vector<std::size_t> first_points(VtuFile const& file) {
  auto const ends = file.integers("Cells", "offsets");
  std::vector<std::size_t> first(ends.size(), 0);
  for (std::size_t c = 1; c < ends.size(); ++c) first[c] = static_cast<std::size_t>(ends[c - 1]);
  return first;
}

} // namespace

void Bars::read_geometry(VtuFile const& file, std::vector<float> const& x) {
  auto const types = file.integers("Cells", "types");
  auto const bars = file.integers("CellData", "bar"), copies = file.integers("CellData", "copy");
  auto const point = first_points(file);
  for (std::size_t c = 0; c < types.size(); ++c)
    (types[c] == output::cell_type::line ? element_ : joint_).push_back(c);
  auto const by_bar = [&](std::size_t a, std::size_t b) {
    return std::tie(bars[a], copies[a]) < std::tie(bars[b], copies[b]);
  };
  std::stable_sort(element_.begin(), element_.end(), by_bar);
  std::stable_sort(joint_.begin(), joint_.end(), by_bar);

  std::vector<double> end; // along the bar, of each element
  for (std::size_t i = 0; i < element_.size(); ++i) {
    std::size_t const c = element_[i];
    float const* p = &x[3 * point[c]];
    points.insert(points.end(), p, p + 6);
    bool const same = i > 0 && !by_bar(element_[i - 1], c) && !by_bar(c, element_[i - 1]);
    // A gap, where the bar leaves the body for a while, counts as length too.
    double const begin = same ? end.back() + distance(&points[6 * (i - 1) + 3], p) : 0;
    end.push_back(begin + distance(p, p + 3));
    along.push_back(static_cast<float>(0.5 * (begin + end.back())));
    bar.push_back(static_cast<std::uint16_t>(bars[c]));
    copy.push_back(static_cast<std::uint16_t>(copies[c]));
  }
  for (std::size_t const c : joint_) {
    float const* p = &x[3 * point[c]];
    auto const [low, high] = std::equal_range(element_.begin(), element_.end(), c, by_bar);
    double nearest = std::numeric_limits<double>::infinity(), where = 0;
    for (auto e = low; e != high; ++e) {
      auto const i = static_cast<std::size_t>(e - element_.begin());
      double const from_end = distance(&points[6 * i + 3], p), from_begin = distance(&points[6 * i], p);
      if (from_end < nearest) nearest = from_end, where = end[i];
      if (from_begin < nearest)
        nearest = from_begin, where = end[i] - distance(&points[6 * i], &points[6 * i + 3]);
    }
    joint_along.push_back(static_cast<float>(where));
    joint_bar.push_back(static_cast<std::uint16_t>(bars[c]));
    joint_copy.push_back(static_cast<std::uint16_t>(copies[c]));
  }
}

void Bars::take(VtuFile const& file) {
  if (frames.empty()) read_geometry(file, file.floats("Points", "Points"));
  auto const u = file.floats("PointData", "displacement");
  auto const stress = file.floats("CellData", "stress"), strain = file.floats("CellData", "strain");
  auto const slip = file.floats("CellData", "slip");
  auto const yielded = file.integers("CellData", "yielded"), broken = file.integers("CellData", "broken");
  auto const point = first_points(file);
  BarFrame f;
  for (std::size_t const c : element_) {
    f.displacement.insert(f.displacement.end(), &u[3 * point[c]], &u[3 * point[c]] + 6);
    f.stress.push_back(stress[c]);
  }
  joint_state.clear();
  for (std::size_t const c : joint_) {
    f.joint_stress.push_back(stress[c]);
    f.joint_strain.push_back(strain[c]);
    f.slip.push_back(slip[c]);
    joint_state.push_back(static_cast<std::uint8_t>(broken[c] != 0 ? 2 : yielded[c] != 0 ? 1 : 0));
  }
  frames.push_back(std::move(f));
}

} // namespace fissura::report
