#include "fissura/mesh/box.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "fissura/mesh/merge.hpp"

namespace fissura::mesh {

namespace {

/// Positions in a box are counted in half cells: even numbers are grid planes, odd ones the middles of cells.
using Half = std::array<int, 3>;

constexpr std::array<char const*, 6> side_names{"x-", "x+", "y-", "y+", "z-", "z+"};

Vec3 lower(BoxCells const& b) {
  return {std::min(b.from.x, b.to.x), std::min(b.from.y, b.to.y), std::min(b.from.z, b.to.z)};
}
Vec3 upper(BoxCells const& b) {
  return {std::max(b.from.x, b.to.x), std::max(b.from.y, b.to.y), std::max(b.from.z, b.to.z)};
}

[[noreturn]] void refuse(BoxCells const& b, std::string const& why) {
  throw core::InputError(b.place, fmt::format("box '{}': {}", b.name, why));
}

void check_numbers(BoxCells const& b) {
  Vec3 const size = upper(b) - lower(b);
  for (int k = 0; k < 3; ++k) {
    char const axis = "xyz"[k];
    if (!std::isfinite(b.from[k]) || !std::isfinite(b.to[k]))
      refuse(b, fmt::format("{} is not a number", axis));
    if (!(size[k] > 0))
      refuse(b, fmt::format("no extent along {}: both corners are at {:g} m", axis, b.from[k]));
    if (b.cells[k] < 1) refuse(b, fmt::format("{} cells along {}, at least 1 is needed", b.cells[k], axis));
    if (!(b.grading[k] >= 1e-6 && b.grading[k] <= 1e6))
      refuse(b, fmt::format("grading {:g} along {} is outside 1e-6 .. 1e6", b.grading[k], axis));
  }
  if (b.tets_per_cell != 6 && b.tets_per_cell != 24)
    refuse(b, fmt::format("{} tets per cell: only 6 and 24 are known", b.tets_per_cell));
}

void check_total(std::span<BoxCells const> boxes) {
  double tets = 0;
  for (auto const& b : boxes) tets += double(b.tets_per_cell) * b.cells[0] * b.cells[1] * b.cells[2];
  if (tets > 2.5e8)
    throw core::InputError(boxes[0].place, fmt::format("the boxes ask for {:.3g} tets; at most 2.5e8 can be "
                                                       "numbered: use fewer cells",
                                                       tets));
}

void check_overlaps(std::span<BoxCells const> boxes, double tolerance) {
  for (std::size_t j = 1; j < boxes.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      Vec3 low, high;
      bool overlap = true;
      for (int k = 0; k < 3; ++k) {
        low[k] = std::max(lower(boxes[i])[k], lower(boxes[j])[k]);
        high[k] = std::min(upper(boxes[i])[k], upper(boxes[j])[k]);
        overlap = overlap && high[k] - low[k] > tolerance;
      }
      if (overlap)
        refuse(boxes[j], fmt::format("overlaps box '{}' between ({:g}, {:g}, {:g}) and ({:g}, {:g}, {:g}) m",
                                     boxes[i].name, low.x, low.y, low.z, high.x, high.y, high.z));
    }
}

/// Coordinates [m] of the half-cell positions 0 .. 2 n along one axis: cell lengths in geometric progression.
std::vector<double> half_planes(double low, double high, int cells, double grading) {
  std::vector<double> plane(2 * cells + 1);
  double const ratio = cells > 1 ? std::pow(grading, 1.0 / (cells - 1)) : 1;
  double length = 1, sum = 0;
  std::vector<double> ends{0};
  for (int i = 0; i < cells; ++i, length *= ratio) ends.push_back(sum += length);
  for (int i = 0; i <= cells; ++i) plane[2 * i] = low + (high - low) * (ends[i] / sum);
  plane[2 * cells] = high;
  for (int i = 0; i < cells; ++i) plane[2 * i + 1] = 0.5 * (plane[2 * i] + plane[2 * i + 2]);
  return plane;
}

/// The mesh of one box, and where each of its points lies in half cells.
struct Block {
  std::vector<Vec3> points;
  std::vector<Half> half;
  std::vector<std::array<int, 4>> tets;
};

/// Numbers of the points a box uses, by half-cell position: made when first asked for.
class Numbering {
 public:
  Numbering(BoxCells const& b, Block& block_)
      : block(block_), size{2 * b.cells[0] + 1, 2 * b.cells[1] + 1, 2 * b.cells[2] + 1},
        layered(b.tets_per_cell == 24) {
    Vec3 const low = lower(b), high = upper(b);
    for (int k = 0; k < 3; ++k) planes[k] = half_planes(low[k], high[k], b.cells[k], b.grading[k]);
    std::size_t const slots = layered ? std::size_t(size[0]) * size[1] * size[2]
                                      : std::size_t(b.cells[0] + 1) * (b.cells[1] + 1) * (b.cells[2] + 1);
    numbers.assign(slots, -1);
  }
  int operator()(Half h) {
    int& n = numbers[slot(h)];
    if (n < 0) {
      n = static_cast<int>(block.points.size());
      block.points.push_back({planes[0][h[0]], planes[1][h[1]], planes[2][h[2]]});
      block.half.push_back(h);
    }
    return n;
  }

