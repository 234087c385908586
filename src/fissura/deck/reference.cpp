#include <fmt/core.h>

#include "fissura/deck/deck.hpp"
#include "fissura/deck/schema.hpp"

namespace fissura::deck {
namespace {

constexpr char const* introduction = R"(# The deck

<!-- Written from the schema in src/fissura/deck: change it there, then run tools/check_deck_reference.sh --update BUILD. -->

A case is one TOML file, the deck. Every quantity is a text with its unit, such as `"29.73 GPa"`, `"12 mm"` or
`"2500 kg/m3"`; any unit of the right dimension will do, and a missing or wrong one is an error. Pure numbers are plain.
`[run]` stands once; `[[bar]]` may stand several times. Names refer to each other: the `steel` of a bar, the `stage` of a
load, the `gauge` of a stop.

`fissura check CASE.toml` reports all errors at once with file, line and column. `--set key.path=value` changes a value on
the command line; items of `[[...]]` are numbered from 0: `--set concrete.0.penalty=60`, `--set run.end_time="2 s"`.
The run folder holds an echo of the deck, `case.toml`, with every default. Units follow UDUNITS-2; `deg` is an angle.

A small deck:

```toml
title = "A prism in tension"

[[mesh.box]]
from = ["0 m", "0 m", "0 m"]
to = ["1 m", "0.2 m", "0.2 m"]
cells = [10, 2, 2]

[[concrete]]
E = "30 GPa"
f_t = "3 MPa"
f_c = "30 MPa"

[[support]]
where = {plane = "x", at = "0 m"}
fix = ["x", "y", "z"]

[[motion]]
name = "pull"
where = {plane = "x", at = "1 m"}
axis = "x"
displacement = {value = "0.2 mm", over = "50 ms"}

[run]
end_time = "60 ms"

[[gauge]]
name = "load"
kind = "reaction"
of = ["pull"]
axis = "x"
```
)";

std::string default_text(Key const& key, void const* record) {
  if (key.required) return "required";
  if (!key.default_note.empty()) return key.default_note;
  auto const written = key.write(record);
  return written ? fmt::format("`{}`", *written) : "none";
}

std::string table(std::vector<Key> const& keys, void const* record, bool with_default) {
  std::string text = with_default
                         ? "| key | value | default | admissible | meaning |\n|---|---|---|---|---|\n"
                         : "| key | value | admissible | meaning |\n|---|---|---|---|\n";
  for (auto const& key : keys) {
    std::string const range = key.range.limited() ? to_string(key.range, key.dimension) : "";
    text += fmt::format("| `{}` | {} |", key.name, key.type);
    if (with_default) text += fmt::format(" {} |", default_text(key, record));
    text += fmt::format(" {} | {} |\n", range, key.doc);
  }
  return text;
}

std::string section_text(Section const& section) {
  model::Case fresh;
  section.make(fresh, 1);
  std::string const heading = section.path.empty() ? "Top of the deck" : title(section);
  return fmt::format("\n## {}\n\n{}\n\n{}", heading, section.doc,
                     table(section.keys, section.record(fresh, 0), true));
}

std::string shape_text(Shape const& shape, std::string_view heading) {
  return fmt::format("\n## {}\n\n{}\n\n{}", heading, shape.doc, table(shape.keys, nullptr, false));
}

constexpr char const* examples = R"(
```toml
where = {group = "left"}
where = {plane = "x", at = "0 m"}
where = {box = [["0 m", "0 m", "0 m"], ["1 m", "0.1 m", "0.1 m"]]}
where = {point = ["1 m", "0 m", "0 m"]}
where = {line = [["1 m", "0 m", "0 m"], ["1 m", "0.2 m", "0 m"]], tolerance = "1 mm"}
```
)";

constexpr char const* curve_examples = R"(
```toml
displacement = {value = "30 mm", over = "0.5 s"}
displacement = {table = [["0 s", "0 mm"], ["1 s", "2 mm"]]}
displacement = {cycles = ["1 mm", "2 mm"], period = "0.1 s", repeats = 2}
displacement = {file = "jack.txt", unit = "mm", time_step = "10 ms"}
acceleration = "9.81 m/s2"
```
)";

constexpr char const* path_example = R"(
```toml
path = {speed = "0.1 m/s", turn = "5 ms", to = [
  {gauge = "mean_strain", value = 0.002}, {gauge = "force", value = "0 N"},
  {gauge = "mean_strain", value = 0.005}, {gauge = "force", value = "0 N"}]}
path = {of = "right", scale = -1}
```
)";

constexpr char const* record_example = R"(
```toml
acceleration = {file = "record.txt", unit = "g", pga = "0.3 g", baseline = "linear"}
acceleration = {file = "record.at2", unit = "g", time_step = "10 ms"}
```
)";

} // namespace

std::string reference_markdown() {
  std::string text = introduction;
  text += shape_text(selector_shape(), "Selectors");
  text += examples;
  text += shape_text(curve_shape(), "Curves");
  text += curve_examples;
  text += shape_text(path_shape(), "Paths");
  text += path_example;
  text += shape_text(record_shape(), "Records");
  text += record_example;
  for (auto const& section : schema()) text += section_text(section);
  return text;
}

} // namespace fissura::deck
