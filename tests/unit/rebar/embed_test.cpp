#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rebar_case.hpp"

namespace fissura::test {
namespace {

/// The sum of the elements, their positions and the steel's mass equal what the user gave.
void expect_whole(Embedded const& e, double length, double area) {
  double sum = 0, mass = 0;
  auto const& elements = e.bars().elements;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    sum += elements[i].length;
    EXPECT_NEAR(norm(e.end_of(elements[i]) - e.start_of(elements[i])), elements[i].length, 1e-9 * length);
    if (i > 0 && elements[i].bar == elements[i - 1].bar && elements[i].copy == elements[i - 1].copy) {
      EXPECT_LT(norm(e.end_of(elements[i - 1]) - e.start_of(elements[i])), 1e-9 * length);
    }
  }
  EXPECT_NEAR(sum, length, 1e-9 * length);
  EXPECT_NEAR(e.embedding.report.length(), length, 1e-9 * length);
  std::vector<double> corner_mass(4 * e.mesh.tets.size(), 0);
  rebar::add_steel_mass(e.bars(), corner_mass);
  for (double m : corner_mass) {
    EXPECT_GE(m, 0);
    mass += m;
  }
  EXPECT_NEAR(mass, 7850 * area * length, 1e-9 * 7850 * area * length);
  EXPECT_NEAR(e.embedding.report.steel_mass(), mass, 1e-9 * mass);
}

/// Neighbouring elements in different tets have one joint between them, whose faces lead from one tet to the
/// other.
void expect_joined(Embedded const& e) {
  auto const& bars = e.bars();
  for (std::size_t i = 1; i < bars.elements.size(); ++i) {
    auto const &a = bars.elements[i - 1], &b = bars.elements[i];
    if (a.bar != b.bar || a.copy != b.copy) continue;
    EXPECT_EQ(a.joint1, b.joint0);
    EXPECT_EQ(a.tet == b.tet, a.joint1 < 0);
  }
  for (auto const& j : bars.joints) {
    ASSERT_LT(j.faces_begin, j.faces_end);
    EXPECT_NE(j.tet_a, j.tet_b);
    int tet = j.tet_a;
    for (int f = j.faces_begin; f < j.faces_end; ++f) {
      auto const& shared = e.adjacency.shared[bars.faces[f].shared_face];
      EXPECT_TRUE(shared.a.tet == tet || shared.b.tet == tet);
      tet = shared.a.tet == tet ? shared.b.tet : shared.a.tet;
      EXPECT_NEAR(bars.faces[f].weights[0] + bars.faces[f].weights[1] + bars.faces[f].weights[2], 1, 1e-12);
    }
    EXPECT_EQ(tet, j.tet_b);
  }
}

/// No element but a bar's only one is a sliver.
void expect_no_slivers(Embedded const& e) {
  for (auto const& x : e.bars().elements)
    EXPECT_GT(x.length, 0.049 * geometry::regular_edge(geometry::volume(corners(e.mesh, x.tet))));
}

double const area = std::numbers::pi * 1e-4; // of a 20 mm bar

// A bar along edges of a Kuhn mesh has one element per cell, keeps its length and mass, and warns that it
// hangs on nodes.
TEST(Embed, BarAlongMeshEdges) {
  auto const e = embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}), {bar_along({{0, 0.2, 0.2}, {1, 0.2, 0.2}})});
  expect_whole(e, 1, area);
  expect_joined(e);
  expect_no_slivers(e);
  EXPECT_EQ(e.bars().elements.size(), 10u);
  EXPECT_EQ(e.bars().joints.size(), 9u);
  for (auto const& x : e.bars().elements) EXPECT_NEAR(x.length, 0.1, 1e-4);
  ASSERT_FALSE(e.embedding.warnings.empty());
  EXPECT_NE(e.embedding.warnings[0].find("hang on one node"), std::string::npos);
}

// A bar in faces of a Kuhn mesh keeps its length and mass and has no slivers.
TEST(Embed, BarInMeshFaces) {
  auto const e = embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}), {bar_along({{0, 0.2, 0.237}, {1, 0.2, 0.237}})});
  expect_whole(e, 1, area);
  expect_joined(e);
  expect_no_slivers(e);
}

// A bar along the diagonals of cells and one along the diagonals of cell faces keep their length and mass.
TEST(Embed, BarAlongDiagonals) {
  for (Vec3 end : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}) {
    auto const e = embed(kuhn_box({5, 5, 5}, {1, 1, 1}), {bar_along({{0, 0, 0}, end})});
    expect_whole(e, norm(end), area);
    expect_joined(e);
    expect_no_slivers(e);
  }
}

