#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "fissura/output/pvd.hpp"
#include "temporary_folder.hpp"

namespace fissura::output {
namespace {

using testing::TemporaryFolder;

// Requirement: after each frame the list is a complete XML file with all frames so far: time, part and file.
TEST(Pvd, IsCompleteAfterEachFrame) {
  TemporaryFolder folder;
  PvdWriter pvd(folder / "bars.pvd");
  pvd.add(0, {"fields/0.vtu"});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((folder / "bars.pvd").c_str()));
  EXPECT_EQ(document.select_nodes("/VTKFile[@type='Collection']/Collection/DataSet").size(), 1u);

  pvd.add(0.1, {"bars/1.vtu", "bar & joints/1.vtu"});
  ASSERT_TRUE(document.load_file((folder / "bars.pvd").c_str()));
  auto const entries = document.select_nodes("/VTKFile/Collection/DataSet");
  ASSERT_EQ(entries.size(), 3u);
  auto const text = [&](std::size_t i, char const* name) {
    return std::string(entries[i].node().attribute(name).value());
  };
  EXPECT_EQ(text(0, "timestep"), "0");
  EXPECT_EQ(text(0, "file"), "fields/0.vtu");
  EXPECT_EQ(text(1, "timestep"), "0.1");
  EXPECT_EQ(text(1, "part"), "0");
  EXPECT_EQ(text(2, "timestep"), "0.1");
  EXPECT_EQ(text(2, "part"), "1");
  EXPECT_EQ(text(2, "file"), "bar & joints/1.vtu");
}

// Requirement: a list gone on with is the same, to the byte, as one that was never left.
TEST(Pvd, GoesOnWithAList) {
  TemporaryFolder folder;
  PvdWriter whole(folder / "whole.pvd"), parts(folder / "parts.pvd");
  for (int i = 0; i < 4; ++i) whole.add(0.1 * i, {"frames/" + std::to_string(i)});
  parts.start_with({{0.1 * 0, "frames/0"}, {0.1 * 1, "frames/1"}, {0.1 * 2, "frames/2"}});
  parts.add(0.1 * 3, {"frames/3"});
  EXPECT_EQ(testing::read_bytes(folder / "parts.pvd"), testing::read_bytes(folder / "whole.pvd"));
}

} // namespace
} // namespace fissura::output
