#pragma once
// Reads one deck: gathers all findings of the pass and remembers where each key of each record was written.
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "fissura/deck/schema.hpp"

namespace fissura::deck {

class Reader {
 public:
  explicit Reader(model::Case& the_case_) : the_case(the_case_) {}

  void error(core::Place const& place, std::string message);
  void error(Node const& node, std::string message) { error(node.place, std::move(message)); }
  std::size_t errors() const { return findings.size() + unheard; }
  /// Throws core::InputError with all findings in the order of the deck, if there are any.
  void throw_findings() const;

  /// The table of one record: reads its keys, names what is missing and what is unknown. `also_known` are the
  /// tables inside it that other sections read.
  void read_record(Section const& section, Node const& table, void* record,
                   std::vector<std::string_view> const& also_known);
  void read_shape(Shape const& shape, Node const& table, void* record);

  /// Whether the key was written for this record.
  bool given(void const* record, std::string_view key) const;
  /// Whether none of the keys was faulty or required and missing: a check across them makes sense.
  bool good(void const* record, std::initializer_list<std::string_view> keys) const;
  /// Where the key's value was written; the record's place if it was not.
  core::Place place(void const* record, std::string_view key) const;

  model::Case& the_case;

 private:
  using Name = std::pair<void const*, std::string>;

  void forget(void const* record);
  void read_keys(std::vector<Key> const& keys, std::string const& label, Node const& table, void* record);
  void name_unknown_keys(std::vector<Key> const& keys, std::string const& label, Node const& table,
                         std::vector<std::string_view> const& also_known);

  std::vector<core::Diagnostic> findings; ///< the first thousand
  std::size_t unheard = 0;                ///< how many more there were
  std::map<Name, core::Place> places;
  std::map<void const*, core::Place> record_places;
  std::set<Name> faulty;
};

/// Reads the whole tree into the reader's case, section by section.
void read_sections(Reader& reader, Node const& root);

} // namespace fissura::deck
