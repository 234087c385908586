// Cages and presets: what an engineer writes, and what it stands for.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fissura/deck/deck.hpp"
#include "fissura/deck/schema.hpp"
#include "fissura/model/presets.hpp"

namespace {
using namespace fissura;
using deck::read_case_text;

std::string deck_with(std::string const& cage,
                      std::string const& concrete = "preset = \"mc2010\"\nf_c = \"38 MPa\"") {
  return "[[mesh.box]]\nfrom = [\"0 m\", \"0 m\", \"0 m\"]\nto = [\"3 m\", \"200 mm\", \"300 mm\"]\ncells = "
         "[30, 4, 6]\n"
         "[[concrete]]\nname = \"C30\"\n" +
         concrete + "\n[[steel]]\nname = \"B500\"\nf_y = \"500 MPa\"\nf_u = \"550 MPa\"\n" + cage +
         "\n[run]\nend_time = \"1 ms\"\n";
}

std::string const beam = R"([[cage]]
name = "beam"
kind = "beam"
steel = "B500"
from = ["0 m", "0 m", "0 m"]
to = ["3 m", "200 mm", "300 mm"]
cover = "25 mm"
bottom = ["3 x 16 mm", "2 x 12 mm"]
top = "2 x 10 mm"
sides = "1 x 8 mm"
stirrups = "8 mm / 150 mm"
)";
std::string const column = R"([[cage]]
kind = "column"
steel = "B500"
axis = "x"
from = ["0 m", "0 m", "0 m"]
to = ["3 m", "200 mm", "300 mm"]
cover = "20 mm"
end_cover = ["0 mm", "30 mm"]
bars = "8 x 16 mm"
stirrups = "10 mm / 100 mm"
)";

model::Case read(std::string const& cage) {
  return read_case_text(deck_with(cage), "case.toml");
}

