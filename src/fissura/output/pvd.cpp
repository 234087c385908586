#include "fissura/output/pvd.hpp"

#include <fmt/core.h>
#include <pugixml.hpp>
#include <sstream>

#include "fissura/output/atomic_file.hpp"

namespace fissura::output {

void PvdWriter::add(double time, std::vector<std::string> const& files) {
  int part = 0;
  for (std::string const& file : files) entries_.push_back({time, part++, file});
  rewrite();
}

void PvdWriter::start_with(std::vector<std::pair<double, std::string>> const& frames) {
  entries_.clear();
  for (auto const& [time, file] : frames) entries_.push_back({time, 0, file});
  rewrite();
}

void PvdWriter::rewrite() const {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = "Collection";
  root.append_attribute("version") = "1.0";
  pugi::xml_node collection = root.append_child("Collection");
  for (Entry const& e : entries_) {
    pugi::xml_node node = collection.append_child("DataSet");
    node.append_attribute("timestep") = fmt::format("{}", e.time).c_str();
    node.append_attribute("part") = e.part;
    node.append_attribute("file") = e.file.c_str();
  }
  std::ostringstream text;
  document.save(text, " ");
  replace_file(path_, text.str());
}

} // namespace fissura::output
