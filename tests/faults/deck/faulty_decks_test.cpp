#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"

namespace {
using namespace fissura;

// A sound deck; each fault replaces one piece of it. The lines are numbered from 1.
std::string const sound = R"(title = "faults"
[[mesh.box]]
from = ["0 m", "0 m", "0 m"]
to = ["1 m", "0.2 m", "0.2 m"]
cells = [10, 2, 2]
[[concrete]]
name = "C30"
E = "30 GPa"
f_t = "3 MPa"
f_c = "30 MPa"
[[steel]]
name = "S500"
f_y = "500 MPa"
f_u = "550 MPa"
[[bar]]
name = "tie"
steel = "S500"
diameter = "12 mm"
points = [["0 m", "0.1 m", "0.1 m"], ["1 m", "0.1 m", "0.1 m"]]
[[stage]]
name = "pull"
duration = "1 s"
[[support]]
name = "left"
where = {plane = "x", at = "0 m"}
fix = ["x", "y", "z"]
[[motion]]
name = "right"
stage = "pull"
where = {plane = "x", at = "1 m"}
axis = "x"
displacement = {value = "1 mm", over = "0.5 s"}
[[force]]
name = "push"
where = {point = ["1 m", "0 m", "0 m"]}
direction = [0, 0, -1]
force = "1 kN"
[[gauge]]
name = "load"
kind = "reaction"
of = ["left"]
axis = "x"
[[gauge]]
name = "stress"
kind = "bar"
bar = "tie"
at = ["0.5 m", "0.1 m", "0.1 m"]
[[stop]]
gauge = "load"
falls_to = 0.5
after = "1 kN"
)";

struct Fault {
  std::string what;     // requirement in words
  std::string old_text; // unique in the sound deck
  std::string new_text;
  std::string expected; // "line:column: error: start of the message"
};

