// {value = "30 mm", over = "0.5 s"} and its kin: how something changes in time.
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"

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

void check_one_kind(Reader& reader, Node const& table, void* record) {
  auto const given = [&](std::string_view key) { return reader.given(record, key); };
  int const count = (given("value") ? 1 : 0) + (given("table") ? 1 : 0) + (given("cycles") ? 1 : 0);
  if (count != 1) reader.error(table, "a curve has exactly one of `value`, `table` or `cycles`");
  if (given("over") && !given("value"))
    reader.error(reader.place(record, "over"), "`over` belongs to `value`");
  for (auto const key : {"period", "repeats", "one_sided"})
    if (given(key) && !given("cycles"))
      reader.error(reader.place(record, key), fmt::format("`{}` belongs to `cycles`", key));
  if (given("cycles") && !given("period"))
    reader.error(table, "`cycles` needs `period`, the duration of one full cycle");
}

Shape make_shape() {
  Shape shape;
  shape.name = "a curve";
  shape.doc = "A function of the time since its stage began: 0 before, its last value afterwards. A constant "
              "is `{value}` or the plain "
              "value; a smooth ramp (no jump in velocity or acceleration) is `{value, over}`; `{table}` is "
              "linear between its "
              "rows; `{cycles, period}` visits each amplitude in turn.";
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
  CurveDraft draft{{}, dimension};
  reader.read_shape(curve_shape(), node, &draft);
  curve = std::move(draft.curve);
}

} // namespace fissura::deck
