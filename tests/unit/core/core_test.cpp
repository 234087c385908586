#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "fissura/core/buffer.hpp"
#include "fissura/core/ensure.hpp"
#include "fissura/core/error.hpp"
#include "fissura/core/finite.hpp"
#include "fissura/core/hash.hpp"
#include "fissura/core/pack.hpp"
#include "fissura/core/vec3.hpp"

namespace fissura::core {
namespace {

// Requirement: a place reads file:line:column with the unknown parts left out.
TEST(Place, reads_file_line_column) {
  EXPECT_EQ(to_string(Place{"case.toml", 12, 3}), "case.toml:12:3");
  EXPECT_EQ(to_string(Place{"case.toml", 12, 0}), "case.toml:12");
  EXPECT_EQ(to_string(Place{"mesh.msh", 0, 0}), "mesh.msh");
}

// Requirement: an InputError carries every finding, its text names each place, and its failure is "bad
// input".
TEST(InputError, names_every_finding) {
  InputError const e({{{"a.toml", 1, 2}, "no such key"}, {{"a.toml", 9, 1}, "must be positive"}});
  std::string const text = e.what();
  EXPECT_NE(text.find("a.toml:1:2"), std::string::npos);
  EXPECT_NE(text.find("no such key"), std::string::npos);
  EXPECT_NE(text.find("a.toml:9:1"), std::string::npos);
  EXPECT_NE(text.find("must be positive"), std::string::npos);
  EXPECT_EQ(e.failure, Failure::input);
  EXPECT_EQ(e.diagnostics.size(), 2u);
  EXPECT_EQ(InputError(Place{"a", 1, 1}, "x").diagnostics.size(), 1u);
}

// Requirement: what the program must be able to rely on and cannot ends the run as an internal error, in
// words.
TEST(Ensure, names_an_internal_error) {
  EXPECT_NO_THROW(ensure(true, "all is well"));
  try {
    ensure(false, "the page has no title");
    FAIL();
  } catch (Error const& e) {
    EXPECT_EQ(e.failure, Failure::run);
    EXPECT_STREQ(e.what(), "internal error: the page has no title");
  }
}

// Requirement: the finite test knows infinities and NaN by their bits.
TEST(Finite, knows_infinities_and_nan) {
  using limits = std::numeric_limits<double>;
  for (double const x : {0.0, -0.0, 1.0, limits::max(), -limits::max(), limits::min(), limits::denorm_min()})
    EXPECT_TRUE(is_finite(x)) << x;
  for (double const x : {limits::infinity(), -limits::infinity(), limits::quiet_NaN(), -limits::quiet_NaN()})
    EXPECT_FALSE(is_finite(x)) << x;
}

// Requirement: a buffer starts zeroed, on a cache line, and moving it moves its contents.
TEST(Buffer, is_zeroed_aligned_and_movable) {
  Buffer<double> a(1000);
  ASSERT_EQ(a.size(), 1000u);
  EXPECT_TRUE(std::all_of(a.begin(), a.end(), [](double x) { return x == 0; }));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % 64, 0u);
  a[7] = 3;
  Buffer<double> b(std::move(a));
  EXPECT_EQ(b[7], 3);
  EXPECT_EQ(b.size(), 1000u);
  Buffer<double> c;
  EXPECT_TRUE(c.empty());
  c = std::move(b);
  EXPECT_EQ(c.span()[7], 3);
}

// Requirement: successive buffers start at different offsets within a page.
TEST(Buffer, spreads_over_the_page) {
  Buffer<double> a(4096), b(4096), c(4096);
  auto offset = [](Buffer<double> const& x) { return reinterpret_cast<std::uintptr_t>(x.data()) % 4096; };
  EXPECT_NE(offset(a), offset(b));
  EXPECT_NE(offset(b), offset(c));
  EXPECT_NE(offset(a), offset(c));
}

// Requirement: the fingerprint depends on every byte and on the seed, and on nothing else.
TEST(Hash, depends_on_bytes_and_seed) {
  double a[3] = {1, 2, 3}, b[3] = {1, 2, 3};
  EXPECT_EQ(hash_bytes(a, sizeof a, 5), hash_bytes(b, sizeof b, 5));
  EXPECT_NE(hash_bytes(a, sizeof a, 5), hash_bytes(b, sizeof b, 6));
  b[2] = 3.0000000000000004;
  EXPECT_NE(hash_bytes(a, sizeof a, 5), hash_bytes(b, sizeof b, 5));
}

// Requirement: inverse, cofactor, transpose and contraction are those of linear algebra.
TEST(Matrix, obeys_linear_algebra) {
  Mat3 const a{{Vec3{2, -1, 0.5}, Vec3{0.3, 3, -2}, Vec3{1, 0.7, 1.5}}};
  Mat3 const one = a * inverse(a);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(one[i][j], i == j, 1e-15);
  EXPECT_NEAR(contract(a, cofactor(a)), 3 * determinant(a), 1e-13);
  EXPECT_EQ(transpose(a)[0][2], a[2][0]);
  Vec3 const v{1, 2, 3}, w{-2, 0.5, 1};
  EXPECT_NEAR(dot(a * v, w), dot(v, transpose(a) * w), 1e-14);
  EXPECT_NEAR(dot(cross(v, w), v), 0, 1e-15);
  EXPECT_NEAR(norm(unit(v)), 1, 1e-15);
  EXPECT_EQ(unit(Vec3{}), Vec3{});
}

/// 0, 1, 2, ...
std::vector<double> counted(std::size_t size) {
  std::vector<double> all(size);
  std::iota(all.begin(), all.end(), 0.0);
  return all;
}

// Requirement: vectors are loaded from where they lie scattered, lane by lane.
TEST(Pack, loads_vectors) {
  auto const nodes = counted(3 * 64 + 1);
  int index[8];
  for (int i = 0; i < 8; ++i) index[i] = 3 * ((i * 13 + 5) % 64);
  auto const v = load_vectors<Pack>(nodes.data(), index);
  for (int i = 0; i < lanes<Pack>; ++i) {
    EXPECT_EQ(v.x[i], index[i]);
    EXPECT_EQ(v.y[i], index[i] + 1);
    EXPECT_EQ(v.z[i], index[i] + 2);
  }
}

// Requirement: three vectors per lane fill nine numbers each and touch none beside them.
TEST(Pack, stores_three_vectors) {
  Vec<Pack> v[3];
  for (int k = 0; k < 3; ++k)
    v[k] = {Pack([k](int i) { return 100 * i + 3.0 * k; }),
            Pack([k](int i) { return 100 * i + 3.0 * k + 1; }),
            Pack([k](int i) { return 100 * i + 3.0 * k + 2; })};
  std::vector<double> out(16 * 8, -1);
  int index[8];
  for (int i = 0; i < 8; ++i) index[i] = 16 * ((5 * i + 3) % 8) + 2;
  store_three<Pack>(out.data(), index, v);
  for (int i = 0; i < lanes<Pack>; ++i) {
    double const* const own = out.data() + index[i];
    for (int k = 0; k < 9; ++k) EXPECT_EQ(own[k], 100 * i + k);
    EXPECT_EQ(own[-1], -1);
    EXPECT_EQ(own[9], -1);
  }
}

// Requirement: the nodes of tets that follow each other are loaded corner by corner, and stored where they
// came from.
TEST(Pack, loads_and_stores_tets) {
  constexpr std::size_t n = 12 * lanes<Pack>;
  auto const tets = counted(n);
  Vec<Pack> node[4];
  load_tets<Pack>(tets.data(), node);
  for (int i = 0; i < lanes<Pack>; ++i)
    for (int a = 0; a < 4; ++a) {
      EXPECT_EQ(node[a].x[i], 12 * i + 3 * a);
      EXPECT_EQ(node[a].y[i], 12 * i + 3 * a + 1);
      EXPECT_EQ(node[a].z[i], 12 * i + 3 * a + 2);
    }
  std::vector<double> out(n, -1);
  store_tets<Pack>(out.data(), node);
  EXPECT_EQ(out, tets);
}

// Requirement: choosing by a mask gives each lane its own branch, for packs and for plain numbers.
TEST(Pack, chooses_lane_by_lane) {
  Pack a([](int i) { return i + 1.0; }), b(-1.0);
  Pack const c = choose(a > Pack(1.5), a, b);
  for (int i = 0; i < lanes<Pack>; ++i) EXPECT_EQ(c[i], i + 1.0 > 1.5 ? i + 1.0 : -1.0);
  EXPECT_TRUE(any(a > Pack(0.5)));
  EXPECT_FALSE(any(a > Pack(100.0)));
  EXPECT_EQ(choose(2.0 > 1.0, 3.0, 4.0), 3.0);
  EXPECT_EQ(choose(false, 3.0, 4.0), 4.0);
}

} // namespace
} // namespace fissura::core
