// How large a model may be.
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/model/make_blocks.hpp"
#include "support/refusal.hpp"

namespace fissura::model {
namespace {

std::string refusal(auto const& action) {
  return support::refusal(core::Failure::input, action);
}

// Requirement: more tets than the numbers of their nodes can count are refused before they are made.
TEST(Limits, of_tets) {
  std::size_t const most = 134217727;
  EXPECT_EQ(refusal([&] { check_tet_count(most); }), "accepted");
  EXPECT_EQ(refusal([&] { check_tet_count(most + 1); }),
            "more than 134 million tets: the node numbers would overflow");
}

// Requirement: 65,536 kinds of joints can be told apart; one more is refused, joints of a known kind are not.
TEST(Limits, of_kinds_of_joints) {
  laws::CohesiveInput in;
  in.p = 6e11, in.h = 0.1, in.f_t = 3e6, in.G_f = 100, in.cohesion = 5e6, in.friction_angle = 0.6;
  auto const law = laws::make_cohesive_params(in);
  JointBlocks joints;
  joints.kinds.resize(0xffff); // of no strength; the next is the last
  joints.add({}, law);
  joints.add({}, law);
  EXPECT_EQ(joints.kind.back(), 0xffff);
  in.f_t = 2e6;
  EXPECT_EQ(refusal([&] { joints.add({}, laws::make_cohesive_params(in)); }),
            "more than 65,536 kinds of joints (regions times concretes)");
}

} // namespace
} // namespace fissura::model
