#include "fissura/report/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fissura::report {

void Cracks::take(output::FrameFile const& file) {
  auto const x = file.floats("Points", "Points", 3);
  auto const u = file.floats("PointData", "displacement", 3);
  if (file.points() != 3 * file.cells()) file.refuse("its joints do not have three points each");
  auto const opening = file.floats("CellData", "opening"), sliding = file.floats("CellData", "sliding");
  auto const damage = file.floats("CellData", "damage"), failed = file.floats("CellData", "time_of_failure");
  auto const modes = file.integers("CellData", "mode");

  CrackFrame f;
  for (std::size_t c = 0; c < opening.size(); ++c) {
    Key key{};
    for (std::size_t k = 0; k < 9; ++k) key[k] = x[9 * c + k] + 0.0F; // no negative zero
    auto const [found, is_new] = number_.try_emplace(key, number_.size());
    std::size_t const j = found->second;
    if (is_new) {
      points.insert(points.end(), key.begin(), key.end());
      mode.push_back(0);
      time_of_failure.push_back(0);
    }
    mode[j] = static_cast<std::uint8_t>(modes[c]);
    time_of_failure[j] = failed[c];
    if (f.opening.size() <= j) {
      f.opening.resize(number_.size()), f.sliding.resize(number_.size()), f.damage.resize(number_.size());
      f.displacement.resize(9 * number_.size());
    }
    f.opening[j] = std::max(opening[c], 0.0F);
    f.sliding[j] = sliding[c];
    f.damage[j] = damage[c];
    for (std::size_t k = 0; k < 9; ++k) f.displacement[9 * j + k] = u[9 * c + k];
  }
  frames.push_back(std::move(f));
}

namespace {

template <class T>
void pick(std::vector<T>& values, std::vector<std::size_t> const& order, std::size_t width) {
  std::vector<T> out;
  out.reserve(order.size() * width);
  for (std::size_t const j : order)
    for (std::size_t k = 0; k < width; ++k) out.push_back(values[width * j + k]);
  values = std::move(out);
}

} // namespace

void Cracks::finish() {
  std::size_t const joints = mode.size();
  std::vector<std::size_t> first(joints, frames.size());
  for (std::size_t n = frames.size(); n-- > 0;) {
    auto& f = frames[n];
    f.opening.resize(joints), f.sliding.resize(joints), f.damage.resize(joints);
    f.displacement.resize(9 * joints);
    for (std::size_t j = 0; j < joints; ++j)
      if (f.damage[j] >= shown_damage) first[j] = n;
  }
  std::vector<std::size_t> order(joints);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t j) { return first[j] == frames.size(); });
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return first[a] < first[b]; });

  for (auto& f : frames) {
    pick(f.opening, order, 1), pick(f.sliding, order, 1), pick(f.damage, order, 1);
    pick(f.displacement, order, 9);
  }
  pick(points, order, 9), pick(mode, order, 1), pick(time_of_failure, order, 1);
  for (std::size_t n = 0; n < frames.size(); ++n)
    shown.push_back(static_cast<std::uint32_t>(
        std::count_if(order.begin(), order.end(), [&](std::size_t j) { return first[j] <= n; })));
  number_.clear();
}

namespace {

/// Mean edge [m] of a joint's triangle.
double mean_edge(float const* p) {
  auto const edge = [p](int a, int b) {
    return std::hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
  };
  return (edge(0, 1) + edge(1, 2) + edge(2, 0)) / 3;
}

} // namespace

std::vector<CrackRow> crack_table(Cracks const& cracks, std::vector<double> const& times, double distance,
                                  std::size_t rows) {
  std::vector<CrackRow> all(cracks.size());
  for (std::size_t j = 0; j < all.size(); ++j) {
    CrackRow& r = all[j];
    for (std::size_t k = 0; k < 9; ++k) r.place[k % 3] += cracks.points[9 * j + k] / 3;
    double const gap = gap_opening * mean_edge(&cracks.points[9 * j]);
    for (std::size_t n = 0; n < cracks.frames.size(); ++n)
      if (double const o = cracks.frames[n].opening[j]; o > r.largest)
        r.largest = o, r.time_of_largest = times[n];
    r.now = cracks.frames.back().opening[j];
    r.sliding = cracks.frames.back().sliding[j];
    r.time_of_failure = cracks.time_of_failure[j];
    r.mode = cracks.mode[j];
    if (r.largest > gap) r.largest = 0;
  }
  std::erase_if(all, [](CrackRow const& r) { return r.largest == 0; });
  std::stable_sort(all.begin(), all.end(),
                   [](auto const& a, auto const& b) { return a.largest > b.largest; });
  std::vector<CrackRow> table;
  for (CrackRow const& r : all) {
    if (table.size() == rows) break;
    bool const near = std::any_of(table.begin(), table.end(), [&](CrackRow const& wider) {
      return std::hypot(r.place[0] - wider.place[0], r.place[1] - wider.place[1],
                        r.place[2] - wider.place[2]) < distance;
    });
    if (!near) table.push_back(r);
  }
  return table;
}

} // namespace fissura::report
