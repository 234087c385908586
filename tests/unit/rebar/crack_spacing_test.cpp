// The distance of the cracks that a bar makes, from cover and effective area of the concrete around it.
#include <gtest/gtest.h>

#include <numbers>

#include "fissura/rebar/crack_spacing.hpp"
#include "unit/rebar/rebar_case.hpp"

namespace fissura::test {
namespace {

constexpr double D = 0.016, A_s = std::numbers::pi / 4 * D * D;

model::BarSpec consistent_bar(Vec3 from, Vec3 to) {
  auto bar = bar_along({from, to}, D);
  bar.slip_reduction = model::SlipReduction::consistent;
  return bar;
}
double expected(double cover, double area) {
  return 4.0 / 3 * (cover + D * area / (7.2 * A_s));
}
double spacing(Vec3 size, std::array<int, 3> cells, std::vector<model::BarSpec> const& bars) {
  return embed(kuhn_box(cells, size), bars).bars().properties[0].crack_spacing[0];
}

// Requirement: in a tie the effective area is the section: 4/3 (c + D/(7.2 rho)), 204 mm for rho = 2 %, to
// the 3 % that 24 rays leave.
TEST(CrackSpacing, of_a_tie) {
  double const side = 0.1003, middle = side / 2;
  EXPECT_NEAR(
      spacing({1, side, side}, {10, 2, 2}, {consistent_bar({0, middle, middle}, {1, middle, middle})}),
      expected(middle - D / 2, side * side), 0.03 * expected(middle - D / 2, side * side));
}

// Requirement: in half a tie, cut along the bar, it is the same: a surface through the bar is one of
// symmetry.
TEST(CrackSpacing, of_a_tie_cut_along_its_bar) {
  double const side = 0.1003, middle = side / 2;
  double const half =
      spacing({1, middle, side}, {10, 1, 2}, {consistent_bar({0, 0, middle}, {1, 0, middle})});
  EXPECT_NEAR(half, expected(middle - D / 2, side * side), 0.05 * half);
}

// Requirement: near the face of a slab with bars every 100 mm it is 2.5 (c + D/2) deep and 100 mm wide.
TEST(CrackSpacing, of_a_slab) {
  std::vector<model::BarSpec> bars;
  for (double y : {0.2, 0.1, 0.3}) bars.push_back(consistent_bar({0, y, 0.038}, {0.6, y, 0.038}));
  double const area = 0.1 * 2.5 * 0.038, found = spacing({0.6, 0.4, 0.3}, {6, 4, 3}, bars);
  EXPECT_NEAR(found, expected(0.03, area), 0.05 * found);
}

// Requirement: far from any surface, where the rule knows nothing, and where the deck says it.
TEST(CrackSpacing, where_the_mesh_has_no_say) {
  Vec3 const from{0, 0.5, 0.5}, to{1, 0.5, 0.5};
  auto bar = consistent_bar(from, to);
  EXPECT_NEAR(spacing({1, 1, 1}, {4, 4, 4}, {bar}),
              expected(7.5 * D - D / 2, std::numbers::pi * 56.25 * D * D), 1e-3);
  bar.crack_spacing = 0.166;
  EXPECT_EQ(spacing({1, 1, 1}, {4, 4, 4}, {bar}), 0.166);
}

// Requirement: the log says which law and which length each bar uses.
TEST(CrackSpacing, is_told) {
  auto given = consistent_bar({0, 0.2, 0.2}, {1, 0.2, 0.2}),
       paper = bar_along({{0, 0.7, 0.7}, {1, 0.7, 0.7}}, D);
  given.crack_spacing = 0.166;
  paper.name = "other", paper.slip_reduction = model::SlipReduction::paper;
  paper.l_cr_from = model::CrackLength::given, paper.l_cr = 0.1;
  auto const lines = rebar::describe_slip(embed(kuhn_box({4, 4, 4}, {1, 1, 1}), {given, paper}).bars());
  EXPECT_EQ(lines, (std::vector<std::string>{"bond of bar: consistent slip reduction, crack spacing 166 mm",
                                             "bond of other: the paper's slip reduction, l_cr 100 mm"}));
}

} // namespace
} // namespace fissura::test
