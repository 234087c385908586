// The cases of `fissura new`.
#include <gtest/gtest.h>

#include "fissura/deck/deck.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/template_case.hpp"

namespace fissura::sim {
namespace {

class Templates : public testing::TestWithParam<Template> {};

// Requirement: every template is read, builds without a warning it does not speak of, and runs as it is.
TEST_P(Templates, run_as_they_are) {
  auto const c = deck::read_case_text(GetParam().text, "case.toml");
  BuildReport report;
  build_model(c, report);
  std::string const text = GetParam().text;
  bool const speaks_of_it = text.find("few elements") != std::string::npos;
  EXPECT_EQ(report.warnings.size(), speaks_of_it ? 1u : 0u)
      << (report.warnings.empty() ? "" : report.warnings[0]);
  if (speaks_of_it) {
    EXPECT_NE(report.warnings.at(0).find("elements over the"), std::string::npos);
  }

  RunOptions options;
  options.quiet = true, options.threads = 1;
  sim::Run run(c, options);
  run.open();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(run.step()) << run.result().reason;
}

// Requirement: every template says how to go on, what its units are, and how fine to mesh.
TEST_P(Templates, explain_themselves) {
  std::string const text = GetParam().text;
  EXPECT_TRUE(text.starts_with("# "));
  for (char const* words :
       {"fissura check", "fissura run", "text with its unit", "preset = \"mc2010\"", "[[gauge]]", "title = "})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  EXPECT_NE(text.find("# The mesh: "), std::string::npos) << "advice on the mesh";
}

INSTANTIATE_TEST_SUITE_P(New, Templates, testing::ValuesIn(templates().begin(), templates().end()),
                         [](auto const& one) { return std::string(one.param.name); });

// Requirement: the templates that the documentation names are there.
TEST(NewCase, has_its_templates) {
  EXPECT_EQ(template_names(), "beam, block, column, slab_impact, tie, wall_panel");
}

} // namespace
} // namespace fissura::sim
