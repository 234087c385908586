#pragma once
// A state in which every field has a value of its own, made through the same description as a checkpoint.
#include <array>
#include <cstdint>
#include <random>
#include <string>

#include "fissura/checkpoint/archive.hpp"
#include "fissura/model/model.hpp"

namespace fissura::checkpoint::testing {

struct Bytes : Sink {
  std::string text;
  void write(std::string_view bytes) override { text += bytes; }
};

class Randomizer {
 public:
  explicit Randomizer(unsigned seed) : random_(seed) {}
  template <class T> void fill(T& x) {
    if constexpr (std::is_same_v<T, bool>)
      x = random_() % 2 == 1;
    else if constexpr (std::is_floating_point_v<T>)
      x = std::uniform_real_distribution<T>(-1, 1)(random_);
    else if constexpr (std::is_same_v<T, long> || std::is_same_v<T, int>)
      x = static_cast<T>(random_() % 1000000);
    else if constexpr (detail::is_number<T>)
      x = static_cast<T>(random_());
    else if constexpr (requires { x.begin(); })
      for (auto& item : x) fill(item);
    else
      std::apply([&](auto&... field) { (fill(field), ...); }, detail::fields_of(x));
  }

 private:
  std::mt19937_64 random_;
};

inline state::State state_at_random(unsigned seed) {
  state::State s;
  s.u = core::NodeField(16), s.v = core::NodeField(16);
  s.joint_status = core::Buffer<std::uint8_t>(8);
  s.joint_history = state::JointHistories(8);
  s.joint_rate = core::Buffer<state::JointRate>(8);
  auto& b = s.bars;
  b.elongation.resize(5), b.element_stress.resize(5);
  b.history.resize(4), b.motion.resize(4), b.account.resize(4);
  for (auto* list : {&b.joint_stress, &b.joint_strain, &b.slip, &b.normalised_slip, &b.dowel_force})
    list->resize(4);
  s.rigid.body.resize(2), s.rigid.touch.resize(3), s.contact.pairs.resize(6);
  s.reaction.resize(2), s.prescribed_velocity.resize(2), s.held.resize(2), s.paths.resize(2);
  s.stage_start.resize(3);
  Randomizer(seed).fill(s);
  return s;
}

/// Four tets, two rigid bodies, two paths without targets, three stages: what the states at random belong to.
inline model::Model model_of_states() {
  model::Model m;
  m.tets.count = 4;
  m.rigid.resize(2), m.paths.resize(2), m.stages.resize(3);
  return m;
}

/// A state at random whose stage, joints, pairs and paths fit model_of_states().
inline state::State sound_state_at_random(unsigned seed) {
  auto s = state_at_random(seed);
  s.stage = static_cast<int>(seed % 3);
  using enum state::JointStatus;
  std::array const status = {intact, damaged, broken, released, damaged, intact, released, broken};
  std::array<std::uint8_t, 8> const lane = {9, 0, 2, 7, 3, 0, 6, 1};
  for (std::size_t j = 0; j < status.size(); ++j) {
    s.joint_status[j] = static_cast<std::uint8_t>(status[j]);
    s.joint_history.lane[j] = lane[j];
  }
  std::array<std::array<int, 2>, 6> const pairs = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  for (std::size_t i = 0; i < pairs.size(); ++i)
    s.contact.pairs[i].a = pairs[i][0], s.contact.pairs[i].b = pairs[i][1];
  for (std::size_t i = 0; i < s.rigid.touch.size(); ++i) {
    auto& t = s.rigid.touch[i];
    t.tet = static_cast<int>(i), t.face = 1, t.point = 2, t.body = 1;
  }
  for (auto& path : s.paths) path.target = 0;
  for (auto& bar : s.bars.history)
    bar.steel.rising.count = 2, bar.steel.falling.count = 1, bar.steel.direction = -1;
  return s;
}

} // namespace fissura::checkpoint::testing