std::vector<Fault> const faults{
    // Spelling.
    {"unknown key with its nearest", "diameter = \"12 mm\"", "diamter = \"12 mm\"\narea = \"1 cm2\"",
     "18:1: error: unknown key `diamter` in [[bar]]; did you mean `diameter`?"},
    {"unknown section with its nearest", "[[stop]]", "[[stpo]]",
     "48:3: error: unknown key `stpo` in the top of the deck; did you mean `stop`?"},
    {"key of another section", "fix = [\"x\", \"y\", \"z\"]", "fix = [\"x\"]\nend_time = \"1 s\"",
     "27:1: error: unknown key `end_time` in [[support]]; it belongs to [run]"},
    {"unknown word with its nearest", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\njoint_law = \"papper\"",
     "10:13: error: `joint_law` must be `energy_consistent` or `paper`, not \"papper\"; did you mean "
     "`paper`?"},
    {"unknown rate factor", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nrate_factor = \"mc2100\"",
     "10:15: error: `rate_factor` must be `none` or `mc2010`, not \"mc2100\"; did you mean `mc2010`?"},
    {"unknown axis", "axis = \"x\"\ndisplacement", "axis = \"w\"\ndisplacement",
     "31:8: error: `axis` must be `x`, `y` or `z`, not \"w\""},
    {"misspelt bar quantity", "bar = \"tie\"", "bar = \"tie\"\nquantity = \"joint_stres\"",
     "47:12: error: `quantity` must be"},
    {"single for double brackets", "[[steel]]", "[steel]",
     "11:1: error: a deck may have several `steel`: write [[steel]] with double brackets"},
    {"double for single brackets", "[[stop]]", "[[run]]\nend_time = \"1 s\"\n[[stop]]",
     "48:1: error: `run` stands once: write [run] with single brackets"},
    {"friction between a material that is not there", "[[stop]]",
     "[[contact_pair]]\nmaterials = [\"C30\", \"C40\"]\nfriction = 0.3\n[[stop]]",
     "49:13: error: `materials`: no [[concrete]] is named \"C40\"; did you mean"},
    {"friction between three materials", "[[stop]]",
     "[[contact_pair]]\nmaterials = [\"C30\", \"C30\", \"C30\"]\nfriction = 0.3\n[[stop]]",
     "48:1: error: `materials` of a [[contact_pair]] names two concretes"},
    // Units.
    {"number without unit", "E = \"30 GPa\"", "E = 30e9",
     "8:5: error: `E` needs a unit: a pressure as text, e.g. \"30 GPa\" (30000000000 in SI units is \"30 "
     "GPa\")"},
    {"text without unit", "E = \"30 GPa\"", "E = \"30e9\"",
     "8:5: error: `E` = \"30e9\": `30e9` has no unit; a pressure is expected"},
    {"wrong dimension", "E = \"30 GPa\"", "E = \"30 N\"",
     "8:5: error: `E` = \"30 N\": N is not a pressure; expected e.g. \"30 GPa\""},
    {"slip of the shift key", "f_t = \"3 MPa\"", "f_t = \"3 Mpa\"",
     "9:7: error: `f_t` = \"3 Mpa\": unknown unit `Mpa`; did you mean `MPa`?"},
    {"fracture energy in J", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nG_f = \"100 J\"",
     "10:7: error: `G_f` = \"100 J\": J is not an energy per area"},
    {"unit inside a point", "[\"1 m\", \"0.1 m\", \"0.1 m\"]]", "[\"1 m\", 0.1, \"0.1 m\"]]",
     "19:46: error: `points` needs a unit: a length as text"},
    {"target of a path with the wrong unit", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "path = {speed = \"1 m/s\", turn = \"1 ms\", to = [{gauge = \"load\", value = \"1 mm\"}]}",
     "32:72: error: `value` = \"1 mm\": mm is not a force; expected e.g. \"64 kN\""},
    {"target of a path that names no gauge", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "path = {speed = \"1 m/s\", turn = \"1 ms\", to = [{gauge = \"laod\", value = 1}]}",
     "32:72: error: `gauge`: no [[gauge]] is named \"laod\"; did you mean `load`?"},
    {"path without a target", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "path = {speed = \"1 m/s\", turn = \"1 ms\"}",
     "32:8: error: a path needs `to`, or `of`: the motion whose path it shares"},
    {"shared path with a speed of its own", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "path = {of = \"right\", speed = \"1 m/s\"}",
     "32:31: error: `speed` belongs to the path that `of` names"},
    {"path of a motion that has none",
     "stage = \"pull\"\nwhere = {plane = \"x\", at = \"1 m\"}\naxis = "
     "\"x\"\ndisplacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "where = {plane = \"x\", at = \"1 m\"}\naxis = \"x\"\npath = {of = \"rihgt\"}",
     "31:8: error: `path`: no [[motion]] with a path of its own is named \"rihgt\"; this deck has no "
     "[[motion]] with a path of its own"},
    {"path that is no table", "displacement = {value = \"1 mm\", over = \"0.5 s\"}", "path = \"to and fro\"",
     "32:8: error: `path` must be a table"},
    {"record without its unit", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\"}",
     "32:16: error: a record needs `unit`: a unit of acceleration, e.g. `g`"},
    {"record of the wrong unit", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"mm\"}",
     "32:44: error: `unit` = \"mm\": mm is not an acceleration"},
    {"record outside the folder", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"../quake.txt\", unit = \"g\"}",
     "32:24: error: the record \"../quake.txt\" lies outside the deck's folder; move it there or set "
     "allow_outside = "
     "true in `acceleration`"},
    {"record that is not there", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"cm/s2\"}",
     "32:24: error: there is no record \"quake.txt\" in "},
    {"record without times", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"g\", columns = [2]}",
     "32:16: error: a record without a column of times needs `time_step`"},
    {"record with a column twice", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"g\", columns = [2, 2]}",
     "32:59: error: `columns` names the same column twice"},
    {"threshold of the wrong dimension", "after = \"1 kN\"", "after = \"1 mm\"",
     "51:9: error: `after` = \"1 mm\": mm is not a force; expected e.g. \"64 kN\""},
    {"curve of the wrong dimension", "value = \"1 mm\"", "value = \"1 kN\"",
     "32:25: error: `value` = \"1 kN\": kN is not a length"},
    {"temperature", "duration = \"1 s\"", "duration = \"20 degC\"",
     "22:12: error: `duration` = \"20 degC\": degC is not a time"},
    // Types and ranges.
    {"text for a number", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nnu = \"0.2\"",
     "10:6: error: `nu` must be a plain number (without unit and quotes), not \"0.2\""},
    {"number for a text", "name = \"C30\"", "name = 30",
     "7:8: error: `name` must be a text in quotes, not 30"},
    {"text for a flag", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\njoints = \"yes\"",
     "10:10: error: `joints` must be true or false (without quotes), not \"yes\""},
    {"fraction for a whole number", "cells = [10, 2, 2]", "cells = [10, 2.5, 2]",
     "5:14: error: `cells` must be a whole number, not 2.5"},
    {"array of the wrong length", "cells = [10, 2, 2]", "cells = [10, 2]",
     "5:9: error: `cells` must be an array of 3 values, not one of 2"},
    {"no cells", "cells = [10, 2, 2]", "cells = [10, 0, 2]",
     "5:14: error: `cells` must be 1 <= x <= 1000000, not 0"},
    {"too many cells", "cells = [10, 2, 2]", "cells = [1000, 1000, 1000]",
     "5:9: error: `cells` make 1e+09 cells; at most 5e+07 are allowed"},
    {"division of cells", "cells = [10, 2, 2]", "cells = [10, 2, 2]\ntets_per_cell = 5",
     "6:17: error: `tets_per_cell` must be 6 or 24, not 5"},
    {"incompressible", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nnu = 0.5",
     "10:6: error: `nu` must be -1 < x < 0.5, not 0.5"},
    {"negative stiffness", "E = \"30 GPa\"", "E = \"-30 GPa\"",
     "8:5: error: `E` must be > 0, not \"-30 GPa\""},
    {"not a number", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nnu = nan",
     "10:6: error: `nu` must be a plain number"},
    {"flat box", "to = [\"1 m\", \"0.2 m\", \"0.2 m\"]", "to = [\"1 m\", \"0 m\", \"0.2 m\"]",
     "2:1: error: the box has no volume"},
    {"zero direction", "direction = [0, 0, -1]", "direction = [0, 0, 0]",
     "36:13: error: `direction` must be three numbers that are not all zero"},
    {"date", "name = \"C30\"", "name = 1979-05-27",
     "7:8: error: `name` must be a text in quotes, not a date or time of day"},
    // What a record needs.
    {"missing key", "E = \"30 GPa\"\n", "", "6:1: error: [[concrete]] needs `E`: a pressure"},
    {"no tensile strength", "f_t = \"3 MPa\"\n", "", "6:1: error: joints that may crack need `f_t`"},
    {"constant shear without f_s", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nshear = \"constant\"",
     "6:1: error: shear = \"constant\" needs `f_s`"},
    {"f_s without constant shear", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nf_s = \"6 MPa\"",
     "10:7: error: `f_s` is used by shear = \"constant\" only"},
    {"f_u below f_y", "f_u = \"550 MPa\"", "f_u = \"450 MPa\"",
     "14:7: error: `f_u` = 450 MPa must not be less than `f_y` = 500 MPa"},
    {"misordered strains", "f_u = \"550 MPa\"", "f_u = \"550 MPa\"\neps_br = 0.019",
     "15:10: error: `eps_br` = 0.019 must be larger than `eps_u` = 0.1"},
    {"hardening before yield", "f_u = \"550 MPa\"", "f_u = \"550 MPa\"\neps_sh = 0.001",
     "15:10: error: `eps_sh` = 0.001 must be larger than the strain at yield, f_y/E_s = 0.0025"},
    {"bar without section", "diameter = \"12 mm\"\n", "", "15:1: error: [[bar]] needs `diameter` or `area`"},
    {"bar of one point", ", [\"1 m\", \"0.1 m\", \"0.1 m\"]]", "]",
     "19:10: error: `points` needs at least 2 points"},
    {"prestressed beyond yield", "diameter = \"12 mm\"", "diameter = \"12 mm\"\ninitial_strain = 0.0025",
     "19:18: error: `initial_strain` = 0.0025 must be smaller than the strain at yield of steel \"S500\", "
     "f_y/E_s "
     "= 0.0025: the bar would have yielded before the run begins. Give a smaller strain, or the bar a "
     "stronger "
     "steel"},
    {"shortened beyond yield", "diameter = \"12 mm\"", "diameter = \"12 mm\"\ninitial_strain = -0.003",
     "19:18: error: `initial_strain` = -0.003 must be smaller than the strain at yield of steel \"S500\""},
    {"copies without spacing", "diameter = \"12 mm\"", "diameter = \"12 mm\"\ncount = 3",
     "19:9: error: 3 bars need `spacing`"},
    {"two kinds of selector", "where = {plane = \"x\", at = \"0 m\"}",
     "where = {plane = \"x\", at = \"0 m\", group = \"a\"}", "25:9: error: a selector has only one of"},
    {"plane without place", "where = {plane = \"x\", at = \"0 m\"}", "where = {plane = \"x\"}",
     "25:9: error: `plane` needs `at`"},
    {"text for a selector", "where = {plane = \"x\", at = \"0 m\"}", "where = \"left\"",
     "25:9: error: `where` must be a selector, e.g. {group = \"left\"}, not \"left\""},
    {"ramp and table", "over = \"0.5 s\"}", "over = \"0.5 s\", table = [[\"0 s\", \"0 m\"]]}",
     "32:16: error: a curve has exactly one of `value`, `table`, `cycles` or `file`"},
    {"file without its unit", "{value = \"1 mm\", over = \"0.5 s\"}", "{file = \"u.txt\"}",
     "32:16: error: a `file` needs `unit`, the unit of its values, e.g. \"mm\""},
    {"file that is not there", "{value = \"1 mm\", over = \"0.5 s\"}", "{file = \"u.txt\", unit = \"mm\"}",
     "32:24: error: there is no file \"u.txt\" in "},
    {"file outside the folder", "{value = \"1 mm\", over = \"0.5 s\"}",
     "{file = \"../u.txt\", unit = \"mm\"}",
     "32:24: error: the file \"../u.txt\" lies outside the deck's folder; move it there or set allow_outside "
     "= "
     "true in `displacement`"},
    {"file of the wrong unit", "{value = \"1 mm\", over = \"0.5 s\"}", "{file = \"u.txt\", unit = \"g\"}",
     "error: `unit` = \"g\": g is not a length"},
    {"file of no unit", "{value = \"1 mm\", over = \"0.5 s\"}", "{file = \"u.txt\", unit = \"0 mm\"}",
     "error: `unit` = \"0 mm\" is no unit; give e.g. \"mm\""},
    {"file without times", "{value = \"1 mm\", over = \"0.5 s\"}",
     "{file = \"u.txt\", unit = \"mm\", columns = [2]}",
     "32:16: error: a file without a column of times needs `time_step`"},
    {"file with times and a step", "{value = \"1 mm\", over = \"0.5 s\"}",
     "{file = \"u.txt\", unit = \"mm\", columns = [1, 2], time_step = \"1 ms\"}",
     "error: `time_step` is for files without times: give `columns` the column of the values only"},
    {"columns of a ramp", "over = \"0.5 s\"}", "over = \"0.5 s\", columns = [1, 2]}",
     "error: `columns` belongs to `file`"},
    {"value beyond physics", "value = \"1 mm\"", "value = \"1e300 mm\"",
     "error: `value` = \"1e300 mm\" is beyond anything physical: at most 1000000000 m can be computed with"},
    {"frames without end", "[[stop]]", "[output]\nframes_every = \"1e-30 s\"\n[[stop]]",
     "49:16: error: `frames_every` = 1e-27 ms makes 1e+30 frames to 1 s; at most 1e+05 are allowed"},
    {"rows without end", "[[stop]]", "[output]\nhistory_every = \"1e-30 s\"\n[[stop]]",
     "49:17: error: `history_every` = 1e-27 ms makes 1e+30 rows to 1 s; at most 1e+07 are allowed"},
    {"time runs backwards", "{value = \"1 mm\", over = \"0.5 s\"}",
     "{table = [[\"1 s\", \"0 m\"], [\"1 s\", \"1 m\"]]}",
     "32:43: error: the times of `table` must increase"},
    {"cycles without period", "{value = \"1 mm\", over = \"0.5 s\"}", "{cycles = [\"1 mm\"]}",
     "32:16: error: `cycles` needs `period`"},
    {"neither displacement nor velocity", "displacement = {value = \"1 mm\", over = \"0.5 s\"}\n", "",
     "27:1: error: [[motion]] needs one of `displacement`, `velocity`, `acceleration` and `path`"},
    {"gauge without its keys", "at = [\"0.5 m\", \"0.1 m\", \"0.1 m\"]\n", "",
     "43:1: error: a gauge of kind \"bar\" needs `at`"},
    {"gauge with a foreign key", "of = [\"left\"]",
     "of = [\"left\"]\nline = [[\"0 m\", \"0 m\", \"0 m\"], [\"1 m\", \"0 m\", \"0 m\"]]",
     "42:8: error: `line` has no meaning for a gauge of kind \"reaction\""},
    {"stop without condition", "falls_to = 0.5\nafter = \"1 kN\"\n", "",
     "48:1: error: [[stop]] needs `above`, `below` or `falls_to`"},
    // What stands twice, or is missing.
    {"axis fixed twice", "fix = [\"x\", \"y\", \"z\"]", "fix = [\"x\", \"x\"]",
     "26:13: error: `fix` names this axis twice"},
    {"selector of nothing", "where = {plane = \"x\", at = \"0 m\"}", "where = {}",
     "25:9: error: a selector needs one of"},
    {"all that is not all", "where = {plane = \"x\", at = \"0 m\"}", "where = {all = false}",
     "25:16: error: `all` can only be true; leave it out otherwise"},
    {"bars without the concrete's strength", "f_c = \"30 MPa\"\n", "",
     "6:1: error: a material with bars needs `f_c`: bond and dowel follow from it"},
    {"group of two materials", "f_c = \"30 MPa\"",
     "f_c = \"30 MPa\"\ngroups = [\"a\"]\n[[concrete]]\nname = \"C40\"\nE = \"30 GPa\"\nf_t = \"3 "
     "MPa\"\nf_c = \"40 MPa\"\ngroups = [\"a\"]",
     "17:10: error: the group \"a\" has two materials: \"C30\" and \"C40\""},
    {"misspelt crack spacing", "diameter = \"12 mm\"", "diameter = \"12 mm\"\nl_cr = \"auto\"",
     "19:8: error: `l_cr` may also be a length, e.g. \"100 mm\""},
    {"length of the other reduction", "diameter = \"12 mm\"",
     "diameter = \"12 mm\"\nslip_reduction = \"consistent\"\nl_cr = \"100 mm\"",
     "20:8: error: `l_cr` belongs to slip_reduction = \"paper\"; with \"consistent\" leave it out"},
    {"crack spacing of the other reduction", "diameter = \"12 mm\"",
     "diameter = \"12 mm\"\nslip_reduction = \"paper\"\ncrack_spacing = \"200 mm\"",
     "20:17: error: `crack_spacing` belongs to slip_reduction = \"consistent\"; with \"paper\" give `l_cr`"},
    {"bar counted twice", "[\"1 m\", \"0.1 m\", \"0.1 m\"]]\n",
     "[\"1 m\", \"0.1 m\", \"0.1 m\"]]\nslip_reduction = \"consistent\"\n[bars]\nbetween_cracks = "
     "\"elastic\"\n",
     "error: `between_cracks` = \"elastic\" counts the bar between cracks twice"},
    {"misspelt element size", "f_c = \"30 MPa\"", "f_c = \"30 MPa\"\nh = \"edge\"",
     "11:5: error: `h` may also be a length, e.g. \"30 mm\""},
    {"impactor that moves twice along an axis", "[[stop]]",
     "[[impactor]]\nshape = \"sphere\"\nradius = \"0.1 m\"\ncentre = [\"0 m\", \"0 m\", \"1 m\"]\nmass = \"5 "
     "kg\"\nmoves = [\"z\", \"z\"]\n[[stop]]",
     "53:15: error: `moves` names this axis twice"},
    // Each of its own kind.
    {"no mesh",
     "[[mesh.box]]\nfrom = [\"0 m\", \"0 m\", \"0 m\"]\nto = [\"1 m\", \"0.2 m\", \"0.2 m\"]\ncells = [10, "
     "2, 2]\n",
     "", "deck.toml: error: the deck needs a mesh: [mesh] with `file`, or [[mesh.box]]"},
    {"too many cells together", "cells = [10, 2, 2]",
     "cells = [1000, 1000, 40]\n[[mesh.box]]\nfrom = [\"2 m\", \"0 m\", \"0 m\"]\nto = [\"3 m\", \"1 m\", "
     "\"1 m\"]\ncells = [1000, 1000, 40]",
     "error: the boxes make 8e+07 cells together; at most 5e+07 are allowed"},
    {"key of a mesh file without one", "[[mesh.box]]", "[mesh]\nlength_unit = \"mm\"\n[[mesh.box]]",
     "3:15: error: `length_unit` belongs to `file`"},
    {"length unit of no length", "[[mesh.box]]", "[mesh]\nlength_unit = \"0 mm\"\n[[mesh.box]]",
     "3:15: error: `length_unit` must be > 0 m"},
    {"length unit that is none", "[[mesh.box]]", "[mesh]\nlength_unit = \"kg\"\n[[mesh.box]]",
     "3:15: error: `length_unit` = \"kg\": kg is not a length"},
    {"bar without a course", "points = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"1 m\", \"0.1 m\", \"0.1 m\"]]",
     "name_of_points = 1", "15:1: error: [[bar]] needs either `points` or `curve`"},
    {"bar along a curve of boxes",
     "points = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"1 m\", \"0.1 m\", \"0.1 m\"]]", "curve = \"edge\"",
     "19:9: error: `curve` names a curve of a mesh file, and this mesh is made of boxes"},
    {"bar with a point twice", "points = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"1 m\", \"0.1 m\", \"0.1 m\"]]",
     "points = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"0 m\", \"0.1 m\", \"0.1 m\"]]",
     "19:10: error: points 0 and 1 of `points` are the same"},
    {"closed bar that returns itself",
     "points = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"1 m\", \"0.1 m\", \"0.1 m\"]]",
     "closed = true\npoints = [[\"0 m\", \"0.1 m\", \"0.1 m\"], [\"1 m\", \"0.1 m\", \"0.1 m\"], [\"0 m\", "
     "\"0.1 m\", \"0.1 m\"]]",
     "20:10: error: a closed bar returns to its first point by itself"},
    {"gauge along a line of no length", "[[stop]]",
     "[[gauge]]\nname = \"crack\"\nkind = \"crack_width\"\nline = [[\"0 m\", \"0 m\", \"0 m\"], [\"0 m\", "
     "\"0 m\", \"0 m\"]]\n[[stop]]",
     "51:8: error: the two ends of `line` are the same point"},
    {"selector along a line of no length", "where = {plane = \"x\", at = \"0 m\"}",
     "where = {line = [[\"0 m\", \"0 m\", \"0 m\"], [\"0 m\", \"0 m\", \"0 m\"]]}",
     "25:17: error: the two ends of `line` are the same point"},
    {"place without a plane", "where = {plane = \"x\", at = \"0 m\"}",
     "where = {group = \"a\", at = \"0 m\"}", "25:28: error: `at` belongs to `plane` only"},
    {"traction without a direction", "[[stop]]",
     "[[traction]]\nwhere = {plane = \"x\", at = \"1 m\"}\ntraction = \"1 MPa\"\n[[stop]]",
     "48:1: error: [[traction]] needs either `direction` or normal = true"},
    {"strength before hardening", "f_u = \"550 MPa\"", "f_u = \"550 MPa\"\neps_sh = 0.05\neps_u = 0.04",
     "16:9: error: `eps_u` = 0.04 must be larger than `eps_sh` = 0.05"},
    {"impactor that is a flat box", "[[stop]]",
     "[[impactor]]\nshape = \"box\"\nfrom = [\"0 m\", \"0 m\", \"1 m\"]\nto = [\"1 m\", \"1 m\", \"1 "
     "m\"]\nmass = \"5 kg\"\n[[stop]]",
     "51:6: error: `from` and `to` must differ in x, y and z"},
    {"impactor that is a disc of no length", "[[stop]]",
     "[[impactor]]\nshape = \"cylinder\"\nfrom = [\"0 m\", \"0 m\", \"1 m\"]\nto = [\"0 m\", \"0 m\", \"1 "
     "m\"]\nradius = \"0.1 m\"\nmass = \"5 kg\"\n[[stop]]",
     "51:6: error: `from` and `to`, the ends of the axis, are the same point"},
    {"stop before the warning", "[[stop]]", "[run]\nresidual_warn = 0.05\nresidual_stop = 0.01\n[[stop]]",
     "50:17: error: `residual_stop` must not be less than `residual_warn`"},
    {"time before the start", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "displacement = {table = [[\"-1 s\", \"0 m\"], [\"1 s\", \"1 m\"]]}",
     "32:27: error: the times of `table` start at 0 s or later"},
    {"period of a ramp", "over = \"0.5 s\"}", "over = \"0.5 s\", period = \"1 s\"}",
     "error: `period` belongs to `cycles`"},
    {"target of a path that is a word", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "path = {speed = \"1 m/s\", turn = \"1 ms\", to = [\"load\"]}",
     "32:47: error: a target of `to` must be a table"},
    {"scale of a path of its own", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "path = {speed = \"1 m/s\", turn = \"1 ms\", to = [{gauge = \"load\", value = \"1 kN\"}], scale = 2}",
     "error: `scale` belongs to `of`"},
    {"record of three columns", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"g\", columns = [1, 2, 3]}",
     "32:59: error: `columns` must be [time, acceleration] or [acceleration]"},
    {"record with times and a time step", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"g\", columns = [1, 2], time_step = \"10 ms\"}",
     "error: `time_step` is for records without times"},
    {"record that is a text", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = \"quake.txt\"", "32:16: error: `acceleration` must be a table, e.g. {file"},
    {"pace with a ground motion", "displacement = {value = \"1 mm\", over = \"0.5 s\"}",
     "acceleration = {file = \"quake.txt\", unit = \"g\"}\n[run]\npace = 10",
     "error: `pace` is for loading in which inertia does not matter; the deck has acceleration records"},
    {"pace with absorbing boundaries", "[[stop]]",
     "[[absorbing]]\nwhere = {plane = \"z\", at = \"0 m\"}\n[run]\npace = 10\n[[stop]]",
     "error: `pace` is for loading in which inertia does not matter; the deck has absorbing boundaries"},
    // Rigid bodies.
    {"impactor without its shape's keys", "[[stop]]",
     "[[impactor]]\nshape = \"sphere\"\nradius = \"0.1 m\"\nmass = \"5 kg\"\n[[stop]]",
     "48:1: error: a sphere needs `centre`"},
    {"impactor with a key of another shape", "[[stop]]",
     "[[impactor]]\nshape = \"box\"\nfrom = [\"0 m\", \"0 m\", \"1 m\"]\nto = [\"1 m\", \"1 m\", \"2 m\"]\n"
     "radius = \"1 m\"\nmass = \"5 kg\"\n[[stop]]",
     "52:10: error: `radius` has no meaning for a box"},
    {"impactor that leaves its guide", "[[stop]]",
     "[[impactor]]\nshape = \"sphere\"\nradius = \"0.1 m\"\ncentre = [\"0 m\", \"0 m\", \"1 m\"]\nmass = \"5 "
     "kg\"\n"
     "moves = [\"z\"]\nvelocity = [\"1 m/s\", \"0 m/s\", \"-1 m/s\"]\n[[stop]]",
     "54:12: error: `velocity` has a component along x, which `moves` does not name"},
    {"pace with an impactor", "[[stop]]",
     "[[impactor]]\nshape = \"sphere\"\nradius = \"0.1 m\"\ncentre = [\"0 m\", \"0 m\", \"1 m\"]\nmass = \"5 "
     "kg\"\n[run]\npace = 3\n[[stop]]",
     "54:8: error: `pace` is for loading in which inertia does not matter; the deck has impactors, which "
     "happen "
     "in their own time: remove one of the two"},
    {"pace with a body in motion", "[[stop]]",
     "[[initial_velocity]]\nvelocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]\nwhere = {plane = \"x\", at = \"1 "
     "m\"}\n"
     "[run]\npace = 3\n[[stop]]",
     "52:8: error: `pace` is for loading in which inertia does not matter; the deck has initial velocities"},
    {"letter of another alphabet outside quotes", "[[stop]]", "[[sto\xC3\xA4]]",
     "48:6: error: a character that may stand only in quotes or in a comment"},
    {"weight for a mass", "[[stop]]",
     "[[impactor]]\nshape = \"sphere\"\nradius = \"0.1 m\"\ncentre = [\"0 m\", \"0 m\", \"1 m\"]\nmass = \"5 "
     "kN\"\n"
     "[[stop]]",
     "52:8: error: `mass` = \"5 kN\": kN is not a mass; expected e.g. \"250 kg\""},
    {"plane without a normal", "[[stop]]", "[[plane]]\npoint = [\"0 m\", \"0 m\", \"0 m\"]\n[[stop]]",
     "48:1: error: [[plane]] needs `normal`"},
    {"gauge of an unknown body", "of = [\"left\"]\naxis = \"x\"",
     "of = [\"left\"]\naxis = \"x\"\n[[gauge]]\nname = \"f\"\nkind = \"contact_force\"\nof = "
     "[\"flor\"]\naxis = "
     "\"z\"\n[[plane]]\nname = \"floor\"\npoint = [\"0 m\", \"0 m\", \"0 m\"]\nnormal = [0, 0, 1]",
     "46:6: error: `of`: no [[plane]] or [[impactor]] is named \"flor\"; did you mean `floor`?"},
    // Names.
    {"unknown steel", "steel = \"S500\"", "steel = \"S50\"",
     "17:9: error: `steel`: no [[steel]] is named \"S50\"; did you mean `S500`?"},
    {"unknown stage", "stage = \"pull\"", "stage = \"dead\"",
     "29:9: error: `stage`: no [[stage]] is named \"dead\"; there are `pull`"},
    {"unknown gauge", "gauge = \"load\"", "gauge = \"laod\"",
     "49:9: error: `gauge`: no [[gauge]] is named \"laod\"; did you mean `load`?"},
    {"unknown support", "of = [\"left\"]", "of = [\"lefft\"]",
     "41:6: error: `of`: no [[support]] or [[motion]] is named \"lefft\"; did you mean `left`?"},
    {"unknown bar", "bar = \"tie\"", "bar = \"tie\"\ncopy = 1",
     "47:8: error: `copy` = 1: the bar \"tie\" has 1 copies, numbered from 0"},
    {"name taken", "name = \"right\"", "name = \"left\"",
     "28:8: error: the name \"left\" is taken: it stands already at deck.toml:23:1"},
    {"two materials for the rest", "[[steel]]", "[[concrete]]\nE = \"200 GPa\"\njoints = false\n[[steel]]",
     "11:1: error: the materials \"C30\" and \"concrete_2\" have no `groups`"},
    {"no end", "[[stage]]\nname = \"pull\"\nduration = \"1 s\"\n", "[run]\n",
     "20:1: error: the run needs an end"},
    {"box and file", "[[mesh.box]]", "[mesh]\nfile = \"a.msh\"\nlength_unit = \"m\"\n[[mesh.box]]",
     "error: a mesh is either a `file` or [[mesh.box]] tables, not both"},
    // Text that is no TOML.
    {"open quote", "name = \"C30\"", "name = \"C30", "7:12: error: not valid TOML"},
    {"key twice", "E = \"30 GPa\"", "E = \"30 GPa\"\nE = \"31 GPa\"", "9:5: error: not valid TOML"},
    {"control character", "name = \"C30\"", "name = \"C30\x01\"", "7:12: error: control character 0x01"},
    {"bracket and control character", "E = \"30 GPa\"", "E = [\x02", "8:6: error: control character 0x02"},
    {"bad UTF-8", "name = \"C30\"", "name = \"C\xff\"", "7:10: error: byte 0xFF is not valid UTF-8"},
    // Each of these brought toml++ to undefined behaviour: what looks like a text is none where it stands.
    {"quote behind a sign", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nnu = -'\xCB\x9A'",
     "10:7: error: a quote where no text can begin"},
    {"open quote behind a number", "f_t = \"3 MPa\"", "f_t = \"3 MPa\"\nnu = 2.'\xC3\xA4",
     "10:8: error: a quote where no text can begin"},
    {"text behind a text", "name = \"C30\"", "name = \"C\" '\xC3\xA4'",
     "7:12: error: a quote where no text can begin"},
    {"escaped control character", "name = \"C30\"", "name = \"C\\u0007\"",
     "7:8: error: this text holds a control character"},
};

std::string with(Fault const& fault) {
  auto const at = sound.find(fault.old_text);
  EXPECT_NE(at, std::string::npos) << fault.what;
  std::string text = sound;
  return text.replace(at, fault.old_text.size(), fault.new_text);
}

std::vector<core::Diagnostic> findings(std::string const& text) {
  try {
    deck::read_case_text(text, "deck.toml");
  } catch (core::InputError const& e) {
    EXPECT_EQ(e.failure, core::Failure::input);
    return e.diagnostics;
  }
  return {};
}

std::string shown(core::Diagnostic const& d) {
  return core::to_string(d.place) + ": error: " + d.message;
}

// The deck that all faults start from is sound.
TEST(FaultyDecks, TheSoundDeckIsRead) {
  EXPECT_NO_THROW(deck::read_case_text(sound, "deck.toml"));
}

// Each fault is reported at its own place, in words that say what was expected.
TEST(FaultyDecks, EachFaultNamesItsPlace) {
  for (auto const& fault : faults) {
    SCOPED_TRACE(fault.what);
    auto const found = findings(with(fault));
    if (found.empty()) ADD_FAILURE() << "accepted";
    std::string all;
    bool seen = false;
    for (auto const& d : found) {
      all += shown(d) + "\n";
      seen = seen || shown(d).find(fault.expected) != std::string::npos;
    }
    EXPECT_TRUE(seen) << "expected " << fault.expected << "\nfound\n" << all;
    EXPECT_EQ(found.empty() ? "deck.toml" : found.front().place.file, "deck.toml");
  }
}

// A fault that stands alone is reported once: no error follows from another one.
TEST(FaultyDecks, NoErrorFollowsFromAnother) {
  int alone = 0;
  for (auto const& fault : faults) alone += findings(with(fault)).size() == 1 ? 1 : 0;
  // Some break two things, name a file that is not there, or are words that may also be lengths.
  EXPECT_GE(alone, static_cast<int>(faults.size()) - 23);
}

// All faults of a deck come in one pass, in the order of its lines.
TEST(FaultyDecks, SeveralErrorsInOnePass) {
  std::string text = sound;
  auto const replace = [&](std::string const& a, std::string const& b) {
    text.replace(text.find(a), a.size(), b);
  };
  replace("E = \"30 GPa\"", "E = \"30 N\"");
  replace("f_u = \"550 MPa\"", "f_u = \"450 MPa\"");
  replace("diameter = \"12 mm\"", "diamter = \"12 mm\"");
  replace("stage = \"pull\"", "stage = \"pul\"");
  replace("of = [\"left\"]", "of = \"left\"");
  auto const found = findings(text);
  ASSERT_EQ(found.size(), 6U);
  std::vector<int> lines;
  for (auto const& d : found) lines.push_back(d.place.line);
  EXPECT_EQ(lines, (std::vector<int>{8, 14, 15, 18, 29, 41}));
}

// A deck with thousands of errors is answered with a bounded list.
TEST(FaultyDecks, ManyErrorsAreCut) {
  std::string text = sound + "[run]\n";
  for (int i = 0; i < 3000; ++i) text += "nonsense" + std::to_string(i) + " = 1\n";
  EXPECT_EQ(findings(text).size(), 101U);
}

// Very deep nesting, very long keys and very large texts are refused instead of exhausting the stack.
TEST(FaultyDecks, DeepNestingIsRefused) {
  std::string const n(200000, '[');
  EXPECT_FALSE(findings("a = " + n).empty());
  std::string tables = "a = ", dotted = "a", header = "[a", quoted = "\"a\"";
  for (int i = 0; i < 100000; ++i) {
    tables += "{a=";
    dotted += ".a";
    header += ".a";
    quoted += ".\",\"";
  }
  EXPECT_FALSE(findings(tables).empty());
  EXPECT_FALSE(findings(dotted + " = 1").empty());
  EXPECT_FALSE(findings(header + "]").empty());
  EXPECT_FALSE(findings(quoted + " = 1").empty());
  EXPECT_FALSE(findings(std::string(17U << 20U, ' ')).empty());
}

std::string mutated(std::string text, std::mt19937& random) {
  std::string const bytes = "[]{}=.,\"'#\n\t\\0-e \x01\x80\xff_";
  for (unsigned n = 1 + random() % 6; n > 0; --n) {
    auto const at = random() % text.size();
    switch (random() % 4) {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text.insert(at, 1, bytes[random() % bytes.size()]);
      break;
    case 2:
      text.erase(at, 1 + random() % 8);
      break;
    default:
      text.insert(at, text.substr(random() % text.size(), random() % 40));
    }
    if (text.empty()) text = "a";
  }
  return text;
}

// Damaged decks are read or refused, never crash, and whatever is read survives its own echo.
TEST(FaultyDecks, DamagedDecksAreSafe) {
  std::mt19937 random(11);
  int read = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string const text = mutated(sound, random);
    try {
      auto const c = deck::read_case_text(text, "deck.toml");
      std::string const echoed = deck::echo(c);
      ASSERT_EQ(deck::echo(deck::read_case_text(echoed, "echo.toml")), echoed) << text;
      ++read;
    } catch (core::Error const& e) {
      ASSERT_EQ(e.failure, core::Failure::input) << e.what();
    }
  }
  EXPECT_GT(read, 0);
}

// Bytes without any structure are refused without a crash.
TEST(FaultyDecks, RandomBytesAreSafe) {
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    for (unsigned n = random() % 60; n > 0; --n) text += static_cast<char>(random() % (i % 2 ? 256 : 128));
    try {
      deck::read_case_text(text, "deck.toml");
    } catch (core::Error const& e) {
      ASSERT_EQ(e.failure, core::Failure::input) << e.what();
    }
  }
}

} // namespace
