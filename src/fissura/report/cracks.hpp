#pragma once
// Cracked joints over the frames of a run, and the table of cracks made from them.
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fissura/core/hash.hpp"
#include "fissura/output/read_frame.hpp"

namespace fissura::report {

/// A joint with this much damage (mean over its points) or more counts as a crack in pictures and tables.
inline constexpr float shown_damage = 0.2F;

/// Faces further apart than this share of the mean edge of their triangle are room between pieces, not a
/// crack.
inline constexpr double gap_opening = 0.5;

/// What one frame says about the joints, in the order of Cracks::joints.
struct CrackFrame {
  std::vector<float> opening, sliding, damage; ///< [m], [m], [-]; 0 for joints not yet damaged
  std::vector<float> displacement;             ///< 9 per joint [m]
};

class Cracks {
 public:
  /// Takes in the next frame; frames follow each other in time.
  void take(output::FrameFile const& frame);
  /// Call once after the last frame: leaves only joints that were ever shown, in the order of their first
  /// appearance, so that the joints shown in a frame are the first few.
  void finish();

  std::vector<CrackFrame> frames;
  std::vector<std::uint32_t> shown;   ///< per frame: how many joints are shown
  std::vector<float> points;          ///< 9 per joint: its three corners in the undeformed body [m]
  std::vector<std::uint8_t> mode;     ///< per joint: 1 opening, 2 sliding, 3 mixed, 0 none yet (last frame)
  std::vector<float> time_of_failure; ///< per joint: [s], 0 while it holds (last frame)
  std::size_t size() const { return mode.size(); }

 private:
  using Key = std::array<float, 9>;
  struct Hash {
    std::size_t operator()(Key const& k) const {
      return static_cast<std::size_t>(core::hash_bytes(k.data(), sizeof k, 0));
    }
  };
  std::unordered_map<Key, std::size_t, Hash> number_;
};

/// A line of the table: the widest place of a crack.
struct CrackRow {
  std::array<double, 3> place{}; ///< in the undeformed body [m]
  double now = 0, sliding = 0;   ///< in the last frame [m]
  double largest = 0;            ///< over all frames [m]
  double time_of_largest = 0;    ///< [s]
  double time_of_failure = 0;    ///< [s], 0 while it holds
  int mode = 0;
};

/// Places by falling largest opening; a place nearer than `distance` [m] to a wider one belongs to the crack
/// of that one. `times`: of the frames [s].
std::vector<CrackRow> crack_table(Cracks const& cracks, std::vector<double> const& times, double distance,
                                  std::size_t rows);

} // namespace fissura::report
