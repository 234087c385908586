#include "fissura/rebar/merge_short.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace fissura::rebar {

namespace {

/// The chain as a doubly linked list, with the short pieces in order of length.
class Slivers {
 public:
  Slivers(mesh::Mesh const& mesh, Chain const& chain) : pieces_(chain.pieces), crossed_(chain.crossed) {
    int const n = static_cast<int>(pieces_.size());
    for (int i = 0; i < n; ++i) {
      before_.push_back(i - 1);
      after_.push_back(i + 1 < n ? i + 1 : -1);
      limit_.push_back(shortest_piece * cell_size(mesh, pieces_[i].tet));
    }
    head_ = std::move(crossed_.front());
    crossed_.front().clear();
    left_ = n;
    for (int i = 0; i < n; ++i) note(i);
  }

  void drop_all() {
    while (!short_.empty() && left_ > 1) drop(std::get<1>(*short_.begin()));
  }

  Chain result() const {
    Chain out;
    for (int i = first_; i >= 0; i = after_[i]) {
      out.pieces.push_back(pieces_[i]);
      out.crossed.push_back(crossed_[i]);
    }
    out.crossed.front() = tail_;
    out.crossed.front().insert(out.crossed.front().end(), head_.begin(), head_.end());
    return out;
  }

 private:
  void note(int i) {
    if (pieces_[i].length() < limit_[i]) short_.insert({pieces_[i].length(), i});
  }
  void forget(int i) { short_.erase({pieces_[i].length(), i}); }

  /// Unlinks piece i; the faces before it come to lie before the next piece.
  void unlink(int i) {
    forget(i);
    int const a = before_[i], b = after_[i];
    if (a >= 0) after_[a] = b;
    if (b >= 0) before_[b] = a;
    if (i == first_) {
      first_ = b;
      head_.insert(head_.end(), crossed_[b].begin(), crossed_[b].end());
      crossed_[b].clear();
    } else if (b >= 0) {
      crossed_[b].insert(crossed_[b].begin(), crossed_[i].begin(), crossed_[i].end());
    } else {
      tail_.insert(tail_.begin(), crossed_[i].begin(), crossed_[i].end());
    }
    --left_;
  }

  void drop(int i) {
    int const a = before_[i], b = after_[i];
    double const middle = a < 0   ? pieces_[i].begin
                          : b < 0 ? pieces_[i].end
                                  : 0.5 * (pieces_[i].begin + pieces_[i].end);
    unlink(i);
    for (int k : {a, b})
      if (k >= 0) forget(k);
    if (a >= 0) pieces_[a].end = middle;
    if (b >= 0) pieces_[b].begin = middle;
    for (int k : {a, b})
      if (k >= 0) note(k);
    if (a >= 0 && b >= 0 && pieces_[a].tet == pieces_[b].tet) join(a, b);
  }

  /// Two neighbours in one tet are one piece: the faces between them were crossed forth and back.
  void join(int a, int b) {
    forget(a), forget(b);
    pieces_[a].end = pieces_[b].end;
    int const c = after_[b];
    after_[a] = c;
    if (c >= 0) before_[c] = a;
    --left_;
    note(a);
  }

  std::vector<Piece> pieces_;
  std::vector<std::vector<Crossed>> crossed_;
  std::vector<Crossed> tail_,
      head_; // faces between the last piece left and the end of the bar, and on to the first
  std::vector<int> before_, after_;
  std::vector<double> limit_;
  std::set<std::tuple<double, int>> short_;
  int left_ = 0, first_ = 0;
};

/// Removes faces that occur an even number of times.
void cancel_pairs(std::vector<Crossed>& faces) {
  std::vector<Crossed> kept;
  for (auto const& f : faces) {
    auto const same = [&](Crossed const& g) { return g.shared_face == f.shared_face; };
    auto const it = std::find_if(kept.begin(), kept.end(), same);
    if (it == kept.end()) {
      kept.push_back(f);
    } else {
      kept.erase(it);
    }
  }
  faces = kept;
}

} // namespace

Chain merge_short(mesh::Mesh const& mesh, Chain const& chain) {
  Slivers slivers(mesh, chain);
  slivers.drop_all();
  Chain out = slivers.result();
  for (auto& faces : out.crossed) cancel_pairs(faces);
  return out;
}

void snap_to_kinks(mesh::Mesh const& mesh, Polyline const& line, Chain& chain) {
  for (std::size_t i = 1; i < chain.pieces.size(); ++i) {
    Piece &a = chain.pieces[i - 1], &b = chain.pieces[i];
    double const size_a = shortest_piece * cell_size(mesh, a.tet),
                 size_b = shortest_piece * cell_size(mesh, b.tet);
    for (int k = 1; k < line.segments(); ++k) {
      double const s = line.arc[k];
      if (std::abs(s - a.end) > std::min(size_a, size_b)) continue;
      if (s - a.begin < size_a || b.end - s < size_b) continue;
      a.end = b.begin = s;
      break;
    }
  }
}

} // namespace fissura::rebar
