#include "fissura/report/bars.hpp"

#include <cmath>
#include <set>
#include <utility>

namespace fissura::report {

using output::FrameFile;

namespace {

double distance(float const* p, float const* q) {
  return std::hypot(static_cast<double>(p[0]) - q[0], static_cast<double>(p[1]) - q[1],
                    static_cast<double>(p[2]) - q[2]);
}

/// Bar and copy of each element: elements lie one after the other along the polylines, two points to each.
std::vector<std::pair<std::int64_t, std::int64_t>> owners(FrameFile const& file) {
  if (file.has("Cells", "types"))
    file.refuse(
        "its bars are as earlier versions of Fissura wrote them; make the page with the version that made "
        "the run (run.json names it), or run the case again");
  auto const lines = file.cell_list("Lines");
  auto const bars = file.integers("CellData", "bar"), copies = file.integers("CellData", "copy");
  std::vector<std::pair<std::int64_t, std::int64_t>> of_element;
  if (lines.size() != file.cells() || lines.connectivity.size() != file.points())
    file.refuse("its points do not lie along its lines");
  for (std::size_t c = 0; c < lines.size(); ++c) {
    if ((lines.end(c) - lines.begin(c)) % 2 != 0) file.refuse("a bar element has no end");
    for (std::size_t i = lines.begin(c); i < lines.end(c); ++i)
      if (lines.connectivity[i] != static_cast<std::int64_t>(i))
        file.refuse("its points do not lie along its lines");
    of_element.insert(of_element.end(), (lines.end(c) - lines.begin(c)) / 2, {bars[c], copies[c]});
  }
  return of_element;
}

} // namespace

void Bars::read_geometry(FrameFile const& file) {
  auto const x = file.floats("Points", "Points", 3);
  auto const joints = file.integers("PointData", "joint");
  auto const owner = owners(file);
  std::set<std::int64_t> seen; // a joint is told at both of its sides
  double end = 0;              // along the bar
  auto const add_joint = [&](std::size_t point, double where) {
    if (joints[point] < 0 || !seen.insert(joints[point]).second) return;
    joint_.push_back(point);
    joint_along.push_back(static_cast<float>(where));
    joint_bar.push_back(bar.back());
    joint_copy.push_back(copy.back());
  };
  for (std::size_t i = 0; i < owner.size(); ++i) {
    float const* p = &x[6 * i];
    points.insert(points.end(), p, p + 6);
    bool const same = i > 0 && owner[i] == owner[i - 1];
    // A gap, where the bar leaves the body for a while, counts as length too.
    double const begin = same ? end + distance(p - 3, p) : 0;
    end = begin + distance(p, p + 3);
    along.push_back(static_cast<float>(0.5 * (begin + end)));
    bar.push_back(static_cast<std::uint16_t>(owner[i].first));
    copy.push_back(static_cast<std::uint16_t>(owner[i].second));
    add_joint(2 * i, begin);
    add_joint(2 * i + 1, end);
  }
}

void Bars::take(FrameFile const& file) {
  if (frames.empty()) read_geometry(file);
  if (6 * along.size() != 3 * file.points()) file.refuse("it has other bars than the first frame");
  auto const stress = file.floats("PointData", "stress"), at_joint = file.floats("PointData", "joint_stress");
  auto const strain = file.floats("PointData", "joint_strain"), slip = file.floats("PointData", "slip");
  auto const yielded = file.integers("PointData", "yielded"), broken = file.integers("PointData", "broken");
  BarFrame f{.displacement = file.floats("PointData", "displacement", 3)};
  for (std::size_t i = 0; i < along.size(); ++i) f.stress.push_back(stress[2 * i]);
  joint_state.clear();
  for (std::size_t const p : joint_) {
    f.joint_stress.push_back(at_joint[p]);
    f.joint_strain.push_back(strain[p]);
    f.slip.push_back(slip[p]);
    joint_state.push_back(static_cast<std::uint8_t>(broken[p] != 0 ? 2 : yielded[p] != 0 ? 1 : 0));
  }
  frames.push_back(std::move(f));
}

} // namespace fissura::report
