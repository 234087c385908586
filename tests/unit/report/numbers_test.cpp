// What goes into the page: packing, body, cracks, bars.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <zlib.h>

#include "fissura/core/error.hpp"
#include "fissura/report/bars.hpp"
#include "fissura/report/blob.hpp"
#include "fissura/report/body.hpp"
#include "fissura/report/cracks.hpp"
#include "fissura/report/history_numbers.hpp"
#include "fissura/report/page.hpp"
#include "fissura/report/report.hpp"
#include "fissura/report/scene.hpp"
#include "support/refusal.hpp"
#include "unit/report/support.hpp"

namespace fissura::report {
namespace {

using output::FrameFile;
using testing::TemporaryFolder;

FrameFile file_of(TemporaryFolder const& t, output::Grid const& g) {
  output::write_vtu(t / "grid.vtu", g);
  return FrameFile(t / "grid.vtu");
}

FrameFile bars_of(TemporaryFolder const& t, output::Grid const& g) {
  output::write_vtp(t / "bars.vtp", g);
  return FrameFile(t / "bars.vtp");
}

std::string bytes_of(std::string const& base64_text) {
  std::string out;
  unsigned bits = 0, count = 0;
  for (char const c : base64_text) {
    char const* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char const* at = std::strchr(letters, c);
    if (c == '=' || at == nullptr) break;
    bits = bits << 6 | static_cast<unsigned>(at - letters), count += 6;
    if (count >= 8) count -= 8, out += static_cast<char>(bits >> count & 255);
  }
  return out;
}

// Requirement: base64 is that of RFC 4648, whose test vectors these are.
TEST(Blob, WritesBase64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

// Requirement: the text unpacks to the header's length, the header and the arrays at the offsets it names.
TEST(Blob, UnpacksToItsLayout) {
  Blob blob;
  blob.meta["title"] = "a \"quoted\" </script> title";
  std::vector<std::uint8_t> const small{7};
  std::vector<float> const values{1.5F, -2.5F};
  blob.add("small", std::span<std::uint8_t const>(small));
  blob.add("values", std::span<float const>(values));
  std::string const packed = bytes_of(blob.text());
  std::string all(10000, '\0');
  uLongf size = all.size();
  ASSERT_EQ(::uncompress(reinterpret_cast<Bytef*>(all.data()), &size,
                         reinterpret_cast<Bytef const*>(packed.data()), packed.size()),
            Z_OK);
  std::uint32_t length = 0;
  std::memcpy(&length, all.data(), 4);
  auto const head = output::Json::parse(all.substr(4, length));
  EXPECT_EQ(head["meta"]["title"], "a \"quoted\" </script> title");
  std::size_t const start = (4 + length + 7) / 8 * 8 + head["arrays"]["values"][1].get<std::size_t>();
  EXPECT_EQ(start % 8, 0u);
  float second = 0;
  std::memcpy(&second, all.data() + start + 4, 4);
  EXPECT_EQ(second, -2.5F);
  EXPECT_EQ(head["arrays"]["values"][2], 2);
}

// Requirement: quantising keeps values to the largest over 65534, and takes what is not finite for 0.
TEST(Blob, QuantisesToAShareOfTheLargest) {
  Blob blob;
  std::vector<float> const values{0, 1e-3F, -2e-3F, std::numeric_limits<float>::infinity()};
  EXPECT_NEAR(blob.add_quantised("u", std::span<float const>(values)), 2e-3 / 32767, 1e-12);
  std::vector<float> const zeros(3, 0);
  EXPECT_EQ(blob.add_quantised("zero", std::span<float const>(zeros)), 0);
}

// Requirement: two tets that share a face show six outer faces, and eight once they are fragments.
TEST(Body, ShowsOuterFacesAndThoseBetweenFragments) {
  TemporaryFolder const t;
  auto const whole = file_of(t, testing::two_tets(false));
  Body const together = find_body(whole, whole);
  EXPECT_EQ(together.tet.size(), 6u);
  EXPECT_EQ(together.low[0], -1);
  EXPECT_EQ(together.high[2], 1);
  auto const parted = file_of(t, testing::two_tets(true));
  Body const apart = find_body(whole, parted);
  EXPECT_EQ(apart.tet.size(), 8u);
  Appearance appearance(apart, 2);
  appearance.take(apart, whole, 0);
  appearance.take(apart, parted, 1);
  EXPECT_EQ(std::count(appearance.first().begin(), appearance.first().end(), 1), 2);
}

// Requirement: outer faces are counter-clockwise seen from outside.
TEST(Body, TurnsFacesOutwards) {
  TemporaryFolder const t;
  auto const file = file_of(t, testing::two_tets(false));
  Body const b = find_body(file, file);
  for (std::size_t i = 0; i < b.tet.size(); ++i) {
    auto const point = [&](std::size_t k) {
      float const* p = &b.points[3 * b.triangles[3 * i + k]];
      return Vec3{p[0], p[1], p[2]};
    };
    Vec3 const inside{b.tet[i] == 0 ? 0.25 : -0.25, 0.25, 0.25};
    EXPECT_GT(dot(cross(point(1) - point(0), point(2) - point(0)), point(0) - inside), 0);
  }
}

// Requirement: joints come in the order of their first appearance, and only those that were ever shown.
TEST(Cracks, OrdersJointsByAppearance) {
  TemporaryFolder const t;
  Cracks c;
  c.take(file_of(t, testing::joints({}, {}, 0)));
  c.take(file_of(t, testing::joints({0.5}, {1e-4F}, 0.9F)));
  c.take(file_of(t, testing::joints({0, 0.5}, {3e-4F, 2e-4F}, 0.9F)));
  auto hairline = testing::joints({0, 0.5, 0.9}, {4e-4F, 1e-4F, 1e-6F}, 0.9F);
  std::get<std::vector<float>>(hairline.cell_data[2].values)[2] = 0.05F;
  c.take(file_of(t, hairline));
  c.finish();
  EXPECT_EQ(c.size(), 2u);
  EXPECT_EQ(c.shown, (std::vector<std::uint32_t>{0, 1, 2, 2}));
  EXPECT_NEAR(c.points[2], 0.5, 1e-6); // the first to appear
  EXPECT_NEAR(c.frames[3].opening[1], 4e-4, 1e-9);
}

// Requirement: the table has the widest places first, with their largest opening, its time and the one now,
// and leaves out what lies near a wider place.
TEST(Cracks, TableNamesTheWidestPlaces) {
  TemporaryFolder const t;
  Cracks c;
  c.take(file_of(t, testing::joints({0, 0.05, 0.5}, {1e-4F, 9e-5F, 8e-4F}, 0.9F)));
  c.take(file_of(t, testing::joints({0, 0.05, 0.5}, {2e-4F, 9e-5F, 1e-4F}, 0.9F)));
  c.finish();
  auto const table = crack_table(c, {0.01, 0.02}, 0.2, 10);
  ASSERT_EQ(table.size(), 2u);
  EXPECT_NEAR(table[0].place[2], 0.51, 1e-6);
  EXPECT_NEAR(table[0].largest, 8e-4, 1e-9);
  EXPECT_NEAR(table[0].now, 1e-4, 1e-9);
  EXPECT_DOUBLE_EQ(table[0].time_of_largest, 0.01);
  EXPECT_NEAR(table[1].largest, 2e-4, 1e-9);
  EXPECT_EQ(crack_table(c, {0.01, 0.02}, 0.01, 2).size(), 2u);
}

// Requirement: faces that have flown apart are no crack: the table leaves them out.
TEST(Cracks, TableLeavesOutRoomBetweenPieces) {
  TemporaryFolder const t;
  Cracks c;
  c.take(file_of(t, testing::joints({0, 0.5}, {1e-4F, 9.0F}, 0.9F)));
  c.finish();
  auto const table = crack_table(c, {0.01}, 0.2, 10);
  ASSERT_EQ(table.size(), 1u);
  EXPECT_NEAR(table[0].largest, 1e-4, 1e-9);
}

// Requirement: places along a bar are lengths from its first end, for elements and joints alike.
TEST(Bars, MeasuresAlongTheBar) {
  TemporaryFolder const t;
  Bars b;
  b.take(bars_of(t, testing::one_bar(1e8F)));
  ASSERT_EQ(b.along.size(), 2u);
  EXPECT_NEAR(b.along[0], 0.2, 1e-6);
  EXPECT_NEAR(b.along[1], 0.65, 1e-6);
  ASSERT_EQ(b.joint_along.size(), 1u); // told at both of its sides, and counted once
  EXPECT_NEAR(b.joint_along[0], 0.4, 1e-6);
  EXPECT_EQ(b.joint_state[0], 1);
  EXPECT_NEAR(b.frames[0].stress[1], 5e7, 1);
  EXPECT_NEAR(b.frames[0].joint_stress[0], 2e8, 1);
  EXPECT_NEAR(b.frames[0].slip[0], 2e-4, 1e-9);
}

// Requirement: a bar that ruptures becomes two lines, and stays the same bar with the same elements and
// joints.
TEST(Bars, StayTheSameWhenTheyRupture) {
  TemporaryFolder const t;
  Bars b;
  b.take(bars_of(t, testing::one_bar(1e8F)));
  b.take(bars_of(t, testing::one_bar(2e8F, true)));
  ASSERT_EQ(b.frames.size(), 2u);
  EXPECT_NEAR(b.frames[1].stress[1], 1e8, 1);
  EXPECT_EQ(b.joint_state[0], 2);
}

// Requirement: bars of an earlier version, of another model, or whose points are not those of bar elements
// are refused with the file and the reason.
TEST(Bars, RefuseWhatIsNone) {
  TemporaryFolder const t;
  auto const expect = [&](auto const& action, std::string const& reason) {
    std::string const text = support::refusal(core::Failure::io, action);
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  Bars b;
  auto other = testing::one_bar(0);
  other.types = {output::cell_type::line, output::cell_type::line}, other.offsets = {2, 4};
  other.cell_data.clear();
  expect([&] { b.take(file_of(t, other)); },
         "grid.vtu': its bars are as earlier versions of Fissura wrote them");
  auto odd = testing::one_bar(0);
  odd.offsets = {3, 4}, odd.types.push_back(output::cell_type::poly_line);
  odd.cell_data.clear();
  odd.cell_data = {{"bar", 1, std::vector<std::int32_t>{0, 0}, ""},
                   {"copy", 1, std::vector<std::int32_t>{0, 0}, ""}};
  expect([&] { b.take(bars_of(t, odd)); }, "a bar element has no end");
  auto crossed = testing::one_bar(0);
  crossed.connectivity = {0, 2, 1, 3};
  expect([&] { b.take(bars_of(t, crossed)); }, "its points do not lie along its lines");
  b = {};
  b.take(bars_of(t, testing::one_bar(0)));
  expect([&] { b.take(bars_of(t, output::Grid{})); }, "it has other bars than the first frame");
}

// Requirement: frames that do not belong to each other, or whose points lie nowhere, are refused by name.
TEST(Scene, RefusesFramesThatDoNotFit) {
  TemporaryFolder const t;
  auto const expect = [&](char const* file, output::Grid const& g, std::string const& reason) {
    testing::make_running(t / "run", 3);
    output::write_vtu(t / "run/frames/" + std::string(file), g);
    std::string const text =
        support::refusal(core::Failure::io, [&] { report_numbers(RunFolder(t / "run"), {}); });
    EXPECT_NE(text.find(file + std::string("': ") + reason), std::string::npos) << text;
  };
  auto one = testing::two_tets(false);
  one.points.resize(4), one.connectivity.resize(4), one.offsets = {4}, one.types.resize(1);
  one.point_data = {testing::displacement(one, 0)}, one.cell_data.clear();
  expect("fields_1.vtu", one, "it has other tets than the first frame");
  auto nowhere = testing::two_tets(false);
  nowhere.points[3].y = std::numeric_limits<double>::quiet_NaN();
  expect("fields_0.vtu", nowhere, "a point of it has no place");
  expect("fields_0.vtu", testing::joints({0}, {1e-4F}, 1), "its tets do not have four points each");
  expect("cracks_1.vtu", testing::two_tets(false), "its joints do not have three points each");
  testing::make_running(t / "run", 3);
  auto const part = [&](output::Grid const& whole, output::Grid const& later, std::string const& reason) {
    for (int i = 0; i < 3; ++i)
      output::write_vtu(t / "run/frames/rigid_" + std::to_string(i) + ".vtu", i == 0 ? whole : later);
    output::PvdWriter list(t / "run/rigid.pvd");
    for (int i = 0; i < 3; ++i) list.add(0.01 * i, {"frames/rigid_" + std::to_string(i) + ".vtu"});
    std::string const text =
        support::refusal(core::Failure::io, [&] { report_numbers(RunFolder(t / "run"), {}); });
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  auto ball = testing::joints({0, 0.5}, {0, 0}, 0), half = testing::joints({0}, {0}, 0);
  for (auto* g : {&ball, &half})
    g->cell_data = {{"impactor", 1, std::vector<std::int32_t>(g->types.size(), 1), "-"}};
  part(ball, half, "rigid_1.vtu': it has other triangles than the first frame");
  auto tets = testing::two_tets(false);
  tets.cell_data = {{"impactor", 1, std::vector<std::int32_t>(2, 1), "-"}};
  part(tets, tets, "rigid_0.vtu': its triangles do not have three points each");
}

// Requirement: frames are left out evenly, never the first or the last.
TEST(Scene, SpreadsFramesEvenly) {
  EXPECT_EQ(spread(5, 9), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(spread(9, 3), (std::vector<std::size_t>{0, 4, 8}));
  EXPECT_EQ(spread(100, 2), (std::vector<std::size_t>{0, 99}));
}

// Requirement: the numbers of a run that goes on hold its curves, frames, warnings and crack table.
TEST(Report, GathersARunThatGoesOn) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 4);
  auto const blob = report_numbers(RunFolder(t / "run"), {.out = {}, .version = "1.2.3"});
  EXPECT_TRUE(blob.meta["run"].is_null());
  EXPECT_EQ(blob.meta["history"]["rows"], 100);
  EXPECT_EQ(blob.meta["frames"].size(), 4u);
  EXPECT_EQ(blob.meta["warnings"][0], "few <b>elements</b>");
  EXPECT_EQ(blob.meta["crack_table"]["rows"].size(), 1u); // the other one lies within 0.5 of it
  EXPECT_EQ(blob.meta["title"], "run");
}

// Requirement: a folder without a frame, as at the very start, has curves and no scene.
TEST(Report, GathersARunWithoutFrames) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 0);
  std::filesystem::remove(t / "run/fields.pvd");
  auto const blob = report_numbers(RunFolder(t / "run"), {});
  EXPECT_TRUE(blob.meta["scene"].is_null());
}

// Requirement: a small budget leaves frames out of the page and says how many there are.
TEST(Report, KeepsWithinItsSize) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 30);
  Blob blob;
  add_scene(blob, RunFolder(t / "run"), 2500);
  EXPECT_LT(blob.meta["frames"].size(), 30u);
  EXPECT_GE(blob.meta["frames"].size(), 2u);
  EXPECT_EQ(blob.meta["frames_saved"], 30);
  EXPECT_DOUBLE_EQ(blob.meta["frames"].back().get<double>(), 0.29);
}

