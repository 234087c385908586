#include <gtest/gtest.h>
#include <limits>

#include "fissura/output/json.hpp"
#include "temporary_folder.hpp"

namespace fissura::output {
namespace {

using testing::read_bytes;
using testing::TemporaryFolder;

// Requirement: the summary keeps the order of its keys, escapes its strings and ends with a line break.
TEST(JsonFile, KeepsOrderAndEscapes) {
  TemporaryFolder folder;
  Json summary;
  summary["status"] = "complete";
  summary["reason"] = "gauge \"load\"\n\\ fell";
  summary["energy"]["kinetic"] = 0.5;
  summary["broken"] = 3;
  write_json(folder / "run.json", summary);
  EXPECT_EQ(read_bytes(folder / "run.json"), "{\n"
                                             "  \"status\": \"complete\",\n"
                                             "  \"reason\": \"gauge \\\"load\\\"\\n\\\\ fell\",\n"
                                             "  \"energy\": {\n"
                                             "    \"kinetic\": 0.5\n"
                                             "  },\n"
                                             "  \"broken\": 3\n"
                                             "}\n");
}

// Requirement: doubles read back as the same value and what is not finite becomes null.
TEST(JsonFile, NumbersRoundTrip) {
  TemporaryFolder folder;
  std::vector<double> const values{0.1, 1.0 / 3, 5e-324, std::numeric_limits<double>::max(), -1e-5};
  Json summary;
  summary["values"] = values;
  summary["nan"] = std::numeric_limits<double>::quiet_NaN();
  summary["infinite"] = -std::numeric_limits<double>::infinity();
  write_json(folder / "run.json", summary);
  Json const read = Json::parse(read_bytes(folder / "run.json"));
  EXPECT_EQ(read.at("values").get<std::vector<double>>(), values);
  EXPECT_TRUE(read.at("nan").is_null());
  EXPECT_TRUE(read.at("infinite").is_null());
}

// Requirement: text that is not UTF-8 does not cost the summary of a long run.
TEST(JsonFile, BadUtf8IsReplaced) {
  TemporaryFolder folder;
  write_json(folder / "run.json", Json{{"case", "a\xff"}});
  EXPECT_EQ(Json::parse(read_bytes(folder / "run.json")).at("case").get<std::string>(), "a\xEF\xBF\xBD");
}

} // namespace
} // namespace fissura::output
