#pragma once
// A case as the user described it, in SI units, with the place of each item in the deck: what `deck` fills in
// and `sim` turns into a Model. Plain data with the defaults of the program; the schema in deck/ documents
// each field.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fissura/core/error.hpp"
#include "fissura/core/vec3.hpp"

namespace fissura::model {

using core::Place;

// ---- mesh -------------------------------------------------------------------------------------------------
struct BoxSpec {
  Place place;
  std::string name = "concrete"; ///< volume group of its tets
  std::string body;              ///< boxes of different bodies are not joined: they touch by contact
  Vec3 from, to;                 ///< opposite corners [m]
  std::array<int, 3> cells{1, 1, 1};
  int tets_per_cell = 6;                  ///< 6 (Kuhn) or 24
  std::array<double, 3> grading{1, 1, 1}; ///< last cell length / first cell length along each axis
};
struct MeshSpec {
  Place place;
  std::vector<BoxSpec> boxes;
  std::string file;        ///< .msh or .geo, absolute or resolved against the deck's folder; empty with boxes
  double length_unit = 1;  ///< metres per length unit of the file
  double element_size = 0; ///< target size for .geo [m]; 0 = as the file says
  bool separate = false;   ///< touching bodies of the file whose faces do not match meet by contact
  bool allow_outside = false; ///< the file may lie outside the deck's folder
};

// ---- where ------------------------------------------------------------------------------------------------
/// Picks mesh points (supports, forces), faces (tractions, by their three points) or joints and tets (by
/// centroid).
struct Selector {
  enum class Kind { all, group, plane, box, point, line };
  Place place;
  Kind kind = Kind::all;
  std::string group; ///< kind group: volume, surface, curve or point group
  int axis = 0;      ///< kind plane: 0, 1, 2 = x, y, z
  double at = 0;     ///< kind plane: coordinate [m]
  Vec3 from, to;     ///< kind box: opposite corners; kind line: its ends; kind point: from [m]
  double tolerance =
      0; ///< distance that still counts [m]; 0 = 1e-6 of the mesh's largest extent. point: nearest node if 0
};

// ---- functions of time ------------------------------------------------------------------------------------
/// A function of the time since the start of its stage; 0 before, its last value afterwards.
struct Curve {
  enum class Kind { constant, ramp, table, cycles };
  Kind kind = Kind::constant;
  double value = 0;           ///< constant, and the plateau of a ramp
  double over = 0;            ///< ramp: rise time [s], smooth (zero slope and curvature at both ends)
  double from = 0;            ///< ramp: where it sets out; other than 0 only for a load changed in mid-run
  std::vector<double> times;  ///< table: times [s], increasing; linear between
  std::vector<double> values; ///< table: values
  std::vector<double> slopes; ///< table: if not empty, the slopes at its rows: cubic between, straight beyond
  std::vector<double> peaks;  ///< cycles: amplitudes; each is visited +, -, `repeats` times
  double period = 0;          ///< cycles: duration of one full cycle [s]
  int repeats = 1;
  bool one_sided = false; ///< cycles: 0 -> +a -> 0 instead of 0 -> +a -> -a -> 0
};

// ---- materials --------------------------------------------------------------------------------------------
enum class TetLaw { hyperelastic, paper };
/// Whether tets have E and nu as they are given, or are stiffer by what their joints add in compliance.
enum class Elasticity { as_given, compensated };
enum class JointLaw { energy_consistent, paper };
enum class ShearStrength { mohr_coulomb, constant };
enum class ElementSize { volume, joint_edge, given }; ///< the h of o_p = 2 h f_t/p
enum class SofteningRange { exact, y3d };
enum class RateFactor { none, mc2010 }; ///< how strengths grow with the strain rate
/// The code whose formulas give what the deck leaves out (model/presets.hpp).
enum class ConcretePreset { none, mc2010, ec2 };

struct ConcreteSpec {
  Place place;
  std::string name;
  std::vector<std::string> groups; ///< volume groups; empty = all groups no other material names
  ConcretePreset preset = ConcretePreset::none;
  double E = 0, nu = 0.2, density = 2500;
  double density_factor = 1; ///< mass scaling
  double f_t = 0;            ///< tensile strength [Pa]
  double f_c = 0;            ///< compressive strength, mean [Pa]
  double G_f = 0;            ///< mode I [J/m2]; 0 = 73 f_cm^0.18 (fib MC2010) with f_cm = f_c
  double G_s = 0;            ///< mode II; 0 = G_f
  TetLaw tet_law = TetLaw::hyperelastic;
  Elasticity elastic = Elasticity::as_given;
  double mu_bar = 0;     ///< viscous damping [Pa s]
  bool joints = true;    ///< false: tets of this material are bonded to each other, no joints between them
  bool crackable = true; ///< false: its joints stay linear elastic
  double penalty = 0;    ///< p [Pa]; the deck gives it as a multiple of E or as a stress; 0: joint_penalty()
  ElementSize element_size = ElementSize::volume;
  double h = 0; ///< [m] for ElementSize::given
  JointLaw joint_law = JointLaw::energy_consistent;
  SofteningRange softening_range = SofteningRange::exact;
  ShearStrength shear = ShearStrength::mohr_coulomb;
  double friction_angle = 0.6283185307179586; ///< phi [rad]; 36 degrees
  double cohesion = 0;                        ///< c [Pa]; 0 = f_c (1 - sin phi)/(2 cos phi)
  double f_s = 0;                             ///< [Pa] for ShearStrength::constant
  double friction = 0.6;                      ///< mu of the crack faces
  RateFactor rate_factor = RateFactor::none;
};

/// Changes joints whose centroid lies in a region: notches, grips, layers near loads.
struct JointRegionSpec {
  Place place;
  Selector where;
  double strength_factor = 1; ///< multiplies f_t, f_s (c), not G_f
  bool crackable = true;
  bool only_axis = false; ///< notch: only joints whose normal lies within 10 degrees of `axis`
  int axis = 0;
};

enum class SteelLaw { kato, menegotto_pinto };
struct SteelSpec {
  Place place;
  std::string name;
  double E_s = 200e9, f_y = 0, f_u = 0, eps_sh = 0.015, eps_u = 0.1, eps_br = 0.12, density = 7850;
  SteelLaw law = SteelLaw::kato;
};

/// How the slip of a bar at a crack is reduced by the next one: Eq. 26, or so that the bar is never stiffer
/// than steel (docs/theory/bond_slip.md).
enum class SlipReduction { paper, consistent };
inline constexpr SlipReduction default_slip_reduction = SlipReduction::paper;
/// Where the paper's length l_cr comes from.
enum class CrackLength { automatic, element_size, given };
struct BarSpec {
  Place place;
  std::string name, steel;
  double diameter = 0;      ///< D [m]
  double area = 0;          ///< A_s [m2]; 0 = pi D^2/4 (a lumped bar may give both)
  std::vector<Vec3> points; ///< polyline
  std::string curve;        ///< instead of points: a line group of the mesh file
  bool closed = false;
  int count = 1;
  Vec3 spacing;              ///< offset from one copy to the next
  double initial_strain = 0; ///< imposed elongation (prestress > 0 stretches the steel)
  SlipReduction slip_reduction = default_slip_reduction;
  CrackLength l_cr_from = CrackLength::automatic; ///< SlipReduction::paper
  double l_cr = 0;                                ///< [m] for CrackLength::given
  double crack_spacing = 0; ///< SlipReduction::consistent: distance of cracks [m]; 0 = automatic
  std::string cage;         ///< the [[cage]] that made it; empty for a bar of the deck
};

/// "4 x 12 mm"
struct BarLayer {
  int count = 0;
  double diameter = 0; ///< [m]
};
/// "8 mm / 150 mm"
struct StirrupSpec {
  double diameter = 0, spacing = 0; ///< [m]
};
/// Longitudinal bars and stirrups of a straight member with a rectangular section (model/cage.hpp).
struct CageSpec {
  enum class Kind { beam, column };
  Place place;
  std::string name;
  Kind kind = Kind::beam;
  std::string steel, stirrup_steel; ///< stirrups: empty = the same
  Vec3 from, to;                    ///< opposite corners of the concrete member [m]
  int axis = -1;                    ///< of the member; -1 = its longest side
  int up = -1;                      ///< axis that points to the top of a beam; -1 = z, y for members along z
  double cover = 0;                 ///< concrete over the outermost steel [m]
  std::array<double, 2> end_cover{-1, -1}; ///< at the two ends of the member [m]; < 0 = cover
  double clear = -1; ///< least clear distance between parallel bars [m]; < 0 = 20 mm, or the larger diameter
  std::vector<BarLayer> bottom, top; ///< beam: from the face inwards
  BarLayer sides;                    ///< beam: on each side, between bottom and top
  BarLayer bars;                     ///< column: in all, around the section
  StirrupSpec stirrups;
  SlipReduction slip_reduction = default_slip_reduction;
  CrackLength l_cr_from = CrackLength::automatic; ///< of the longitudinal bars, as those of BarSpec
  double l_cr = 0, crack_spacing = 0;             ///< [m], of the longitudinal bars
  std::vector<BarSpec> made; ///< what the cage stands for, until it is moved to Case::bars
};
enum class BarBetweenCracks { slip_only, elastic };
struct BarSettings {
  BarBetweenCracks between_cracks = BarBetweenCracks::slip_only;
  bool dowel = true;
};

// ---- loads and supports -----------------------------------------------------------------------------------
struct SupportSpec {
  Place place;
  std::string name;
  Selector where;
  std::array<bool, 3> fix{false, false, false};
};
/// A motion to and fro whose turning points are readings of gauges (cyclic tests).
struct PathSpec {
  struct Target {
    Place place;
    std::string gauge;
    double value = 0;    ///< in the unit of the gauge
    std::string written; ///< with its unit, where it has one: the kind of the gauge says what unit is right
  };
  Place place;
  std::string of;              ///< shares the path of this motion, instead of the following
  double scale = 1;            ///< of the velocity, where the path is shared
  double speed = 0, turn = 0;  ///< [m/s]; duration of a reversal [s]
  std::vector<Target> targets; ///< visited in this order
  bool stops = true;           ///< after the last one the run ends; else the motion comes to rest
};
/// A measured or made acceleration, in a text file.
struct RecordSpec {
  enum class Baseline { none, mean, linear, quadratic };
  Place place;
  std::string file;            ///< absolute or resolved against the deck's folder
  bool allow_outside = false;  ///< the file may lie outside the deck's folder
  int time_column = 1;         ///< from 1; 0 = none, evenly spaced by time_step
  int acceleration_column = 2; ///< from 1; 0 = all numbers of all rows, without times
  double time_step = 0;        ///< [s]
  bool as_header_says =
      false;       ///< neither columns nor time_step are given: a step in the header stands for both
  double unit = 1; ///< m/s2 per unit of the file
  double pga = 0;  ///< > 0: scaled to this largest |acceleration| [m/s2]
  Baseline baseline = Baseline::none;
  double start = 0; ///< the record begins this long after the stage [s]
};
struct MotionSpec { ///< prescribed motion of one component: by a curve, a path or a record
  Place place;
  std::string name, stage; ///< stage whose start is t = 0 of the curve; empty = start of the run
  Selector where;
  int axis = 0;
  bool is_velocity = false; ///< the curve is a velocity [m/s] instead of a displacement [m]
  Curve curve;
  std::optional<PathSpec> path;
  std::optional<RecordSpec> record;
};
/// Dashpots on boundary faces that let waves out.
struct AbsorbingSpec {
  Place place;
  std::string name;
  Selector where;
};
struct ForceSpec { ///< total force on the selected points, shared equally
  Place place;
  std::string name, stage;
  Selector where;
  Vec3 direction; ///< unit vector
  Curve curve;    ///< [N]
};
struct TractionSpec { ///< on the selected boundary faces, in their reference area
  Place place;
  std::string name, stage;
  Selector where;
  bool normal = false; ///< along the inner normal (a pressure) instead of `direction`
  Vec3 direction;
  Curve curve; ///< [Pa]
};
struct GravitySpec {
  bool on = false;
  Place place;
  std::string stage;
  Vec3 direction{0, 0, -1};
  Curve curve; ///< [m/s2]
};

// ---- rigid bodies, bodies in motion
struct PlaneSpec { ///< a rigid half space that never moves
  Place place;
  std::string name;
  Vec3 point;            ///< of its surface [m]
  Vec3 normal;           ///< out of the rigid half space, into the free one
  double friction = 0.6; ///< mu
};
struct ImpactorSpec { ///< a rigid body that moves without turning
  enum class Shape { sphere, cylinder, box };
  Place place;
  std::string name;
  Shape shape = Shape::sphere;
  Vec3 centre;                                 ///< sphere [m]
  Vec3 from, to;                               ///< cylinder: ends of its axis; box: opposite corners [m]
  double radius = 0;                           ///< sphere, cylinder [m]
  double mass = 0;                             ///< [kg]
  Vec3 velocity;                               ///< at t = 0 [m/s]
  double friction = 0.6;                       ///< mu
  std::array<bool, 3> moves{true, true, true}; ///< false: a guide holds this component
};
struct InitialVelocitySpec {
  Place place;
  Selector where; ///< tets by centroid; kinds plane, point, line: nodes
  Vec3 velocity;  ///< [m/s]
};

// ---- contact ----------------------------------------------------------------------------------------------
enum class InitialOverlap {
  refuse,
  zero ///< what overlaps at the start is where the spring of contact begins
};
struct ContactSpec {
  bool on = true;
  InitialOverlap initial_overlap = InitialOverlap::refuse;
  Place place;
  double friction = -1; ///< mu between bodies and fragments; < 0: the smaller one of the two concretes
};
struct ContactPairSpec { ///< friction between two materials
  Place place;
  std::vector<std::string> materials; ///< two names; the same twice is allowed
  double friction = 0;
};

// ---- run --------------------------------------------------------------------------------------------------
struct StageSpec {
  Place place;
  std::string name;
  double duration = 0;       ///< [s]
  double mass_damping = -1;  ///< [1/s]; < 0 = the run's
  double local_damping = -1; ///< [-]; < 0 = the run's
  double settle = 0;         ///< > 0: end the stage early once kinetic/internal energy stays below this
};
/// Whether joints carry inertia and so do not set the time step.
enum class JointInertia { automatic, on, off };
struct RunSpec {
  double end_time = 0;     ///< [s]; 0 = the sum of the stages
  double dt_factor = 0.85; ///< of the stable step (decision 019)
  double dt = 0;           ///< > 0: a fixed step [s]
  double least_dt = 0;     ///< > 0: tets whose step is smaller get extra mass (selective mass scaling) [s]
  JointInertia joint_inertia = JointInertia::automatic;
  double mass_damping = 0;  ///< c of F = -c m v [1/s]
  double local_damping = 0; ///< alpha of F = -alpha |f| sign(v) [-]
  int threads = 0;          ///< 0 = all
  long max_steps = 0;       ///< 0 = no limit
  int energy_every =
      0; ///< steps between two readings of the ledger; 0: 50, or 10 of the longer ones of joint inertia
  double residual_warn = 0.01, residual_stop = 0.05;
  double pace = 1;            ///< > 1: loads run up to so many times faster than their curves
  double pace_kinetic = 0.01; ///< kinetic over internal energy that this may cost
};
struct GaugeSpec {
  enum class Kind {
    displacement,
    velocity,
    reaction,
    force,
    bar,
    crack_width,
    mean_strain,
    contact_force,
    contact_impulse,
    impactor_displacement,
    impactor_velocity
  };
  Place place;
  std::string name;
  Kind kind = Kind::displacement;
  Selector where; ///< displacement, velocity: mean over the picked points
  int axis = 0;
  std::vector<std::string> of; ///< reaction: supports or motions; force: forces and tractions; contact_*:
                               ///< planes and impactors (all summed); impactor_*: one impactor
  double factor = 1;           ///< multiplies the reading (sign, symmetry)
  std::string zero_at;         ///< name of a stage: readings are relative to the one at its start
  std::string bar;             ///< bar: name, and copy number for count > 1
  int copy = 0;
  std::string quantity; ///< bar: stress, joint_stress, joint_strain, slip, normalised_slip, dowel_force
  Vec3 from, to;        ///< bar: place nearest to from; crack_width, mean_strain: the line
};
struct StopSpec {
  Place place;
  std::string gauge;
  double above = 0, below = 0;
  bool has_above = false, has_below = false;
  double falls_to = 0; ///< > 0: stop when |gauge| has fallen to this share of its largest |value| ...
  double after = 0;    ///< ... once that largest |value| exceeds this
};
struct OutputSpec {
  int history_points = 1000;     ///< rows of history.csv over the run (about)
  double history_every = 0;      ///< [s]; > 0 wins
  int frames = 20;               ///< VTU frames over the run (about)
  double frames_every = 0;       ///< [s]; > 0 wins
  bool surface = true;           ///< frames of the surface, with the faces of the cracks
  double checkpoint_every = 300; ///< wall time between two checkpoints [s]; 0 = not by time
  long checkpoint_steps = 0;     ///< steps between two checkpoints; 0 = not by steps
  long hash_every = 1000;        ///< steps between two hashes of the state in log.txt; 0 = none
  double magnify = 1;            ///< no effect on the run; default warp factor of the pictures
};

struct Case {
  std::string title;
  std::string deck_file, folder;            ///< where it was read; the folder resolves relative paths
  std::vector<std::string> notes, warnings; ///< what reading the deck and the files it names has shown
  MeshSpec mesh;
  std::vector<ConcreteSpec> concretes;
  std::vector<JointRegionSpec> joint_regions;
  std::vector<SteelSpec> steels;
  BarSettings bar_settings;
  std::vector<BarSpec> bars; ///< those of the cages last
  std::vector<CageSpec> cages;
  std::vector<SupportSpec> supports;
  std::vector<MotionSpec> motions;
  std::vector<ForceSpec> forces;
  std::vector<TractionSpec> tractions;
  std::vector<AbsorbingSpec> absorbing;
  GravitySpec gravity;
  std::vector<PlaneSpec> planes;
  std::vector<ImpactorSpec> impactors;
  std::vector<InitialVelocitySpec> initial_velocities;
  ContactSpec contact;
  std::vector<ContactPairSpec> contact_pairs;
  std::vector<StageSpec> stages; ///< in order; empty = one stage "run" of end_time
  RunSpec run;
  std::vector<GaugeSpec> gauges;
  std::vector<StopSpec> stops;
  OutputSpec output;
};

} // namespace fissura::model