 private:
  std::size_t slot(Half h) const {
    if (layered) return (std::size_t(h[2]) * size[1] + h[1]) * size[0] + h[0];
    return (std::size_t(h[2] / 2) * (size[1] / 2 + 1) + h[1] / 2) * (size[0] / 2 + 1) + h[0] / 2;
  }
  Block& block;
  Half size;
  bool layered; ///< 24 tets per cell: also odd positions are points
  std::array<std::vector<double>, 3> planes;
  std::vector<int> numbers;
};

/// Six tets around the diagonal from the lowest to the highest corner: one per order in which the axes are
/// walked.
void cut_into_6(Half origin, Numbering& number, std::vector<std::array<int, 4>>& tets) {
  static constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}}; // three even ones, three odd ones
  for (int o = 0; o < 6; ++o) {
    Half at = origin;
    std::array<int, 4> tet{number(at), 0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      at[orders[o][k]] += 2;
      tet[k + 1] = number(at);
    }
    if (o >= 3) std::swap(tet[1], tet[2]); // odd orders turn the other way
    tets.push_back(tet);
  }
}

/// Four tets per side of the cell: an edge of the side, the side's centre, the cell's centre.
void cut_into_24(Half origin, Numbering& number, std::vector<std::array<int, 4>>& tets) {
  int const middle = number({origin[0] + 1, origin[1] + 1, origin[2] + 1});
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      int const u = (axis + 1) % 3, v = (axis + 2) % 3;
      Half centre = origin;
      centre[axis] += 2 * end, centre[u] += 1, centre[v] += 1;
      static constexpr std::array<std::array<int, 2>, 5> ring{{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}};
      for (int e = 0; e < 4; ++e) {
        auto const corner = [&](int i) {
          Half h = origin;
          h[axis] += 2 * end, h[u] += ring[i][0], h[v] += ring[i][1];
          return number(h);
        };
        // The ring turns about +axis, so on the far side (end = 1) it turns outwards as the base of a tet
        // must not.
        int const a = corner(end ? e + 1 : e), b = corner(end ? e : e + 1);
        tets.push_back({a, b, number(centre), middle});
      }
    }
}

Block make_block(BoxCells const& b) {
  Block block;
  Numbering number(b, block);
  block.tets.reserve(std::size_t(b.tets_per_cell) * b.cells[0] * b.cells[1] * b.cells[2]);
  for (int k = 0; k < b.cells[2]; ++k)
    for (int j = 0; j < b.cells[1]; ++j)
      for (int i = 0; i < b.cells[0]; ++i) {
        Half const origin{2 * i, 2 * j, 2 * k};
        if (b.tets_per_cell == 6)
          cut_into_6(origin, number, block.tets);
        else
          cut_into_24(origin, number, block.tets);
      }
  return block;
}

/// Triangles on each of the six sides of a box, as point numbers of the whole mesh, normals outwards.
using Sides = std::array<std::vector<std::array<int, 3>>, 6>;

void collect_sides(BoxCells const& b, Block const& block, std::vector<int> const& global, Sides& sides) {
  for (auto const& tet : block.tets)
    for (auto const& c : face_corners) {
      std::array<int, 3> const p{tet[c[0]], tet[c[1]], tet[c[2]]};
      for (int side = 0; side < 6; ++side) {
        int const axis = side / 2, at = side % 2 ? 2 * b.cells[axis] : 0;
        if (block.half[p[0]][axis] == at && block.half[p[1]][axis] == at && block.half[p[2]][axis] == at)
          sides[side].push_back({global[p[0]], global[p[1]], global[p[2]]});
      }
    }
}

