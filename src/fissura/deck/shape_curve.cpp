// {value = "30 mm", over = "0.5 s"} and its kin: how something changes in time.
#include <fmt/core.h>

#include <algorithm>

#include "fissura/deck/fields.hpp"
#include "fissura/deck/files.hpp"
#include "fissura/model/series.hpp"

namespace fissura::deck {
namespace {

using model::Curve;
using Kind = Curve::Kind;
using Written = std::optional<std::string>;
using units::Dimension;

constexpr std::size_t most_rows = 1000000;

void read_value(Reader& r, Node const& n, Key const& k, CurveDraft& draft) {
  draft.curve.value = read_quantity(r, n, Wanted(k.name, draft.dimension)).value_or(0);
}

void read_over(Reader& r, Node const& n, Key const& k, CurveDraft& draft) {
  draft.curve.over = read_quantity(r, n, k).value_or(0);
  draft.curve.kind = Kind::ramp;
}

void read_row(Reader& r, Node const& row, CurveDraft& draft) {
  if (!read_array(r, row, Wanted("a row of table"), 2)) return;
  auto const time = read_quantity(r, row.items[0], Wanted("time", Dimension::time));
  auto const value = read_quantity(r, row.items[1], Wanted("value", draft.dimension));
  if (!time || !value) return;
  auto& times = draft.curve.times;
  if (*time < 0) return r.error(row.items[0], "the times of `table` start at 0 s or later");
  if (!times.empty() && *time <= times.back())
    return r.error(row.items[0], "the times of `table` must increase from row to row");
  times.push_back(*time);
  draft.curve.values.push_back(*value);
}

void read_table(Reader& r, Node const& n, Key const& k, CurveDraft& draft) {
  draft.curve.kind = Kind::table;
  if (!read_array(r, n, k, 0, most_rows)) return;
  for (auto const& row : n.items) read_row(r, row, draft);
}

void read_cycles(Reader& r, Node const& n, Key const& k, CurveDraft& draft) {
  draft.curve.kind = Kind::cycles;
  if (!read_array(r, n, k, 0)) return;
  for (auto const& item : n.items)
    if (auto const peak = read_quantity(r, item, Wanted("cycles", draft.dimension)))
      draft.curve.peaks.push_back(*peak);
}

std::string unit_example(CurveDraft const& d) {
  auto const& usual = units::info(d.dimension).echo.back().name;
  return fmt::format("\"{}\"", usual);
}

void take_file(Reader& reader, CurveDraft& d, std::string const& file, model::SeriesFormat const& format) {
  constexpr std::size_t most = 200000; // the echo of the deck holds them as a table
  try {
    auto series = model::parse_series(model::read_series_text(file, format.what), file, format);
    if (series.times.size() > most)
      return reader.error(reader.place(&d, "file"),
                          fmt::format("\"{}\" has {} values; at most {} are allowed: thin it out", d.file,
                                      series.times.size(), most));
    if (series.times.front() < 0)
      return reader.error(reader.place(&d, "file"),
                          fmt::format("the times of \"{}\" begin at {} s; they start at 0 s or later", d.file,
                                      series.times.front()));
    auto& c = reader.the_case;
    auto const [low, high] = std::minmax_element(series.values.begin(), series.values.end());
    c.notes.push_back(fmt::format("`{}` from \"{}\": {}, {} to {}", d.key, d.file,
                                  model::extent_of(series.times), units::from_si(*low, d.dimension),
                                  units::from_si(*high, d.dimension)));
    c.notes.insert(c.notes.end(), series.notes.begin(), series.notes.end());
    c.warnings.insert(c.warnings.end(), series.warnings.begin(), series.warnings.end());
    d.curve.kind = Kind::table;
    d.curve.times = std::move(series.times), d.curve.values = std::move(series.values);
  } catch (core::InputError const& e) {
    for (auto const& found : e.diagnostics) reader.error(found.place, found.message);
  }
}

Written write_table(CurveDraft const& d) {
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < d.curve.times.size(); ++i)
    rows.push_back(write_array(
        {write_quantity(d.curve.times[i], Dimension::time), write_quantity(d.curve.values[i], d.dimension)}));
  return write_array(rows);
}

Written write_cycles(CurveDraft const& d) {
  std::vector<std::string> peaks;
  for (double const p : d.curve.peaks) peaks.push_back(write_quantity(p, d.dimension));
  return write_array(peaks);
}

/// The file becomes a table: the echo of the deck needs it no longer.
void read_file(Reader& reader, Node const& table, CurveDraft& d) {
  bool const columns = reader.given(&d, "columns"), step = reader.given(&d, "time_step");
  if (!reader.given(&d, "unit"))
    reader.error(table,
                 fmt::format("a `file` needs `unit`, the unit of its values, e.g. {}", unit_example(d)));
  if (step && columns && d.time_column > 0)
    reader.error(reader.place(&d, "time_step"), "`time_step` is for files without times: give `columns` the "
                                                "column of the values only");
  if (!step && columns && d.time_column == 0)
    reader.error(table, "a file without a column of times needs `time_step`");
  std::size_t const before = reader.errors();
  auto const file = resolve_file(reader, reader.place(&d, "file"), d.file, d.allow_outside, "file",
                                 fmt::format("`{}`", d.key));
  if (reader.errors() > before || !reader.good(&d, {"unit", "columns", "time_step"})) return;
  model::SeriesFormat format;
  format.time_column = d.time_column, format.value_column = d.value_column;
  if (step && !columns) format.time_column = format.value_column = 0;
  format.time_step = d.time_step, format.unit = d.unit;
  format.as_header_says = !step && !columns;
  take_file(reader, d, file, format);
}

void check_one_kind(Reader& reader, Node const& table, void* record) {
  auto const given = [&](std::string_view key) { return reader.given(record, key); };
  int count = 0;
  for (auto const key : {"value", "table", "cycles", "file"}) count += given(key) ? 1 : 0;
  if (count != 1) reader.error(table, "a curve has exactly one of `value`, `table`, `cycles` or `file`");
  if (given("over") && !given("value"))
    reader.error(reader.place(record, "over"), "`over` belongs to `value`");
  for (auto const key : {"period", "repeats", "one_sided"})
    if (given(key) && !given("cycles"))
      reader.error(reader.place(record, key), fmt::format("`{}` belongs to `cycles`", key));
  if (given("cycles") && !given("period"))
    reader.error(table, "`cycles` needs `period`, the duration of one full cycle");
  for (auto const key : {"unit", "columns", "time_step", "allow_outside"})
    if (given(key) && !given("file"))
      reader.error(reader.place(record, key), fmt::format("`{}` belongs to `file`", key));
  if (count == 1 && given("file") && reader.good(record, {"file"}))
    read_file(reader, table, *static_cast<CurveDraft*>(record));
}

Written unwritten(CurveDraft const&) {
  return std::nullopt; // the echo writes the table
}

void add_file(Fields<CurveDraft>& f) {
  f.custom(
      "file", "a text",
      "A text file with a time [s] and a value in each row, relative to the folder of the deck; at most 64 "
      "MiB and 200,000 values.",
      [](Reader& r, Node const& n, Key const& k, CurveDraft& d) { d.file = read_text(r, n, k).value_or(""); },
      unwritten);
  f.custom(
      "unit", "a unit of the key's dimension", "Unit of the values; required with `file`.",
      [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
        d.unit = read_unit(r, n, k, d.dimension, unit_example(d)).value_or(1);
      },
      unwritten);
  f.custom(
       "columns", "one or two whole numbers",
       "Columns of time and value, from 1; `[1, 2]` unless said or the header names a step. One number: the "
       "value, with `time_step`.",
       [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
         read_columns(r, n, k, "value", d.time_column, d.value_column);
       },
       unwritten)
      .range({1, 1000});
  f.custom(
       "time_step", "a time",
       "For files without times. Without `columns` all numbers of all rows are read, row after row.",
       [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
         d.time_step = read_quantity(r, n, k).value_or(0);
       },
       unwritten)
      .of(Dimension::time)
      .positive();
  f.custom(
      "allow_outside", "`true` or `false`",
      "Lets `file` lie outside the folder of the deck; `false` unless said.",
      [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
        d.allow_outside = read_flag(r, n, k).value_or(false);
      },
      unwritten);
}

Shape make_shape() {
  Shape shape;
  shape.name = "a curve";
  shape.doc =
      "A function of the time since its stage began: 0 before, its last value afterwards. A constant "
      "is `{value}` or the plain "
      "value; a smooth ramp (no jump in velocity or acceleration) is `{value, over}`; `{table}` is "
      "linear between its "
      "rows; `{cycles, period}` visits each amplitude in turn; `{file, unit}` is the table of a text file, "
      "with the format of a record: see below. The echo of the deck holds its rows.";
  shape.finish = check_one_kind;
  auto const of = [](Kind kind) { return [kind](CurveDraft const& d) { return d.curve.kind == kind; }; };
  Fields<CurveDraft> f(shape.keys);
  f.custom("value", "a value of the key's dimension", "The constant, or the plateau of the ramp.", read_value,
           [](CurveDraft const& d) -> Written { return write_quantity(d.curve.value, d.dimension); })
      .echoed_if(
          [](CurveDraft const& d) { return d.curve.kind == Kind::constant || d.curve.kind == Kind::ramp; });
  f.custom("over", "a time", "Rise time of the ramp.", read_over,
           [](CurveDraft const& d) -> Written { return write_quantity(d.curve.over, Dimension::time); })
      .of(Dimension::time)
      .positive()
      .echoed_if(of(Kind::ramp));
  f.custom("table", "rows of a time and a value", "Times increase; linear between.", read_table, write_table)
      .echoed_if(of(Kind::table));
  f.custom("cycles", "an array of values", "Amplitudes, visited `repeats` times each.", read_cycles,
           write_cycles)
      .echoed_if(of(Kind::cycles));
  f.custom(
       "period", "a time", "Duration of one full cycle.",
       [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
         d.curve.period = read_quantity(r, n, k).value_or(0);
       },
       [](CurveDraft const& d) -> Written { return write_quantity(d.curve.period, Dimension::time); })
      .of(Dimension::time)
      .positive()
      .echoed_if(of(Kind::cycles));
  f.custom(
       "repeats", "a whole number", "How often each amplitude is visited; 1 unless said.",
       [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
         d.curve.repeats = static_cast<int>(read_integer(r, n, k).value_or(1));
       },
       [](CurveDraft const& d) -> Written { return std::to_string(d.curve.repeats); })
      .range({1, 1e6})
      .echoed_if(of(Kind::cycles));
  f.custom(
       "one_sided", "`true` or `false`", "`true`: 0, +a, 0 instead of 0, +a, -a, 0; `false` unless said.",
       [](Reader& r, Node const& n, Key const& k, CurveDraft& d) {
         d.curve.one_sided = read_flag(r, n, k).value_or(false);
       },
       [](CurveDraft const& d) -> Written { return write_flag(d.curve.one_sided); })
      .echoed_if(of(Kind::cycles));
  add_file(f);
  return shape;
}

} // namespace

Shape const& curve_shape() {
  static Shape const shape = make_shape();
  return shape;
}

void read_curve(Reader& reader, Node const& node, Key const& key, Dimension dimension, Curve& curve) {
  if (node.kind != Node::Kind::table) {
    // The plain value stands for a constant; its message also covers what is no curve at all.
    curve = Curve{};
    curve.value = read_quantity(reader, node, Wanted(key.name, dimension)).value_or(0);
    return;
  }
  CurveDraft draft{{}, dimension, key.name};
  reader.read_shape(curve_shape(), node, &draft);
  curve = std::move(draft.curve);
}

} // namespace fissura::deck
