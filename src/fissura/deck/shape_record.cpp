// {file = "record.txt", unit = "g"}: a motion by an acceleration record.
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"
#include "fissura/deck/files.hpp"

namespace fissura::deck {
namespace {

using model::RecordSpec;
using Baseline = RecordSpec::Baseline;
using Written = std::optional<std::string>;
using units::Dimension;

void read_record_columns(Reader& r, Node const& n, Key const& k, RecordSpec& record) {
  read_columns(r, n, k, "acceleration", record.time_column, record.acceleration_column);
}

Written write_columns(RecordSpec const& record) {
  if (record.acceleration_column == 0) return std::nullopt;
  std::vector<std::string> items;
  if (record.time_column > 0) items.push_back(std::to_string(record.time_column));
  items.push_back(std::to_string(record.acceleration_column));
  return write_array(items);
}

void read_record_unit(Reader& r, Node const& n, Key const& k, RecordSpec& record) {
  if (auto const unit = read_unit(r, n, k, Dimension::acceleration, "\"g\" or \"cm/s2\""))
    record.unit = *unit;
}

void finish_record(Reader& reader, Node const& table, void* data) {
  auto& record = *static_cast<RecordSpec*>(data);
  bool const columns = reader.given(data, "columns"), step = reader.given(data, "time_step");
  record.as_header_says = !step && !columns;
  if (step && !columns) record.time_column = record.acceleration_column = 0;
  if (step && columns && record.time_column > 0)
    reader.error(reader.place(data, "time_step"),
                 "`time_step` is for records without times: give `columns` the column "
                 "of the acceleration only");
  if (!step && columns && record.time_column == 0 && reader.good(data, {"columns"}))
    reader.error(table, "a record without a column of times needs `time_step`");
  if (reader.good(data, {"file"}) && !record.file.empty())
    record.file = resolve_file(reader, reader.place(data, "file"), record.file, record.allow_outside,
                               "record", "`acceleration`");
}

Shape make_shape() {
  Shape shape;
  shape.name = "a record";
  shape.doc =
      "A motion by an acceleration record: a text file with a time [s] and an acceleration in each row, "
      "between which it "
      "is linear. Numbers are parted by spaces, commas or semicolons; Fortran's exponents (1.2D-3) are read, "
      "decimal commas are refused. Lines that begin with #, %, ! or // and lines before the first row are "
      "skipped, but what they say of step, count and unit (`NPTS= 4000, DT= .0050 SEC`, a first row `4000 "
      "0.005`) is compared with the deck and with the rows. Where neither `columns` nor `time_step` is "
      "given, a step in the header stands for both. PGA, count and step stand in the log. Velocity and "
      "displacement are the exact integrals from rest; after "
      "its end "
      "the velocity stays as it is. Three motions with three records shake a base in three directions.";
  shape.finish = finish_record;
  Fields<RecordSpec> f(shape.keys);
  f.text("file", &RecordSpec::file, "The record, relative to the folder of the deck; at most 64 MiB.")
      .required();
  f.custom("unit", "a unit of acceleration, e.g. `g`", "Unit of the record.", read_record_unit,
           [](RecordSpec const& r) -> Written { return write_quantity(r.unit, Dimension::acceleration); })
      .required();
  f.custom("columns", "one or two whole numbers",
           "Columns of time and acceleration, from 1; `[1, 2]` unless said or the header names a step. One "
           "number: the acceleration, with `time_step`.",
           read_record_columns, write_columns)
      .range({1, 1000});
  f.quantity("time_step", &RecordSpec::time_step, Dimension::time,
             "For records without times. Without `columns` all numbers of all rows are read, row after row.")
      .positive()
      .echoed_if([](RecordSpec const& r) { return r.time_step > 0; });
  f.quantity("pga", &RecordSpec::pga, Dimension::acceleration,
             "Scales the record to this largest acceleration; as it is unless said.")
      .positive()
      .echoed_if([](RecordSpec const& r) { return r.pga > 0; });
  f.word("baseline", &RecordSpec::baseline,
         {{"none", Baseline::none},
          {"mean", Baseline::mean},
          {"linear", Baseline::linear},
          {"quadratic", Baseline::quadratic}},
         "Takes a constant, a line or a parabola out of the acceleration so that the velocity ends at zero "
         "(and else "
         "stays least); `none` unless said.");
  f.quantity("start", &RecordSpec::start, Dimension::time,
             "The record begins this long after its stage; 0 s unless said.")
      .not_negative();
  // The echo lies in the run's folder and names the file by its full path: it must allow that.
  f.custom(
      "allow_outside", "`true` or `false`",
      "Lets `file` lie outside the folder of the deck; `false` unless said.",
      [](Reader& r, Node const& n, Key const& k, RecordSpec& record) {
        record.allow_outside = read_flag(r, n, k).value_or(false);
      },
      [](RecordSpec const&) -> Written { return write_flag(true); });
  return shape;
}

} // namespace

Shape const& record_shape() {
  static Shape const shape = make_shape();
  return shape;
}

void read_record(Reader& reader, Node const& node, Key const& key, RecordSpec& record) {
  record.place = node.place;
  if (node.kind == Node::Kind::table) return reader.read_shape(record_shape(), node, &record);
  reader.error(node, fmt::format("`{}` must be a table, e.g. {{file = \"record.txt\", unit = \"g\"}}, not {}",
                                 key.name, shown(node)));
}

} // namespace fissura::deck
