#pragma once
// What damaged joints remember, side by side in lanes as packs read it.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "fissura/core/buffer.hpp"
#include "fissura/laws/cohesive.hpp"
#include "fissura/model/blocks.hpp"

namespace fissura::state {

/// Doubles and nothing else.
struct JointHistory {
  std::array<laws::CohesiveHistory, 3> point{}; ///< at the mid-edges 01, 12, 20
  std::array<laws::Separation, 3> last{};       ///< separations one step ago, once the joint is damaged
  laws::Dissipation dissipated{};               ///< [J]
  double handed_over = 0;                       ///< share of the pair's load that is left to contact, 0 ... 1
  double farthest_squared = 0;                  ///< largest squared distance between the nodes of a pair [m2]
  double time_of_failure = 0;                   ///< [s]; 0 = not failed

  static constexpr int doubles = 30;
};
static_assert(sizeof(JointHistory) == JointHistory::doubles * sizeof(double));

/// Histories of eight joints: row r holds the r-th double of each.
struct alignas(64) HistoryRows {
  std::array<std::array<double, model::block>, JointHistory::doubles> row;

  JointHistory of(std::size_t lane) const {
    std::array<double, JointHistory::doubles> column;
    for (std::size_t r = 0; r < column.size(); ++r) column[r] = row[r][lane];
    return std::bit_cast<JointHistory>(column);
  }
  void set(std::size_t lane, JointHistory const& history) {
    auto const column = std::bit_cast<std::array<double, JointHistory::doubles>>(history);
    for (std::size_t r = 0; r < column.size(); ++r) row[r][lane] = column[r];
  }
};

/// Joints come in groups: the unit of work. A group has lanes for the histories of all of its joints; a joint
/// takes one with its first damage and is nowhere before. Those at work lie from the front on without a gap,
/// released ones from the far end on.
struct JointHistories {
  static constexpr std::size_t group = 256; ///< joints

  core::Buffer<std::uint8_t> lane; ///< [joint] within its group; without meaning while it is intact
  core::Buffer<HistoryRows> rows;  ///< eight lanes each; untouched pages cost nothing

  JointHistories() = default;
  /// `joints`: padded to blocks.
  explicit JointHistories(std::size_t joints) : lane(joints), rows(joints / model::block) {}

  static std::size_t first_of(std::size_t in_group) { return in_group * group; }
  /// Of a lane of a group: the eighth of it is its row.
  static std::size_t place(std::size_t in_group, int of_lane) {
    return first_of(in_group) + static_cast<std::size_t>(of_lane);
  }
  std::size_t groups() const { return (lane.size() + group - 1) / group; }
  /// Lanes of a group.
  std::size_t room(std::size_t in_group) const { return std::min(group, lane.size() - first_of(in_group)); }

  /// Of a joint that is or has been damaged.
  JointHistory of(std::size_t joint) const {
    std::size_t const at = place_of(joint);
    return rows[at / model::block].of(at % model::block);
  }
  /// JointHistory::dissipated alone.
  laws::Dissipation dissipated(std::size_t joint) const {
    constexpr std::size_t first = offsetof(JointHistory, dissipated) / sizeof(double);
    std::size_t const at = place_of(joint), lane_of = at % model::block;
    auto const& row = rows[at / model::block].row;
    return {row[first][lane_of], row[first + 1][lane_of], row[first + 2][lane_of]};
  }
  void set(std::size_t joint, JointHistory const& history) {
    std::size_t const at = place_of(joint);
    rows[at / model::block].set(at % model::block, history);
  }

 private:
  std::size_t place_of(std::size_t joint) const { return place(joint / group, lane[joint]); }
};

} // namespace fissura::state