// Requirement: a list that names a frame which has gone is an error that names the file.
TEST(Report, NamesAFrameThatHasGone) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 3);
  std::filesystem::remove(t / "run/frames/cracks_1.vtu");
  try {
    report_numbers(RunFolder(t / "run"), {});
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_NE(std::string(e.what()).find("cracks_1.vtu"), std::string::npos);
    EXPECT_EQ(e.failure, core::Failure::io);
  }
}

// Requirement: long histories are thinned, but rows where a count leaves zero and extremes stay.
TEST(Report, ThinsLongHistories) {
  History h;
  h.columns = {{"time", "s", {}}, {"load", "N", {}}, {"joints_cracked", "-", {}}};
  for (int i = 0; i < 20000; ++i) {
    h.columns[0].values.push_back(i);
    h.columns[1].values.push_back(i == 12345 ? 1e6 : 0);
    h.columns[2].values.push_back(i >= 7777);
  }
  Blob blob;
  add_history(blob, "history", h);
  EXPECT_LT(blob.meta["history"]["rows"].get<int>(), 6100);
  EXPECT_GT(blob.meta["history"]["rows"].get<int>(), 5000);
}

// Requirement: text of a deck never becomes markup.
TEST(Page, EscapesText) {
  EXPECT_EQ(escape_html("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
}

// Requirement: a program without the page says what to install.
TEST(Page, SaysWhatIsMissing) {
  try {
    require_page("");
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::io);
    EXPECT_NE(std::string(e.what()).find("Install nodejs and npm"), std::string::npos);
  }
  try {
    fill_page("beam", "QUJD", "<title>@@TITLE@@</title>");
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_STREQ(e.what(), "internal error: the page built into this program has no @@NUMBERS@@");
  }
}

// Requirement: where the page is built in, it is filled with title and numbers.
TEST(Page, IsFilled) {
  if (page_template().empty()) GTEST_SKIP() << "built without npm";
  std::string const page = fill_page("<b>beam</b>", "QUJD");
  EXPECT_NE(page.find("<title>&lt;b&gt;beam&lt;/b&gt;</title>"), std::string::npos);
  EXPECT_NE(page.find(">QUJD</script>"), std::string::npos);
  EXPECT_EQ(page.find("@@"), std::string::npos);
}

} // namespace
} // namespace fissura::report