// A bar that lies on an edge of the concrete (two planes of symmetry) is embedded whichever edge it is.
TEST(Embed, BarOnTheSurface) {
  for (double y : {0.0, 0.2, 0.4})
    for (double z : {0.0, 0.4}) {
      auto const e = embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}), {bar_along({{0, y, z}, {1, y, z}})});
      expect_whole(e, 1, area);
      expect_joined(e);
    }
}

// A bar that falls from the top of a long beam to its bottom, 1 in 60, is embedded from end to end, though
// any shift of it leaves the concrete early at one end.
TEST(Embed, BarFromTopToBottom) {
  for (int seed = 0; seed < 5; ++seed) {
    auto const mesh = support::random_box_mesh(static_cast<std::uint64_t>(seed), {8, 2, 2}, {6, 0.4, 0.1});
    auto const e = embed(mesh, {bar_along({{0.1, 0.2, 0.1}, {5.9, 0.25, 0}})});
    expect_whole(e, norm(Vec3{5.8, 0.05, -0.1}), area);
    expect_joined(e);
  }
}

// Bars in general position in random meshes keep their length and mass to 1e-9 and never lose a joint.
TEST(Embed, BarsInRandomMeshes) {
  for (int seed = 0; seed < 20; ++seed) {
    support::Random random(seed);
    Vec3 const a = random.vector(0.01, 0.99), b = random.vector(0.01, 0.99);
    auto const e = embed(support::random_box_mesh(seed, {5, 4, 6}), {bar_along({a, b})});
    expect_whole(e, norm(b - a), area);
    expect_joined(e);
  }
}

// A bar along a chain of edges of a random mesh keeps its length and mass to 1e-9 with one element per edge.
TEST(Embed, CurveAlongEdgesOfRandomMesh) {
  for (int seed = 0; seed < 10; ++seed) {
    auto mesh = support::random_box_mesh(seed, {6, 4, 4});
    mesh::LineGroup group{"tendon", {}};
    double length = 0;
    for (int i = 0; i < 6; ++i) { // the points of a row of cells, in the numbering of the grid they came from
      auto const place = [&](int k) {
        Vec3 const grid{k / 6.0, 0.5, 0.5};
        int best = 0;
        for (int p = 0; p < static_cast<int>(mesh.points.size()); ++p)
          if (norm(mesh.points[p] - grid) < norm(mesh.points[best] - grid)) best = p;
        return best;
      };
      int const a = place(i), b = place(i + 1);
      if (a == b) continue;
      group.segments.push_back(i % 2 == 0 ? std::array<int, 2>{a, b} : std::array<int, 2>{b, a});
      length += norm(mesh.points[b] - mesh.points[a]);
    }
    mesh.line_groups.push_back(group);
    auto bar = bar_along({});
    bar.curve = "tendon";
    auto const e = embed(mesh, {bar});
    expect_whole(e, length, area);
    expect_joined(e);
    EXPECT_LE(e.bars().elements.size(), group.segments.size() + 2) << seed;
  }
}

// A kink inside a tet makes two elements in that tet and no bar joint between them.
TEST(Embed, KinkInsideTet) {
  auto const e = embed(kuhn_box({1, 1, 1}, {1, 1, 1}),
                       {bar_along({{0.7, 0.5, 0.2}, {0.75, 0.5, 0.3}, {0.8, 0.5, 0.2}})});
  ASSERT_EQ(e.bars().elements.size(), 2u);
  EXPECT_EQ(e.bars().elements[0].tet, e.bars().elements[1].tet);
  EXPECT_TRUE(e.bars().joints.empty());
  expect_whole(e, 2 * std::hypot(0.05, 0.1), area);
}

// A closed stirrup in copies keeps every length, and its ends are joined to each other.
TEST(Embed, ClosedStirrupsInCopies) {
  auto bar = bar_along({{0.05, 0.06, 0.07}, {0.05, 0.34, 0.07}, {0.05, 0.34, 0.33}, {0.05, 0.06, 0.33}});
  bar.closed = true;
  bar.count = 9;
  bar.spacing = {0.1, 0, 0};
  auto const e = embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}), {bar});
  expect_whole(e, 9 * (2 * 0.28 + 2 * 0.26), area);
  expect_joined(e);
  int elements = 0, ends = 0;
  for (auto const& x : e.bars().elements) {
    ++elements;
    ends += (x.joint0 < 0) + (x.joint1 < 0);
  }
  // Every element end is at a joint, but for kinks inside a tet, which leave two ends each.
  EXPECT_EQ(2 * static_cast<int>(e.bars().joints.size()) + ends, 2 * elements);
  EXPECT_EQ(e.bars().properties[0].copies, 9);
  EXPECT_EQ(e.bars().elements.back().copy, 8);
}