std::string refusal(std::string const& text) {
  try {
    read_case_text(text, "case.toml");
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "accepted";
}
std::string refused_with(std::string cage, std::string const& old_text, std::string const& new_text) {
  auto const at = cage.find(old_text);
  EXPECT_NE(at, std::string::npos);
  return refusal(deck_with(cage.replace(at, old_text.size(), new_text)));
}

model::BarSpec const& bar(model::Case const& c, std::string const& name) {
  for (auto const& b : c.bars)
    if (b.name == name) return b;
  ADD_FAILURE() << "no bar " << name;
  return c.bars.at(0);
}

// Requirement: a beam's layers lie where cover, stirrup and diameters put them, the outer bars in the corners
// of the stirrups, and a second layer at the clear distance above the first.
TEST(Cage, beam_layers_lie_inside_the_stirrups) {
  auto const c = read(beam);
  ASSERT_EQ(c.bars.size(), 6U);
  auto const& bottom = bar(c, "beam_bottom");
  EXPECT_EQ(bottom.count, 3);
  EXPECT_DOUBLE_EQ(bottom.points[0].z, 0.025 + 0.008 + 0.008);
  EXPECT_DOUBLE_EQ(bottom.points[0].y, 0.041);
  EXPECT_NEAR(bottom.points[0].y + 2 * bottom.spacing.y, 0.2 - 0.041, 1e-15);
  EXPECT_DOUBLE_EQ(bottom.points[0].x, 0.025);
  EXPECT_DOUBLE_EQ(bottom.points[1].x, 2.975);
  auto const& second = bar(c, "beam_bottom_2");
  EXPECT_NEAR(second.points[0].z, 0.049 + 0.020 + 0.006, 1e-15) << "20 mm is more than both diameters";
  EXPECT_NEAR(second.points[0].y, 0.025 + 0.008 + 0.006, 1e-15);
  auto const& top = bar(c, "beam_top");
  EXPECT_NEAR(top.points[0].z, 0.3 - 0.038, 1e-15);
  EXPECT_NEAR(bar(c, "beam_side_1").points[0].z, 0.5 * (0.041 + 0.262), 1e-15);
  EXPECT_NEAR(bar(c, "beam_side_2").points[0].y, 0.2 - 0.037, 1e-15);
}

// Requirement: stirrups are closed rectangles at cover + d/2, as many as fit, centred between the end covers.
TEST(Cage, stirrups_are_centred) {
  auto const c = read(beam);
  auto const& s = bar(c, "beam_stirrups");
  EXPECT_TRUE(s.closed);
  ASSERT_EQ(s.points.size(), 4U);
  EXPECT_NEAR(s.points[0].y, 0.029, 1e-15);
  EXPECT_NEAR(s.points[2].z, 0.3 - 0.029, 1e-15);
  EXPECT_EQ(s.count, 20) << "2.942 m/0.15 m = 19.6";
  EXPECT_NEAR(s.points[0].x + (s.points[0].x + 19 * 0.15), 3, 1e-14);
  EXPECT_DOUBLE_EQ(s.spacing.x, 0.15);
}

// Requirement: a column has a bar in each corner and the other pairs where the gap is widest; each end may
// have its own cover.
TEST(Cage, column_bars_go_round_the_section) {
  auto const c = read(column);
  ASSERT_EQ(c.bars.size(), 5U);
  EXPECT_EQ(c.bars[0].name, "cage_1_row_1");
  EXPECT_EQ(bar(c, "cage_1_row_1").count, 3);
  EXPECT_EQ(bar(c, "cage_1_row_2").count, 3);
  EXPECT_EQ(bar(c, "cage_1_side_1").count, 1)
      << "4 corners, one pair on the long sides, one on the short ones";
  EXPECT_NEAR(bar(c, "cage_1_side_2").points[0].z, 0.15, 1e-15);
  EXPECT_EQ(bar(c, "cage_1_row_1").points[0].x, 0.0);
  EXPECT_DOUBLE_EQ(bar(c, "cage_1_row_1").points[1].x, 2.97);
}

// Requirement: the echo holds the cage instead of its bars and reads back to the same bars.
TEST(Cage, echo_reads_back) {
  for (auto const& cage : {beam, column}) {
    auto const first = read(cage);
    std::string const text = deck::echo(first);
    EXPECT_EQ(text.find("[[bar]]"), std::string::npos);
    auto const again = read_case_text(text, "case.toml");
    EXPECT_EQ(deck::echo(again), text);
    ASSERT_EQ(again.bars.size(), first.bars.size());
    for (std::size_t i = 0; i < first.bars.size(); ++i) {
      EXPECT_EQ(again.bars[i].points, first.bars[i].points);
      EXPECT_EQ(again.bars[i].count, first.bars[i].count);
    }
  }
}

// Requirement: gauges find the bars of a cage, and a copy that is not there is refused.
TEST(Cage, gauges_refer_to_its_bars) {
  std::string const gauge =
      "[[gauge]]\nname = \"s\"\nkind = \"bar\"\nat = [\"1 m\", \"0.1 m\", \"0.04 m\"]\nbar = ";
  EXPECT_EQ(refusal(deck_with(beam + gauge + "\"beam_bottom\"\ncopy = 2")), "accepted");
  EXPECT_NE(refusal(deck_with(beam + gauge + "\"beam_bottom\"\ncopy = 3")).find("has 3 copies"),
            std::string::npos);
  EXPECT_NE(refusal(deck_with(beam + gauge + "\"beam_botom\"")).find("did you mean `beam_bottom`?"),
            std::string::npos);
}

// Requirement: what does not fit is refused at its key, with the numbers and the cure.
TEST(Cage, says_what_does_not_fit) {
  struct Fault {
    std::string old_text, new_text, expected;
  };
  for (auto const& f : std::vector<Fault>{
           {"cover = \"25 mm\"", "cover = \"25 cm\"",
            "19:9: error: a cover of 250 mm leaves no room for bars in the 200 mm x 300 mm section: with "
            "these bars at "
            "most 76 mm"},
           {"3 x 16 mm", "7 x 16 mm",
            "20:10: error: 7 x 16 mm do not fit in one layer: 134 mm between the faces less cover and "
            "stirrups hold 4 "
            "of them 20 mm apart"},
           {"\"2 x 12 mm\"]",
            "\"2 x 12 mm\", \"2 x 12 mm\", \"2 x 12 mm\", \"2 x 12 mm\", \"2 x 12 mm\", \"2 x 12 mm\"]",
            "the layers of `bottom` and `top` leave"},
           {"1 x 8 mm", "9 x 8 mm", "22:9: error: 9 x 8 mm do not fit between bottom and top"},
           {"8 mm / 150 mm", "150 mm / 8 mm", "23:12: error: stirrups of 150 mm cannot be 8 mm apart"},
           {"8 mm / 150 mm", "8 mm / 5 mm", "23:12: error: stirrups of 8 mm cannot be 5 mm apart"},
           {"8 mm / 150 mm", "8 mm at 150 mm",
            "`stirrups` must be diameter and spacing, e.g. \"8 mm / 150 mm\""},
           {"2 x 10 mm", "2 x 10", "`top` = \" 10\": `10` has no unit"},
           {"2 x 10 mm", "two x 10 mm",
            "`top` must be a number of bars and their diameter, e.g. \"4 x 12 mm\""},
           {"2 x 10 mm", "0 x 10 mm", "a layer has 1 to 1000 bars"},
           {"cover = \"25 mm\"", "cover = \"25 mm\"\nend_cover = \"2 m\"",
            "leave nothing of the 3000 mm long member"},
           {"sides", "up = \"x\"\nsides", "swap `axis` and `up`?"},
           {"kind = \"beam\"", "kind = \"column\"",
            "`bottom` belongs to kind = \"beam\"; a column has `bars`"},
           {"steel = \"B500\"", "steel = \"B50\"", "no [[steel]] is named \"B50\"; did you mean `B500`?"},
           {"\"300 mm\"]\ncover", "\"0 mm\"]\ncover", "they have the same z"}})
    EXPECT_NE(refused_with(beam, f.old_text, f.new_text).find(f.expected), std::string::npos)
        << refused_with(beam, f.old_text, f.new_text) << "\nexpected " << f.expected;
  EXPECT_NE(refused_with(beam, "cover =", "bars = \"8 x 16 mm\"\ncover =")
                .find("`bars` belongs to kind = \"column\""),
            std::string::npos);
  EXPECT_NE(refused_with(beam, "top = \"2 x 10 mm\"\n", "")
                .find("`sides` lie between `bottom` and `top`: give both"),
            std::string::npos);
  EXPECT_NE(refused_with(column, "bars = \"8 x 16 mm\"\nstirrups = \"10 mm / 100 mm\"\n", "")
                .find("[[cage]] needs `bottom` or `top` (beam), `bars` (column) or `stirrups`"),
            std::string::npos);
  std::string const namesake =
      "[[bar]]\nname = \"beam_top\"\nsteel = \"B500\"\ndiameter = \"8 mm\"\n"
      "points = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"1 m\", \"0.1 m\", \"0.1 m\"]]\n";
  EXPECT_NE(
      refusal(deck_with(beam + namesake)).find("the name \"beam_top\" is taken by the [[cage]] \"beam\""),
      std::string::npos);
  EXPECT_NE(refused_with(column, "8 x 16", "7 x 16").find("an even number of bars"), std::string::npos);
  EXPECT_NE(refused_with(column, "8 x 16", "40 x 16").find("do not fit in one layer"), std::string::npos);
}

// Requirement: the presets give the tables' values: C30/37 has E_cm = 33 GPa and f_ctm = 2.9 MPa in EN
// 1992-1-1, E_ci = 33.6 GPa in MC2010; C60/75 has f_ctm = 4.4 MPa.
TEST(Preset, gives_the_values_of_the_codes) {
  auto const ec2 = model::preset_values(model::ConcretePreset::ec2, 38e6);
  EXPECT_NEAR(ec2.E.value, 33e9, 0.5e9);
  EXPECT_NEAR(ec2.f_t.value, 2.9e6, 0.05e6);
  auto const mc = model::preset_values(model::ConcretePreset::mc2010, 38e6);
  EXPECT_NEAR(mc.E.value, 33.6e9, 0.1e9);
  EXPECT_DOUBLE_EQ(mc.G_f.value, 73 * std::pow(38, 0.18));
  EXPECT_NEAR(model::preset_values(model::ConcretePreset::ec2, 68e6).f_t.value, 4.4e6, 0.05e6);
}

// Requirement: keys of the deck win over the preset; f_ck stands for f_c = f_ck + 8 MPa; the penalty is a
// multiple of the preset's E.
TEST(Preset, explicit_keys_win) {
  auto const a =
      read_case_text(deck_with("", "preset = \"mc2010\"\nf_ck = \"30 MPa\"\npenalty = 10"), "case.toml")
          .concretes[0];
  auto const v = model::preset_values(a.preset, 38e6);
  EXPECT_EQ(a.f_c, 38e6);
  EXPECT_EQ(a.E, v.E.value);
  EXPECT_EQ(a.f_t, v.f_t.value);
  EXPECT_EQ(a.G_f, v.G_f.value);
  EXPECT_EQ(a.penalty, 10 * v.E.value);
  auto const b =
      read_case_text(deck_with("", "preset = \"ec2\"\nf_c = \"38 MPa\"\nE = \"25 GPa\"\nG_f = \"80 N/m\""),
                     "case.toml")
          .concretes[0];
  EXPECT_EQ(b.E, 25e9);
  EXPECT_EQ(b.G_f, 80);
  EXPECT_EQ(b.f_t, v.f_t.value);
  auto const notes = model::preset_notes(b);
  ASSERT_EQ(notes.size(), 4U);
  EXPECT_EQ(notes[1], "C30: E = 25 GPa as given; ec2 says 32.84 GPa = 22 GPa (f_cm/10 MPa)^0.3");
  EXPECT_EQ(notes[2], "C30: f_t = 2.896 MPa = 0.3 f_ck^(2/3), in MPa (ec2)");
}

// Requirement: the echo says which values follow from the preset, and reads back to the same bits.
TEST(Preset, echo_says_where_values_come_from) {
  auto const c =
      read_case_text(deck_with("", "preset = \"mc2010\"\nf_c = \"38 MPa\"\nf_t = \"2 MPa\""), "case.toml");
  std::string const text = deck::echo(c);
  EXPECT_NE(text.find("  # mc2010: 21.5 GPa (f_cm/10 MPa)^(1/3)\n"), std::string::npos);
  EXPECT_NE(text.find("f_t = \"2 MPa\"\n"), std::string::npos);
  auto const again = read_case_text(text, "case.toml");
  EXPECT_EQ(again.concretes[0].E, c.concretes[0].E);
  EXPECT_EQ(again.concretes[0].G_f, c.concretes[0].G_f);
  EXPECT_EQ(deck::echo(again), text);
}

// Requirement: strengths outside the code, and a preset without a strength, are refused with the cure.
TEST(Preset, refuses_what_the_code_does_not_cover) {
  EXPECT_NE(
      refusal(deck_with("", "preset = \"ec2\"\nf_c = \"38 kPa\"")).find("covers f_ck = 12 MPa to 90 MPa"),
      std::string::npos);
  EXPECT_NE(refusal(deck_with("", "preset = \"ec2\"")).find("needs `f_c`, the mean strength, or `f_ck`"),
            std::string::npos);
  EXPECT_NE(refusal(deck_with("", "preset = \"ec2\"\nf_c = \"38 MPa\"\nf_ck = \"30 MPa\""))
                .find("give either `f_c`"),
            std::string::npos);
  EXPECT_NE(
      refusal(deck_with("", "f_c = \"38 MPa\"\nf_t = \"3 MPa\"")).find("needs `E`: a pressure; or preset"),
      std::string::npos);
}

// Requirement: every key of the schema says what it is, what values it takes and what it is without them.
TEST(Schema, every_key_is_documented) {
  for (auto const& section : deck::schema()) {
    model::Case fresh;
    section.make(fresh, 1);
    EXPECT_FALSE(section.doc.empty()) << section.path;
    for (auto const& key : section.keys) {
      EXPECT_FALSE(key.doc.empty()) << section.path << "." << key.name;
      EXPECT_FALSE(key.type.empty()) << section.path << "." << key.name;
    }
  }
  for (auto const* shape :
       {&deck::selector_shape(), &deck::curve_shape(), &deck::path_shape(), &deck::record_shape()})
    for (auto const& key : shape->keys) {
      EXPECT_FALSE(key.doc.empty()) << shape->name << "." << key.name;
      EXPECT_FALSE(key.type.empty()) << shape->name << "." << key.name;
    }
}

} // namespace
