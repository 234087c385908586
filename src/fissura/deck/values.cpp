#include "fissura/deck/values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "fissura/deck/nearest.hpp"

namespace fissura::deck {
namespace {

using units::Dimension;

void expected(Reader& reader, Node const& node, Wanted const& wanted, std::string_view what) {
  reader.error(node, fmt::format("`{}` must be {}, not {}", wanted.name, what, shown(node)));
}

std::optional<double> in_range(Reader& reader, Node const& node, Wanted const& wanted, double value) {
  if (wanted.range.contains(value)) return value;
  std::string const range = to_string(wanted.range, wanted.dimension);
  reader.error(node, fmt::format("`{}` must be {}, not {}", wanted.name, range, shown(node)));
  return std::nullopt;
}

bool is_number(Node const& node) {
  return node.kind == Node::Kind::number || node.kind == Node::Kind::integer;
}

/// A number where a quantity is due: names the unit to write, reading the number as SI.
void missing_unit(Reader& reader, Node const& node, Wanted const& wanted) {
  auto const& info = units::info(wanted.dimension);
  if (!std::isfinite(node.number)) return expected(reader, node, wanted, info.noun);
  reader.error(node, fmt::format("`{}` needs a unit: {} as text, e.g. \"{}\" ({} in SI units is \"{}\")",
                                 wanted.name, info.noun, info.example, shown(node),
                                 units::from_si(node.number, wanted.dimension)));
}

} // namespace

std::optional<std::string> read_text(Reader& reader, Node const& node, Wanted const& wanted) {
  if (node.kind == Node::Kind::text) return node.text;
  expected(reader, node, wanted, "a text in quotes");
  return std::nullopt;
}

std::optional<bool> read_flag(Reader& reader, Node const& node, Wanted const& wanted) {
  if (node.kind == Node::Kind::flag) return node.flag;
  expected(reader, node, wanted, "true or false (without quotes)");
  return std::nullopt;
}

std::optional<double> read_number(Reader& reader, Node const& node, Wanted const& wanted) {
  if (!is_number(node) || !std::isfinite(node.number)) {
    expected(reader, node, wanted, "a plain number (without unit and quotes)");
    return std::nullopt;
  }
  return in_range(reader, node, wanted, node.number);
}

std::optional<long> read_integer(Reader& reader, Node const& node, Wanted const& wanted) {
  if (node.kind != Node::Kind::integer) {
    expected(reader, node, wanted, "a whole number");
    return std::nullopt;
  }
  if (!in_range(reader, node, wanted, node.number)) return std::nullopt;
  return static_cast<long>(node.integer);
}

std::optional<double> read_quantity(Reader& reader, Node const& node, Wanted const& wanted) {
  if (wanted.dimension == Dimension::none) return read_number(reader, node, wanted);
  if (is_number(node)) {
    missing_unit(reader, node, wanted);
    return std::nullopt;
  }
  if (node.kind != Node::Kind::text) {
    auto const& info = units::info(wanted.dimension);
    expected(reader, node, wanted, fmt::format("{} as text, e.g. \"{}\"", info.noun, info.example));
    return std::nullopt;
  }
  try {
    double const value = units::to_si(node.text, wanted.dimension), most = units::info(wanted.dimension).most;
    if (std::abs(value) <= most) return in_range(reader, node, wanted, value);
    reader.error(node, fmt::format("`{}` = {} is beyond anything physical: at most {} can be computed with",
                                   wanted.name, shown(node), units::from_si(most, wanted.dimension)));
    return std::nullopt;
  } catch (core::Error const& e) {
    if (e.failure != core::Failure::input) throw;
    reader.error(node, fmt::format("`{}` = {}: {}", wanted.name, shown(node), e.what()));
    return std::nullopt;
  }
}

std::optional<std::size_t> read_word(Reader& reader, Node const& node, Wanted const& wanted,
                                     std::vector<std::string_view> const& words) {
  if (node.kind == Node::Kind::text)
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] == node.text) return i;
  std::string const hint = node.kind == Node::Kind::text ? did_you_mean(node.text, words) : "";
  reader.error(node, fmt::format("`{}` must be {}, not {}{}", wanted.name, listed(words), shown(node), hint));
  return std::nullopt;
}

std::optional<int> read_axis(Reader& reader, Node const& node, Wanted const& wanted) {
  auto const index = read_word(reader, node, wanted, {"x", "y", "z"});
  return index ? std::optional<int>(static_cast<int>(*index)) : std::nullopt;
}