// A bar that leaves the concrete is an error at the bar's place in the deck that gives the coordinates.
TEST(Embed, BarOutsideIsAnError) {
  try {
    embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}), {bar_along({{0.5, 0.1, 0.1}, {1.2, 0.1, 0.1}})});
    FAIL() << "no error";
  } catch (core::InputError const& error) {
    ASSERT_EQ(error.diagnostics.size(), 1u);
    EXPECT_EQ(error.diagnostics[0].place.line, 7);
    EXPECT_NE(error.diagnostics[0].message.find("(1, 0.1, 0.1)"), std::string::npos)
        << error.diagnostics[0].message;
  }
  EXPECT_THROW(embed(kuhn_box({2, 2, 2}, {1, 1, 1}), {bar_along({{3, 3, 3}, {4, 3, 3}})}), core::InputError);
}

// A hole in the concrete that a bar would cross is found even when both its ends are inside.
TEST(Embed, BarThroughGapIsAnError) {
  std::vector<mesh::BoxCells> boxes(2);
  boxes[0].to = {1, 1, 1}, boxes[1].from = {1.1, 0, 0}, boxes[1].to = {2, 1, 1};
  boxes[0].cells = boxes[1].cells = {3, 3, 3};
  EXPECT_THROW(embed(mesh::make_boxes(boxes), {bar_along({{0.1, 0.4, 0.4}, {1.9, 0.4, 0.4}})}),
               core::InputError);
}

