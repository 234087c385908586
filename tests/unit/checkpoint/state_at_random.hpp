#pragma once
// A state in which every field has a value of its own, made through the same description as a checkpoint.
#include <random>
#include <string>

#include "fissura/checkpoint/archive.hpp"

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
  s.u = core::Buffer<double>(64), s.v = core::Buffer<double>(64);
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

} // namespace fissura::checkpoint::testing
