#pragma once
// Ties keys to the fields of a record: Fields<SteelSpec>(keys).quantity("f_y", &SteelSpec::f_y,
// ...).required().
#include <fmt/core.h>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fissura/deck/nearest.hpp"
#include "fissura/deck/values.hpp"

namespace fissura::deck {

template <class T> class Fields {
 public:
  using Dimension = units::Dimension;
  using Written = std::optional<std::string>;
  template <class V> using Words = std::vector<std::pair<std::string_view, V>>;

  explicit Fields(std::vector<Key>& keys_) : keys(keys_) {}

  // What a key is.
  Fields& text(std::string name, std::string T::*field, std::string doc) {
    return simple(std::move(name), "a text", std::move(doc), field, read_text, write_text);
  }
  Fields& name(std::string name, std::string T::*field, std::string doc) {
    return simple(std::move(name), "a name", std::move(doc), field, read_name, write_text)
        .left_out_if_empty(field);
  }
  Fields& flag(std::string name, bool T::*field, std::string doc) {
    return simple(std::move(name), "`true` or `false`", std::move(doc), field, read_flag, write_flag);
  }
  Fields& number(std::string name, double T::*field, std::string doc) {
    return simple(std::move(name), "a number", std::move(doc), field, read_number, write_number);
  }
  template <class Int> Fields& integer(std::string name, Int T::*field, std::string doc) {
    simple(std::move(name), "a whole number", std::move(doc), field, read_integer,
           [](Int i) { return std::to_string(i); });
    return range({0, 2147483647.0});
  }
  Fields& quantity(std::string name, double T::*field, Dimension dimension, std::string doc) {
    simple(std::move(name), std::string(units::info(dimension).noun), std::move(doc), field, read_quantity,
           [dimension](double v) { return write_quantity(v, dimension); });
    return of(dimension);
  }
  Fields& axis(std::string name, int T::*field, std::string doc) {
    return simple(std::move(name), "`x`, `y` or `z`", std::move(doc), field, read_axis, write_axis);
  }
  Fields& direction(std::string name, Vec3 T::*field, std::string doc) {
    return simple(std::move(name), "three numbers; their length has no meaning", std::move(doc), field,
                  read_direction, write_direction);
  }
  Fields& point(std::string name, Vec3 T::*field, std::string doc) {
    return vector(std::move(name), field, Dimension::length, std::move(doc), "three lengths");
  }
  Fields& vector(std::string name, Vec3 T::*field, Dimension dimension, std::string doc,
                 std::string type = {}) {
    if (type.empty()) type = fmt::format("three times {}", units::info(dimension).noun);
    simple(std::move(name), std::move(type), std::move(doc), field, read_quantities,
           [dimension](Vec3 v) { return write_quantities(v, dimension); });
    return of(dimension);
  }
  Fields& texts(std::string name, std::vector<std::string> T::*field, std::string doc) {
    return simple(std::move(name), "an array of names", std::move(doc), field, read_texts, write_texts)
        .left_out_if_empty(field);
  }
  /// A word that stands for a value of an enumeration (or a text, or a number).
  template <class V> Fields& word(std::string name, V T::*field, Words<V> words, std::string doc) {
    std::vector<std::string_view> known;
    for (auto const& w : words) known.push_back(w.first);
    auto const read = [words, known, field](Reader& r, Node const& n, Key const& k, T& record) {
      if (auto const i = read_word(r, n, k, known)) record.*field = words[*i].second;
    };
    auto const write = [words, field](T const& record) -> Written {
      for (auto const& w : words)
        if (w.second == record.*field) return write_text(w.first);
      return std::nullopt;
    };
    return custom(std::move(name), listed(known), std::move(doc), read, write);
  }
  /// Anything else: read(Reader&, Node const&, Key const&, T&), write(T const&) -> optional TOML text.
  template <class Read, class Write>
  Fields& custom(std::string name, std::string type, std::string doc, Read read, Write write) {
    Key key;
    key.name = std::move(name);
    key.type = std::move(type);
    key.doc = std::move(doc);
    key.read = [read](Reader& r, Node const& n, Key const& k, void* record) {
      read(r, n, k, *static_cast<T*>(record));
    };
    key.write = [write](void const* record) -> Written { return write(*static_cast<T const*>(record)); };
    keys.push_back(std::move(key));
    return *this;
  }
  /// Where something is.
  Fields& selector(std::string name, model::Selector T::*field, std::string doc);
  /// A function of time whose values have this dimension.
  Fields& curve(std::string name, model::Curve T::*field, Dimension dimension, std::string doc);

  // What holds for the key just added.
  Fields& required() { return keys.back().required = true, *this; }
  Fields& range(Range r) { return keys.back().range = r, *this; }
  Fields& positive() { return range({0, HUGE_VAL, true, false}); }
  Fields& not_negative() { return range({0, HUGE_VAL}); }
  Fields& of(Dimension d) { return keys.back().dimension = d, *this; }
  /// What the reference page says instead of the initial value.
  Fields& default_is(std::string note) { return keys.back().default_note = std::move(note), *this; }
  /// The echo leaves the key out where shown(record) is false.
  template <class Shown> Fields& echoed_if(Shown shown) {
    keys.back().write = [shown, write = keys.back().write](void const* record) -> Written {
      return shown(*static_cast<T const*>(record)) ? write(record) : std::nullopt;
    };
    return *this;
  }

 private:
  template <class V> Fields& left_out_if_empty(V T::*field) {
    return echoed_if([field](T const& record) { return !(record.*field).empty(); });
  }
  template <class V, class Read, class Write>
  Fields& simple(std::string name, std::string type, std::string doc, V T::*field, Read read, Write write) {
    return custom(
        std::move(name), std::move(type), std::move(doc),
        [field, read](Reader& r, Node const& n, Key const& k, T& record) {
          if (auto value = read(r, n, k)) record.*field = static_cast<V>(std::move(*value));
        },
        [field, write](T const& record) -> Written { return write(record.*field); });
  }

  std::vector<Key>& keys;
};

void read_selector(Reader&, Node const&, Key const&, model::Selector&);
void read_curve(Reader&, Node const&, Key const&, units::Dimension, model::Curve&);
void read_record(Reader&, Node const&, Key const&, model::RecordSpec&);
void read_path(Reader&, Node const&, Key const&, model::PathSpec&);
/// "{key = value, ...}"
std::string write_shape(Shape const&, void const* record);
std::string write_selector(model::Selector const&);
std::string write_curve(model::Curve const&, units::Dimension);

template <class T>
Fields<T>& Fields<T>::selector(std::string name, model::Selector T::*field, std::string doc) {
  return custom(
      std::move(name), "a selector", std::move(doc),
      [field](Reader& r, Node const& n, Key const& k, T& record) { read_selector(r, n, k, record.*field); },
      [field](T const& record) -> Written { return write_selector(record.*field); });
}

template <class T>
Fields<T>& Fields<T>::curve(std::string name, model::Curve T::*field, Dimension dimension, std::string doc) {
  return custom(
      std::move(name), fmt::format("a curve of {}", units::info(dimension).noun), std::move(doc),
      [field, dimension](Reader& r, Node const& n, Key const& k, T& record) {
        read_curve(r, n, k, dimension, record.*field);
      },
      [field, dimension](T const& record) -> Written { return write_curve(record.*field, dimension); });
}

/// A section with one record per [[path]].
template <class T>
Section many_section(std::string path, std::vector<T> model::Case::*field, std::string doc) {
  Section s;
  s.path = std::move(path);
  s.many = true;
  s.doc = std::move(doc);
  s.make = [field](model::Case& c, std::size_t n) { (c.*field).resize(n); };
  s.count = [field](model::Case const& c) { return (c.*field).size(); };
  s.record = [field](model::Case& c, std::size_t i) -> void* { return &(c.*field)[i]; };
  s.set_place = [](void* record, core::Place const& place) { static_cast<T*>(record)->place = place; };
  return s;
}

/// A section that stands once, [path].
template <class T> Section single_section(std::string path, T model::Case::*field, std::string doc) {
  Section s;
  s.path = std::move(path);
  s.doc = std::move(doc);
  s.make = [](model::Case&, std::size_t) {};
  s.count = [](model::Case const&) { return std::size_t{1}; };
  s.record = [field](model::Case& c, std::size_t) -> void* { return &(c.*field); };
  s.set_place = [](void* record, core::Place const& place) {
    if constexpr (requires(T t) { t.place; }) static_cast<T*>(record)->place = place;
  };
  return s;
}

} // namespace fissura::deck