std::string refusal(mesh::Mesh const& mesh, model::BarSpec const& bar) {
  try {
    embed(mesh, {bar});
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "";
}

// A bar that passes from one body to another that touches it without sharing a face is an error that says
// what to do: meshes that were not joined.
TEST(Embed, BarBetweenBodiesThatOnlyTouchIsAnError) {
  mesh::Mesh m;
  m.points = {{-1, 0, 0}, {0, -1, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 0}, {0, -1, -1}, {0, 1, -1}, {0, 0, 1}};
  m.tets = {{0, 1, 2, 3}, {4, 6, 5, 7}};
  for (auto& t : m.tets)
    if (geometry::volume(corners(m, static_cast<int>(&t - m.tets.data()))) < 0) std::swap(t[1], t[2]);
  m.tet_group = {0, 0}, m.volume_groups = {"concrete"}, m.input_id = {1, 2};
  EXPECT_NE(refusal(m, bar_along({{-0.3, 0, -0.2}, {0.3, 0, -0.2}}))
                .find("m between two bodies that touch but "
                      "share no faces; join their meshes"),
            std::string::npos)
      << refusal(m, bar_along({{-0.3, 0, -0.2}, {0.3, 0, -0.2}}));
}

// An unknown steel, an unknown curve and a bar without length are errors.
TEST(Embed, ImpossibleBarsAreErrors) {
  auto bar = bar_along({{0.1, 0.1, 0.1}, {0.9, 0.1, 0.1}});
  bar.steel = "wood";
  EXPECT_THROW(embed(kuhn_box({2, 2, 2}, {1, 1, 1}), {bar}), core::InputError);
  bar = bar_along({});
  bar.curve = "nowhere";
  EXPECT_THROW(embed(kuhn_box({2, 2, 2}, {1, 1, 1}), {bar}), core::InputError);
  EXPECT_THROW(embed(kuhn_box({2, 2, 2}, {1, 1, 1}), {bar_along({{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}})}),
               core::InputError);
}

// A curve of several lines is as many bars, in the order of their first segments, each with all copies; the
// lines may be closed, and the segments in any order.
TEST(Embed, SeveralLinesInOneCurve) {
  auto mesh = kuhn_box({4, 4, 4}, {1, 1, 1});
  int const n = static_cast<int>(mesh.points.size());
  for (Vec3 const p : {Vec3{0.1, 0.1, 0.1},
                       {0.5, 0.1, 0.1},
                       {0.9, 0.1, 0.1},
                       {0.2, 0.3, 0.2},
                       {0.8, 0.3, 0.2},
                       {0.5, 0.3, 0.8}})
    mesh.points.push_back(p);
  mesh.line_groups = {{"cage", {{n + 2, n + 1}, {n + 4, n + 5}, {n, n + 1}, {n + 3, n + 4}, {n + 5, n + 3}}}};
  auto bar = bar_along({});
  bar.curve = "cage", bar.count = 2, bar.spacing = {0, 0.05, 0};
  auto const e = embed(mesh, {bar});
  double const triangle = 0.6 + 2 * std::hypot(0.3, 0.6);
  expect_whole(e, 2 * (0.8 + triangle), area);
  EXPECT_EQ(e.bars().properties[0].copies, 4);
  EXPECT_EQ(e.embedding.report.bars[0].copies, 4);
  std::array<double, 4> length{};
  std::array<Vec3, 4> start{};
  for (auto const& element : e.bars().elements) {
    auto const copy = static_cast<std::size_t>(element.copy);
    if (length[copy] == 0) start[copy] = e.start_of(element);
    length[copy] += element.length;
  }
  EXPECT_NEAR(length[0], 0.8, 1e-12);
  EXPECT_NEAR(length[1], triangle, 1e-12);
  EXPECT_NEAR(length[2], 0.8, 1e-12);
  EXPECT_LT(norm(start[0] - Vec3{0.9, 0.1, 0.1}), 1e-12) << "the end that comes first";
  EXPECT_LT(norm(start[3] - Vec3{0.8, 0.35, 0.2}), 1e-12);
}

// A curve that branches or has no lines, and a bar without a section, are errors at the bar's place that say
// why.
TEST(Embed, CurvesThatAreNoLineAreErrors) {
  auto mesh = kuhn_box({2, 1, 1}, {1, 1, 1});
  auto bar = bar_along({});
  bar.curve = "tendon";
  auto const expect = [&](std::vector<std::array<int, 2>> segments, std::string const& reason) {
    mesh.line_groups = {{"tendon", std::move(segments)}};
    std::string const text = refusal(mesh, bar);
    EXPECT_NE(text.find("case.toml:7"), std::string::npos) << text;
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  expect({}, "curve 'tendon' has no segments");
  expect({{0, 1}, {1, 2}, {1, 4}}, "curve 'tendon' branches at (");
  expect({{0, 1}, {1, 2}, {1, 4}}, "put bars that meet into sets (or physical curves) of their own");
  bar.curve = "cable";
  EXPECT_NE(refusal(mesh, bar).find("the mesh has no curve 'cable' (it has: tendon)"), std::string::npos);
  EXPECT_NE(
      refusal(mesh, bar_along({{0.1, 0.1, 0.1}, {0.9, 0.1, 0.1}}, 0)).find("needs a diameter or an area"),
      std::string::npos);
}

// Tets that are bonded to each other have no bar joint between them.
TEST(Embed, BondedFacesHaveNoBarJoint) {
  auto mesh = kuhn_box({4, 2, 2}, {1, 0.5, 0.5});
  auto const adjacency = make_adjacency(mesh);
  std::vector<int> const bonded(adjacency.shared.size(), -1);
  std::vector<model::SteelSpec> const steels{table_4_steel()};
  std::vector<model::BarSpec> const bars{bar_along({{0, 0.2, 0.3}, {1, 0.2, 0.3}})};
  auto const e = rebar::embed_bars(mesh, adjacency, bars, steels, bonded);
  EXPECT_TRUE(e.bars.joints.empty());
  EXPECT_NEAR(e.report.length(), 1, 1e-9);
}

// A bar moved by a thousandth of the cell size off the edges has the same pieces to a few thousandths of a
// cell.
TEST(Embed, SmallShiftChangesLittle) {
  double const h = 0.1;
  auto const on = embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}), {bar_along({{0, 0.2, 0.2}, {1, 0.2, 0.2}})});
  for (Vec3 shift :
       {Vec3{0, 1e-3 * h, 0}, Vec3{0, -1e-3 * h, 0}, Vec3{0, 0, 1e-3 * h}, Vec3{0, -1e-3 * h, -1e-3 * h}}) {
    auto const off = embed(kuhn_box({10, 4, 4}, {1, 0.4, 0.4}),
                           {bar_along({Vec3{0, 0.2, 0.2} + shift, Vec3{1, 0.2, 0.2} + shift})});
    ASSERT_EQ(off.bars().elements.size(), on.bars().elements.size());
    for (std::size_t i = 0; i < on.bars().elements.size(); ++i)
      EXPECT_NEAR(off.bars().elements[i].length, on.bars().elements[i].length, 5e-3 * h);
  }
}

// Long elements on a thin bar are warned of: l_cr > 10 D and h > 20 D.
TEST(Embed, WarnsOfCoarseMesh) {
  auto const e = embed(kuhn_box({2, 2, 2}, {1, 1, 1}), {bar_along({{0, 0.2, 0.3}, {1, 0.2, 0.3}}, 0.008)});
  int found = 0;
  for (auto const& w : e.embedding.warnings)
    found += (w.find("10 D") != std::string::npos) + (w.find("20 D") != std::string::npos);
  EXPECT_EQ(found, 2);
}

// The automatic crack lengths of a bar sum, twice over, to the bar less half its two end elements.
TEST(Embed, CrackLengthsSumToTheBar) {
  auto const e =
      embed(support::random_box_mesh(3, {6, 4, 4}), {bar_along({{0, 0.31, 0.42}, {1, 0.37, 0.55}})});
  double sum = 0;
  for (auto const& j : e.bars().joints) sum += 2 * rebar::crack_length(e.bars().properties[0], j);
  auto const& x = e.bars().elements;
  EXPECT_NEAR(sum, e.embedding.report.length() - 0.5 * (x.front().length + x.back().length), 1e-12);
}

} // namespace
} // namespace fissura::test
