#include "fissura/contact/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fissura/parallel/parallel.hpp"

namespace fissura::contact {

namespace {

using Pairs = std::vector<std::pair<int, int>>;
constexpr std::size_t boxes_per_chunk = 1024;

constexpr double inf = std::numeric_limits<double>::infinity();

/// A box with a number that is none counts as without end: it meets nobody, and is kept out of the grid.
double extent(Box const& b) {
  Vec3 const size = b.high - b.low;
  return size.x >= 0 && size.y >= 0 && size.z >= 0 ? std::max({size.x, size.y, size.z}) : inf;
}

/// A box by the cell of its centre; sorted by cell, then by number.
struct Entry {
  std::uint64_t cell;
  int box;
  bool operator<(Entry const& e) const { return cell != e.cell ? cell < e.cell : box < e.box; }
};

/// Cells are numbered along x first, so the three cells around one in x are a range. Numbers end at 2^20
/// along each axis: what is farther away shares the last cell.
class Cells {
 public:
  Cells(Vec3 origin, double size) : origin_(origin), size_(size) {}

  std::uint64_t of(Box const& b) const {
    std::uint64_t key = 0;
    for (int r = 2; r >= 0; --r) {
      double const i = std::floor((0.5 * (b.low[r] + b.high[r]) - origin_[r]) / size_);
      double const held =
          i > 0 ? std::min(i, 1048574.0) : 0; // what is no number too: a run that is about to be stopped
      key = (key << 21) | static_cast<std::uint64_t>(held + 1);
    }
    return key;
  }

 private:
  Vec3 origin_;
  double size_;
};

/// The cells from `low` to `high` relative to a cell: half of its neighbourhood, so each pair is met once.
struct Row {
  std::int64_t low, high;
};
constexpr std::int64_t row_y = std::int64_t{1} << 21, row_z = std::int64_t{1} << 42;
constexpr Row rows[] = {{1, 1}, // the rest of its own cell comes first
                        {row_y - 1, row_y + 1},
                        {row_z - row_y - 1, row_z - row_y + 1},
                        {row_z - 1, row_z + 1},
                        {row_z + row_y - 1, row_z + row_y + 1}};

void add_if_meeting(std::vector<Box> const& boxes, int a, int b, Pairs& pairs) {
  if (meet(boxes[a], boxes[b])) pairs.push_back(std::minmax(a, b));
}

/// Pairs of the entries [begin, end) with what follows them in the half neighbourhood.
void search(std::vector<Box> const& boxes, std::vector<Entry> const& entries, std::size_t begin,
            std::size_t end, Pairs& pairs) {
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t j = i + 1; j < entries.size() && entries[j].cell == entries[i].cell; ++j)
      add_if_meeting(boxes, entries[i].box, entries[j].box, pairs);
  for (Row const row : rows) {
    auto from = entries.begin();
    for (std::size_t i = begin; i < end; ++i) { // `from` only moves on: the cells ascend
      std::uint64_t const low = entries[i].cell + static_cast<std::uint64_t>(row.low),
                          high = entries[i].cell + static_cast<std::uint64_t>(row.high);
      if (i == begin) from = std::lower_bound(entries.begin(), entries.end(), Entry{low, -1});
      while (from != entries.end() && from->cell < low) ++from;
      for (auto j = from; j != entries.end() && j->cell <= high; ++j)
        add_if_meeting(boxes, entries[i].box, j->box, pairs);
    }
  }
}

/// Cell size for the many: all but the few largest boxes fit.
double cell_size(std::vector<Box> const& boxes) {
  std::vector<double> size(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) size[i] = extent(boxes[i]);
  auto const most = size.begin() + static_cast<std::ptrdiff_t>(size.size() * 9 / 10);
  std::nth_element(size.begin(), most, size.end());
  return 2 * *most;
}

} // namespace

std::vector<std::pair<int, int>> meeting_boxes(std::vector<Box> const& boxes) {
  if (boxes.size() < 2) return {};
  double const size = cell_size(boxes);
  Vec3 origin{inf, inf, inf};
  for (auto const& b : boxes)
    for (int r = 0; r < 3; ++r) origin[r] = std::min(origin[r], b.low[r]);
  Cells const cells(origin, size);
  std::vector<Entry> entries;
  std::vector<int> large;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    if (extent(boxes[i]) <= size)
      entries.push_back({cells.of(boxes[i]), i});
    else
      large.push_back(i);
  std::sort(entries.begin(), entries.end());

  std::vector<Pairs> found(parallel::chunks(entries.size(), boxes_per_chunk));
  parallel::for_chunks(entries.size(), boxes_per_chunk,
                       [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                         search(boxes, entries, begin, end, found[chunk]);
                       });
  Pairs all;
  for (auto const& f : found) all.insert(all.end(), f.begin(), f.end());
  for (std::size_t l = 0; l < large.size(); ++l) {
    for (auto const& e : entries) add_if_meeting(boxes, large[l], e.box, all);
    for (std::size_t k = l + 1; k < large.size(); ++k) add_if_meeting(boxes, large[l], large[k], all);
  }
  std::sort(all.begin(), all.end());
  return all;
}

} // namespace fissura::contact