std::optional<std::string> read_name(Reader& reader, Node const& node, Wanted const& wanted) {
  auto const text = read_text(reader, node, wanted);
  if (!text) return std::nullopt;
  bool const bad =
      text->empty() || text->size() > 100 || text->find_first_of(",;\"'`[]") != std::string::npos ||
      text->front() == ' ' || text->back() == ' ' ||
      std::any_of(text->begin(), text->end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (!bad) return text;
  expected(reader, node, wanted,
           "a name of 1 to 100 characters without commas, quotes, brackets, control characters and blanks "
           "around it");
  return std::nullopt;
}

Node const* read_array(Reader& reader, Node const& node, Wanted const& wanted, std::size_t size,
                       std::size_t most) {
  bool const fits = node.kind == Node::Kind::array &&
                    (size > 0 ? node.items.size() == size : !node.items.empty() && node.items.size() <= most);
  if (fits) return &node;
  std::string const what =
      size > 0 ? fmt::format("an array of {} values", size) : fmt::format("an array of 1 to {} values", most);
  std::string const got =
      node.kind == Node::Kind::array ? fmt::format("one of {}", node.items.size()) : shown(node);
  reader.error(node, fmt::format("`{}` must be {}, not {}", wanted.name, what, got));
  return nullptr;
}

namespace {

template <class Read>
std::optional<Vec3> read_vec3(Reader& reader, Node const& node, Wanted const& wanted, Read read) {
  if (!read_array(reader, node, wanted, 3)) return std::nullopt;
  Vec3 value;
  bool good = true;
  for (int i = 0; i < 3; ++i) {
    auto const part = read(reader, node.items[static_cast<std::size_t>(i)], wanted);
    good = good && part.has_value();
    value[i] = part.value_or(0);
  }
  return good ? std::optional(value) : std::nullopt;
}

} // namespace

std::optional<Vec3> read_quantities(Reader& reader, Node const& node, Wanted const& wanted) {
  return read_vec3(reader, node, wanted, read_quantity);
}

std::optional<Vec3> read_direction(Reader& reader, Node const& node, Wanted const& wanted) {
  auto const v = read_vec3(reader, node, wanted, read_number);
  if (!v) return std::nullopt;
  double const length = std::hypot(v->x, v->y, v->z);
  if (!(length > 0) || !std::isfinite(length)) {
    expected(reader, node, wanted, "three numbers that are not all zero");
    return std::nullopt;
  }
  // A unit vector stays as it is, so that the echo reads back to the same bits.
  return std::abs(length - 1) < 1e-14 ? *v : *v / length;
}

std::optional<std::vector<Vec3>> read_points(Reader& reader, Node const& node, Wanted const& wanted,
                                             std::size_t size, std::size_t most) {
  if (!read_array(reader, node, wanted, size, most)) return std::nullopt;
  std::vector<Vec3> points;
  Wanted const point(wanted.name, Dimension::length);
  for (auto const& item : node.items)
    if (auto const p = read_quantities(reader, item, point)) points.push_back(*p);
  return points.size() == node.items.size() ? std::optional(points) : std::nullopt;
}

std::optional<std::vector<std::string>> read_texts(Reader& reader, Node const& node, Wanted const& wanted) {
  if (!read_array(reader, node, wanted, 0, 10000)) return std::nullopt;
  std::vector<std::string> texts;
  for (auto const& item : node.items)
    if (auto text = read_name(reader, item, wanted)) texts.push_back(std::move(*text));
  return texts.size() == node.items.size() ? std::optional(texts) : std::nullopt;
}

std::string write_text(std::string_view value) {
  std::string text = "\"";
  for (char const c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (c == '\n')
      text += "\\n";
    else if (c == '\t')
      text += "\\t";
    else
      text += c;
  }
  return text + '"';
}

std::string write_flag(bool value) {
  return value ? "true" : "false";
}

std::string write_number(double value) {
  return units::from_si(value, Dimension::none);
}

std::string write_quantity(double value, Dimension dimension) {
  if (dimension == Dimension::none) return write_number(value);
  return write_text(units::from_si(value, dimension));
}

std::string write_axis(int axis) {
  return write_text(std::string(1, static_cast<char>('x' + axis)));
}

std::string joined(std::vector<std::string> const& items) {
  std::string text;
  for (auto const& item : items) text.append(text.empty() ? "" : ", ").append(item);
  return text;
}

std::string write_array(std::vector<std::string> const& items) {
  return "[" + joined(items) + "]";
}

std::string write_quantities(Vec3 v, Dimension d) {
  return write_array({write_quantity(v.x, d), write_quantity(v.y, d), write_quantity(v.z, d)});
}

std::string write_direction(Vec3 v) {
  return write_quantities(v, Dimension::none);
}

std::string write_points(std::vector<Vec3> const& points) {
  std::vector<std::string> items;
  for (auto const& p : points) items.push_back(write_quantities(p, Dimension::length));
  return write_array(items);
}

std::string write_texts(std::vector<std::string> const& texts) {
  std::vector<std::string> items;
  for (auto const& t : texts) items.push_back(write_text(t));
  return write_array(items);
}

} // namespace fissura::deck
