#include "fissura/deck/reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "fissura/deck/nearest.hpp"

namespace fissura::deck {
namespace {

constexpr std::size_t most_findings = 100, most_kept = 1000; // shown, and remembered

/// The section that has a key of this name: "it belongs to [run]" helps more than a guess at the spelling.
std::string belongs_to(std::string_view key) {
  for (auto const& section : schema())
    for (auto const& k : section.keys)
      if (k.name == key && !section.path.empty()) return title(section);
  return {};
}

} // namespace

void Reader::error(core::Place const& place, std::string message) {
  if (findings.size() < most_kept)
    findings.push_back({place, std::move(message)});
  else
    ++unheard;
}

void Reader::throw_findings() const {
  if (findings.empty()) return;
  auto sorted = findings;
  std::stable_sort(sorted.begin(), sorted.end(), [](auto const& a, auto const& b) {
    return std::tie(a.place.file, a.place.line, a.place.column) <
           std::tie(b.place.file, b.place.line, b.place.column);
  });
  if (sorted.size() > most_findings) {
    std::size_t const more = errors() - most_findings;
    sorted.resize(most_findings);
    sorted.push_back({core::Place{sorted.front().place.file, 0, 0}, fmt::format("and {} more errors", more)});
  }
  throw core::InputError(std::move(sorted));
}

void Reader::forget(void const* record) {
  // A draft on the stack may lie where an earlier one lay.
  auto const of_record = [&](auto const& from) { return from.lower_bound(Name{record, ""}); };
  for (auto i = of_record(places); i != places.end() && i->first.first == record;) i = places.erase(i);
  for (auto i = of_record(faulty); i != faulty.end() && i->first == record;) i = faulty.erase(i);
}

void Reader::read_keys(std::vector<Key> const& keys, std::string const& label, Node const& table,
                       void* record) {
  forget(record);
  record_places[record] = table.place;
  for (auto const& key : keys) {
    Node const* value = table.find(key.name);
    if (!value) {
      if (!key.required) continue;
      error(table.place, fmt::format("{} needs `{}`: {}", label, key.name, key.type));
      faulty.insert({record, key.name});
      continue;
    }
    places[{record, key.name}] = value->place;
    std::size_t const before = errors();
    key.read(*this, *value, key, record);
    if (errors() > before) faulty.insert({record, key.name});
  }
}

void Reader::name_unknown_keys(std::vector<Key> const& keys, std::string const& label, Node const& table,
                               std::vector<std::string_view> const& also_known) {
  std::vector<std::string_view> known(also_known);
  for (auto const& key : keys) known.push_back(key.name);
  for (auto const& item : table.items) {
    if (std::find(known.begin(), known.end(), item.key) != known.end()) continue;
    std::string hint = did_you_mean(item.key, known);
    if (hint.empty())
      if (auto const section = belongs_to(item.key); !section.empty())
        hint = fmt::format("; it belongs to {}", section);
    if (hint.empty()) hint = fmt::format("; known are {}", listed(known));
    error(item.key_place, fmt::format("unknown key `{}` in {}{}", item.key, label, hint));
  }
}

void Reader::read_record(Section const& section, Node const& table, void* record,
                         std::vector<std::string_view> const& also_known) {
  section.set_place(record, table.place);
  read_keys(section.keys, title(section), table, record);
  name_unknown_keys(section.keys, title(section), table, also_known);
  if (section.finish) section.finish(*this, table, record);
}

void Reader::read_shape(Shape const& shape, Node const& table, void* record) {
  read_keys(shape.keys, shape.name, table, record);
  name_unknown_keys(shape.keys, shape.name, table, {});
  if (shape.finish) shape.finish(*this, table, record);
}

bool Reader::given(void const* record, std::string_view key) const {
  return places.count({record, std::string(key)}) > 0;
}

bool Reader::good(void const* record, std::initializer_list<std::string_view> keys) const {
  return std::none_of(keys.begin(), keys.end(), [&](std::string_view key) {
    return faulty.count({record, std::string(key)}) > 0;
  });
}

core::Place Reader::place(void const* record, std::string_view key) const {
  if (auto const i = places.find({record, std::string(key)}); i != places.end()) return i->second;
  if (auto const i = record_places.find(record); i != record_places.end()) return i->second;
  return {};
}

namespace {

Node const* find_path(Node const& root, std::string_view path) {
  Node const* node = &root;
  while (node && !path.empty()) {
    auto const dot = path.find('.');
    node = node->find(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  }
  return node;
}

/// The tables directly inside this section that are sections themselves.
std::vector<std::string_view> inner_sections(Section const& section) {
  std::string const prefix = section.path.empty() ? "" : section.path + ".";
  std::vector<std::string_view> names;
  for (auto const& other : schema()) {
    if (other.path.size() <= prefix.size() || !other.path.starts_with(prefix)) continue;
    auto const rest = std::string_view(other.path).substr(prefix.size());
    if (rest.find('.') == std::string_view::npos) names.push_back(rest);
  }
  return names;
}

bool is_array_of_tables(Node const& node) {
  return node.kind == Node::Kind::array &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](Node const& n) { return n.kind == Node::Kind::table; });
}

void read_many(Reader& reader, Section const& section, Node const& array) {
  section.make(reader.the_case, array.items.size());
  for (std::size_t i = 0; i < array.items.size(); ++i)
    reader.read_record(section, array.items[i], section.record(reader.the_case, i), inner_sections(section));
}

void read_section(Reader& reader, Section const& section, Node const& root) {
  Node const* node = find_path(root, section.path);
  if (!node) return;
  if (section.many && !is_array_of_tables(*node)) {
    reader.error(node->place, fmt::format("a deck may have several `{}`: write {} with double brackets",
                                          section.path, title(section)));
  } else if (section.many) {
    read_many(reader, section, *node);
  } else if (node->kind != Node::Kind::table) {
    reader.error(node->place, fmt::format("`{}` stands once: write {} with single brackets", section.path,
                                          title(section)));
  } else {
    section.make(reader.the_case, 1);
    reader.read_record(section, *node, section.record(reader.the_case, 0), inner_sections(section));
  }
}

} // namespace

void read_sections(Reader& reader, Node const& root) {
  for (auto const& section : schema()) read_section(reader, section, root);
}

} // namespace fissura::deck
