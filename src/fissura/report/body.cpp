#include "fissura/report/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "fissura/core/hash.hpp"

namespace fissura::report {

using output::FrameFile;

namespace {

template <std::size_t N, class T> struct HashArray {
  std::size_t operator()(std::array<T, N> const& a) const {
    return static_cast<std::size_t>(core::hash_bytes(a.data(), sizeof a, 0));
  }
};

/// Corners of the face opposite to corner 0, 1, 2, 3 of a tet; normals point outwards.
constexpr std::array<std::array<int, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Numbers the distinct positions: tets own their corners, so copies of a corner agree to the last bit.
std::vector<std::uint32_t> number_positions(std::vector<double> const& x) {
  std::unordered_map<std::array<double, 3>, std::uint32_t, HashArray<3, double>> known;
  known.reserve(x.size() / 6);
  std::vector<std::uint32_t> number;
  number.reserve(x.size() / 3);
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) // + 0.0: no negative zero
    number.push_back(known
                         .try_emplace({x[i] + 0.0, x[i + 1] + 0.0, x[i + 2] + 0.0},
                                      static_cast<std::uint32_t>(known.size()))
                         .first->second);
  return number;
}

struct Side {
  std::uint32_t tet;
  std::uint8_t face;
};

/// For each face of each tet the tet on its other side, or -1.
std::vector<std::int32_t> neighbours(std::vector<std::uint32_t> const& position, std::size_t tets) {
  std::vector<std::int32_t> across(4 * tets, -1);
  std::unordered_map<std::array<std::uint32_t, 3>, Side, HashArray<3, std::uint32_t>> open;
  open.reserve(3 * tets);
  for (std::size_t t = 0; t < tets; ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      std::array<std::uint32_t, 3> key{};
      for (std::size_t k = 0; k < 3; ++k) key[k] = position[4 * t + static_cast<std::size_t>(faces[f][k])];
      std::sort(key.begin(), key.end());
      auto const [other, is_new] =
          open.try_emplace(key, Side{static_cast<std::uint32_t>(t), static_cast<std::uint8_t>(f)});
      if (is_new) continue;
      across[4 * t + f] = static_cast<std::int32_t>(other->second.tet);
      across[4 * other->second.tet + other->second.face] = static_cast<std::int32_t>(t);
      open.erase(other);
    }
  return across;
}

double mean_edge(std::vector<double> const& x, std::size_t tets) {
  double sum = 0;
  for (std::size_t t = 0; t < tets; ++t)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        double const* p = &x[3 * (4 * t + a)];
        double const* q = &x[3 * (4 * t + b)];
        sum += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      }
  return tets > 0 ? sum / static_cast<double>(6 * tets) : 0;
}

} // namespace

Body find_body(FrameFile const& first, FrameFile const& last) {
  Body b;
  auto const x = first.doubles("Points", "Points", 3);
  std::size_t const tets = first.cells();
  if (first.points() != 4 * tets) first.refuse("its tets do not have four points each");
  if (!std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); }))
    first.refuse("a point of it has no place");
  auto const across = neighbours(number_positions(x), tets);
  std::vector<std::int64_t> fragment(tets, 0), group(tets, 0);
  if (last.has("CellData", "fragment") && last.cells() == tets)
    fragment = last.integers("CellData", "fragment");
  if (first.has("CellData", "group")) group = first.integers("CellData", "group");

  std::vector<std::int64_t> shown(x.size() / 3, -1);
  for (std::size_t t = 0; t < tets; ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      std::int32_t const other = across[4 * t + f];
      if (other >= 0 && fragment[t] == fragment[static_cast<std::size_t>(other)]) continue;
      for (int const corner : faces[f]) {
        std::size_t const node = 4 * t + static_cast<std::size_t>(corner);
        if (shown[node] < 0) {
          shown[node] = static_cast<std::int64_t>(b.node.size());
          b.node.push_back(static_cast<std::uint32_t>(node));
          for (std::size_t k = 0; k < 3; ++k) b.points.push_back(static_cast<float>(x[3 * node + k]));
        }
        b.triangles.push_back(static_cast<std::uint32_t>(shown[node]));
      }
      b.tet.push_back(static_cast<std::uint32_t>(t));
      b.across.push_back(other);
      b.group.push_back(static_cast<std::uint8_t>(std::clamp<std::int64_t>(group[t], 0, 255)));
    }
  b.low.fill(std::numeric_limits<double>::infinity());
  b.high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < x.size(); ++i) {
    b.low[i % 3] = std::min(b.low[i % 3], x[i]);
    b.high[i % 3] = std::max(b.high[i % 3], x[i]);
  }
  if (x.empty()) b.low = b.high = {};
  b.edge = mean_edge(x, tets);
  b.tets = tets;
  return b;
}

Appearance::Appearance(Body const& body, std::size_t frames) {
  for (std::int32_t const other : body.across)
    first_.push_back(other < 0 ? 0 : static_cast<std::uint16_t>(frames));
}

void Appearance::take(Body const& body, FrameFile const& frame, std::size_t number) {
  bool const parted =
      std::any_of(body.across.begin(), body.across.end(), [](auto other) { return other >= 0; });
  if (!parted || !frame.has("CellData", "fragment")) return;
  auto const fragment = frame.integers("CellData", "fragment");
  if (fragment.size() != body.tets) frame.refuse("it has other tets than the first frame");
  for (std::size_t i = 0; i < first_.size(); ++i)
    if (body.across[i] >= 0 && first_[i] > number &&
        fragment[body.tet[i]] != fragment[static_cast<std::size_t>(body.across[i])])
      first_[i] = static_cast<std::uint16_t>(number);
}

} // namespace fissura::report