/// Drops the triangles that two boxes of one name share: they lie inside the named body.
void drop_inner(Sides& sides) {
  std::vector<std::array<int, 3>> all;
  auto const key = [](std::array<int, 3> t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  for (auto const& side : sides)
    for (auto const& t : side) all.push_back(key(t));
  std::sort(all.begin(), all.end());
  for (auto& side : sides)
    std::erase_if(side, [&](auto const& t) {
      auto const [first, last] = std::equal_range(all.begin(), all.end(), key(t));
      return last - first > 1;
    });
}

/// For each point of all blocks the first one at its place, within each body on its own.
std::vector<int> first_at_each_place(std::vector<Block> const& blocks, std::vector<int> const& body,
                                     double tolerance) {
  std::vector<int> first;
  for (auto const& block : blocks)
    for (std::size_t i = 0; i < block.points.size(); ++i) first.push_back(static_cast<int>(first.size()));
  if (blocks.size() == 1) return first;
  for (int b = 0; b <= *std::max_element(body.begin(), body.end()); ++b) {
    std::vector<Vec3> points;
    std::vector<int> number;
    int from = 0;
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      for (std::size_t i = 0; i < blocks[n].points.size() && body[n] == b; ++i) {
        points.push_back(blocks[n].points[i]);
        number.push_back(from + static_cast<int>(i));
      }
      from += static_cast<int>(blocks[n].points.size());
    }
    auto const local = find_coincident(points, tolerance);
    for (std::size_t i = 0; i < local.size(); ++i) first[number[i]] = number[local[i]];
  }
  return first;
}

/// Numbers of the blocks' points in the whole mesh; fills mesh.points.
std::vector<std::vector<int>> merge_points(std::vector<Block> const& blocks, std::vector<int> const& body,
                                           double tolerance, Mesh& mesh) {
  std::vector<Vec3> all;
  for (auto const& block : blocks) all.insert(all.end(), block.points.begin(), block.points.end());
  auto const first = first_at_each_place(blocks, body, tolerance);
  std::vector<int> number(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (first[i] == static_cast<int>(i)) {
      number[i] = static_cast<int>(mesh.points.size());
      mesh.points.push_back(all[i]);
    } else {
      number[i] = number[first[i]];
    }
  }
  std::vector<std::vector<int>> global;
  auto from = number.begin();
  for (auto const& block : blocks) {
    global.emplace_back(from, from + block.points.size());
    from += block.points.size();
  }
  return global;
}

int group_number(std::vector<std::string>& names, std::string const& name) {
  auto const found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  names.push_back(name);
  return static_cast<int>(names.size()) - 1;
}

} // namespace

Mesh make_boxes(std::span<BoxCells const> boxes) {
  if (boxes.empty()) throw core::InputError({}, "no box to mesh");
  std::vector<Vec3> ends;
  for (auto const& b : boxes) check_numbers(b), ends.push_back(b.from), ends.push_back(b.to);
  check_total(boxes);
  double const tolerance = 1e-9 * largest_extent(ends);
  check_overlaps(boxes, tolerance);

  std::vector<Block> blocks;
  for (auto const& b : boxes) blocks.push_back(make_block(b));
  Mesh mesh;
  std::vector<std::string> names;
  std::vector<int> body;
  for (auto const& b : boxes) body.push_back(group_number(names, b.body));
  auto const global = merge_points(blocks, body, tolerance, mesh);
  std::vector<Sides> sides; // by volume group
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    int const group = group_number(mesh.volume_groups, boxes[n].name);
    sides.resize(mesh.volume_groups.size());
    collect_sides(boxes[n], blocks[n], global[n], sides[group]);
    for (auto const& t : blocks[n].tets) {
      mesh.input_id.push_back(static_cast<int>(mesh.tets.size()));
      mesh.tets.push_back({global[n][t[0]], global[n][t[1]], global[n][t[2]], global[n][t[3]]});
      mesh.tet_group.push_back(group);
      mesh.tet_body.push_back(body[n]);
    }
  }
  for (std::size_t g = 0; g < sides.size(); ++g) {
    drop_inner(sides[g]);
    for (int s = 0; s < 6; ++s)
      if (!sides[g][s].empty())
        mesh.face_groups.push_back({mesh.volume_groups[g] + "." + side_names[s], std::move(sides[g][s])});
  }
  return mesh;
}

} // namespace fissura::mesh
