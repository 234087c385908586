#pragma once
// Constants that most blocks have in common: a block of 8 lanes refers to a set of rows, and blocks with the
// same values share it. So material constants stay in the cache instead of being read for every tet.
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "fissura/core/buffer.hpp"

namespace fissura::model {

template <int components, int lanes> class SharedRows {
 public:
  using Rows = std::array<double, static_cast<std::size_t>(components) * lanes>;

  SharedRows() = default;
  /// values(item) gives the `components` numbers of each of the `padded` items (a multiple of `lanes`).
  template <class Values> SharedRows(std::size_t padded, Values const& values) {
    std::map<Rows, std::uint32_t> known;
    std::vector<Rows> sets;
    set_of_block_ = core::Buffer<std::uint32_t>(padded / lanes);
    for (std::size_t b = 0; b < padded / lanes; ++b) {
      Rows rows;
      for (std::size_t i = 0; i < lanes; ++i) {
        std::array<double, components> const v = values(b * lanes + i);
        for (std::size_t c = 0; c < components; ++c) rows[c * lanes + i] = v[c];
      }
      // Neighbours are mostly alike.
      if (b == 0 || rows != sets[set_of_block_[b - 1]]) {
        auto const [at, is_new] = known.try_emplace(rows, static_cast<std::uint32_t>(sets.size()));
        if (is_new) sets.push_back(rows);
        set_of_block_[b] = at->second;
      } else {
        set_of_block_[b] = set_of_block_[b - 1];
      }
    }
    rows_ = core::Buffer<double>(sets.size() * Rows{}.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] = sets[i / Rows{}.size()][i % Rows{}.size()];
  }

  /// Row `component` of a block starts at of_block(b) + component * lanes.
  double const* of_block(std::size_t b) const { return rows_.data() + set_of_block_[b] * Rows{}.size(); }
  double operator()(std::size_t item, int component) const {
    return of_block(item / lanes)[static_cast<std::size_t>(component) * lanes + item % lanes];
  }

 private:
  core::Buffer<double> rows_;                ///< [set][component][lane]
  core::Buffer<std::uint32_t> set_of_block_; ///< per block
};

} // namespace fissura::model
