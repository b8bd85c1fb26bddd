#include "dem/scene/keys.hpp"

#include <type_traits>

namespace isostat {
namespace {

template <class>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<std::vector<T>> = true;
template <class>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

// The field Scene::Group.Member; Group may be a struct, the optional [units] (must be there) or the stages.
template <auto Group, auto Member>
SceneField in(Scene& scene, std::size_t stage) {
  auto& group = scene.*Group;
  using Type = std::remove_cvref_t<decltype(group)>;
  if constexpr (is_vector<Type>)
    return &(group[stage].*Member);
  else if constexpr (is_optional<Type>)
    return &((*group).*Member);
  else
    return &(group.*Member);
}
SceneField seed_field(Scene& scene, std::size_t) { return &scene.seed; }

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr SceneRange positive{0, kInfinity, true, false};
constexpr SceneRange not_negative{0, kInfinity, false, false};
constexpr SceneRange from(double low, double high) { return {low, high, false, false}; }

constexpr SceneCondition random_start{[](const Scene& s) { return s.grains.file.empty(); }, "grains.file is empty"};
constexpr SceneCondition has_friction{[](const Scene& s) { return s.law.friction > 0; }, "law.friction > 0"};
constexpr SceneCondition has_rolling{[](const Scene& s) { return s.law.rolling; }, "law.rolling = true"};
constexpr SceneCondition has_attraction{[](const Scene& s) { return s.law.attraction > 0; }, "law.attraction > 0"};
constexpr SceneCondition has_finishing{[](const Scene& s) { return s.finish.method != Finish::none; },
                                       "finish.method is not \"none\""};
constexpr SceneCondition has_series{[](const Scene& s) { return !s.output.series.empty(); }, "output.series is given"};

std::vector<SceneKey> make_table() {
  using S = Scene;
  return {
      {.name = "seed",
       .field = seed_field,
       .range = not_negative,
       .meaning =
           "Seed of the random generator; the same scene and seed give the same bits for any number of threads."},

      {.name = "grains.count",
       .field = in<&S::grains, &GrainsScene::count>,
       .range = from(1, 1e9),
       .condition = random_start,
       .meaning = "Number N of disks."},
      {.name = "grains.solid_fraction",
       .field = in<&S::grains, &GrainsScene::solid_fraction>,
       .range = {0, 0.5, true, false},
       .condition = random_start,
       .meaning = "Solid fraction Phi_I of the initial state: sum of pi d^2/4 over the area of the cell. Equal disks "
                  "placed at random without overlap saturate at 0.547, hence the limit."},
      {.name = "grains.diameter_min",
       .field = in<&S::grains, &GrainsScene::diameter_min>,
       .unit = "a",
       .range = positive,
       .condition = random_start,
       .meaning = "Smallest diameter; diameters are uniform between the two."},
      {.name = "grains.diameter_max",
       .field = in<&S::grains, &GrainsScene::diameter_max>,
       .unit = "a",
       .range = positive,
       .condition = random_start,
       .meaning = "Largest diameter, the unit of length: leave it at 1 unless you know why."},
      {.name = "grains.file",
       .field = in<&S::grains, &GrainsScene::file>,
       .meaning = "A state file or a plain-text network to start from instead of random positions; relative to the "
                  "directory in which the program runs. Empty: random."},

      {.name = "law.normal_stiffness",
       .field = in<&S::law, &LawScene::normal_stiffness>,
       .unit = "F0/a",
       .range = positive,
       .meaning = "K_N of the contacts. The stiffness parameter is kappa = K_N / max(F0/a, P)."},
      {.name = "law.tangential_stiffness",
       .field = in<&S::law, &LawScene::tangential_stiffness>,
       .unit = "F0/a",
       .range = positive,
       .absent = "law.normal_stiffness",
       .condition = has_friction,
       .meaning = "K_T of the contacts."},
      {.name = "law.damping",
       .field = in<&S::law, &LawScene::damping>,
       .range = from(0, 1),
       .meaning = "zeta, the normal viscous damping as a fraction of the critical damping of each pair (Gilabert 2007, "
                  "Eq. 6)."},
      {.name = "law.friction",
       .field = in<&S::law, &LawScene::friction>,
       .range = not_negative,
       .meaning = "mu, Coulomb friction; its limit acts on the elastic repulsion K_N |h| alone. 0: frictionless, no "
                  "rotations."},
      {.name = "law.rolling", .field = in<&S::law, &LawScene::rolling>, .meaning = "Rolling resistance on or off."},
      {.name = "law.rolling_friction",
       .field = in<&S::law, &LawScene::rolling_friction>,
       .unit = "a",
       .range = not_negative,
       .absent = "0.01 law.friction",
       .condition = has_rolling,
       .meaning = "mu_r: the rolling moment is at most mu_r K_N |h|."},
      {.name = "law.rolling_stiffness",
       .field = in<&S::law, &LawScene::rolling_stiffness>,
       .unit = "F0 a",
       .range = positive,
       .absent = "1e-4 law.normal_stiffness",
       .condition = has_rolling,
       .meaning = "K_r of the rolling springs."},
      {.name = "law.attraction",
       .field = in<&S::law, &LawScene::attraction>,
       .unit = "F0",
       .range = not_negative,
       .meaning = "Attractive force F0 of a contact; 1 by the choice of unit, 0: no cohesion (then the unit of force "
                  "is a P)."},
      {.name = "law.attraction_range",
       .field = in<&S::law, &LawScene::attraction_range>,
       .unit = "a",
       .range = positive,
       .condition = has_attraction,
       .meaning = "D0: the attraction falls linearly to zero at this gap."},

      {.name = "step.fraction",
       .field = in<&S::step, &StepScene::fraction>,
       .range = positive,
       .meaning = "c of the time step dt = c sqrt(m_max / K_N). 0.06 is the reference, 0.10 to 0.12 production; above "
                  "0.16 packings are noisy; a step beyond the stability bound of the smallest grain is refused."},

      {.name = "cell.inertia",
       .field = in<&S::cell, &CellScene::inertia>,
       .unit = "sum m",
       .range = positive,
       .meaning = "Mass of the cell's degrees of freedom (Gilabert 2007, Eq. 3) over the mass of all grains."},
      {.name = "cell.aspect",
       .field = in<&S::cell, &CellScene::aspect>,
       .range = positive,
       .condition = random_start,
       .meaning = "L1 / L2 of the initial cell."},
      {.name = "cell.rate_coupling",
       .field = in<&S::cell, &CellScene::rate_coupling>,
       .meaning = "Add -(Ldot/L) v to the peculiar acceleration; the paper's equations have no such term."},

      {.name = "equilibrium.force",
       .field = in<&S::equilibrium, &EquilibriumScene::force>,
       .unit = "F1",
       .range = positive,
       .meaning = "Largest net force on a grain, and with the unit F1 a the largest net moment (Gilabert 2007, Sec. "
                  "II.D); F1 = max(F0, a P)."},
      {.name = "equilibrium.pressure",
       .field = in<&S::equilibrium, &EquilibriumScene::pressure>,
       .unit = "F1/a",
       .range = positive,
       .meaning = "Largest difference between imposed and measured stress, in each controlled direction."},
      {.name = "equilibrium.kinetic_energy",
       .field = in<&S::equilibrium, &EquilibriumScene::kinetic_energy>,
       .unit = "F1 a",
       .range = positive,
       .meaning = "Largest kinetic energy per grain."},

      {.name = "finish.method",
       .field = in<&S::finish, &FinishScene::method>,
       .choices = {"none", "drag", "newton"},
       .meaning = "What ends a stage faster than the bare law: none is the paper's pure law, drag a global viscous "
                  "drag at the end, newton static solves under the same law down to rounding (docs/equilibrium.md). "
                  "The state records which one acted."},
      {.name = "finish.drag",
       .field = in<&S::finish, &FinishScene::drag>,
       .unit = "1/T0",
       .range = positive,
       .condition = has_finishing,
       .meaning = "Rate of the drag force -drag m v; with newton only of what rings without changing a contact."},
      {.name = "finish.quiet_time",
       .field = in<&S::finish, &FinishScene::quiet_time>,
       .unit = "T0",
       .range = not_negative,
       .condition = has_finishing,
       .meaning = "Finishing starts when the kinetic criterion has been met for so long, in a network that carries the "
                  "imposed stress."},
      {.name = "finish.unchanged_time",
       .field = in<&S::finish, &FinishScene::unchanged_time>,
       .unit = "T0",
       .range = positive,
       .condition = has_finishing,
       .meaning = "It also starts when the set of contacts has been the same for so long: what still moves rings, "
                  "hardly damped, and changes nothing."},

      {.name = "stage.pressure",
       .field = in<&S::stages, &StageScene::pressure>,
       .unit = "F0/a",
       .range = not_negative,
       .absent = "fixed cell",
       .meaning = "P*, the stress imposed in both directions; without any stress or strain rate the cell stays fixed."},
      {.name = "stage.pressures",
       .field = in<&S::stages, &StageScene::pressures>,
       .unit = "F0/a",
       .range = not_negative,
       .meaning = "A load path: the stage is run once for each of these values of stage.pressure, in turn; velocities "
                  "are drawn in the first one only. The resolved scene has them as stages of their own."},
      {.name = "stage.stress_1",
       .field = in<&S::stages, &StageScene::stress_1>,
       .unit = "F0/a",
       .absent = "as stage.pressure says",
       .meaning =
           "Stress imposed along direction 1, compression positive, tension negative; replaces stage.pressure there."},
      {.name = "stage.stress_2",
       .field = in<&S::stages, &StageScene::stress_2>,
       .unit = "F0/a",
       .absent = "as stage.pressure says",
       .meaning = "The same along direction 2."},
      {.name = "stage.strain_rate_1",
       .field = in<&S::stages, &StageScene::strain_rate_1>,
       .unit = "1/T0",
       .absent = "none imposed",
       .meaning = "Strain rate -Ldot/L0 imposed along direction 1 in place of a stress, L0 the cell at the start of "
                  "the stage: positive shortens the cell, negative stretches it, 0 keeps it."},
      {.name = "stage.strain_rate_2",
       .field = in<&S::stages, &StageScene::strain_rate_2>,
       .unit = "1/T0",
       .absent = "none imposed",
       .meaning = "The same along direction 2."},
      {.name = "stage.velocity",
       .field = in<&S::stages, &StageScene::velocity>,
       .unit = "V*",
       .range = not_negative,
       .meaning =
           "Root mean square velocity drawn at the start of the stage, V* = sqrt(F0 D0 / m); 0: velocities are kept."},
      {.name = "stage.max_strain_rate",
       .field = in<&S::stages, &StageScene::max_strain_rate>,
       .unit = "1/T0",
       .range = not_negative,
       .meaning = "Cap of the strain rate of the cell; 0: no cap."},
      {.name = "stage.normal_stiffness",
       .field = in<&S::stages, &StageScene::normal_stiffness>,
       .unit = "F0/a",
       .range = positive,
       .absent = "it stays",
       .meaning = "K_N that the contacts are brought to, exponentially in time over stage.stiffening_time; K_T and "
                  "K_r follow unless the scene sets them."},
      {.name = "stage.stiffening_time",
       .field = in<&S::stages, &StageScene::stiffening_time>,
       .unit = "T0",
       .range = positive,
       .meaning = "Length of the change of K_N; the stage does not end before."},
      {.name = "stage.stiffening_keeps",
       .field = in<&S::stages, &StageScene::stiffening_keeps>,
       .choices = {"forces", "elongations"},
       .meaning = "What the springs of friction and rolling keep while their stiffness changes: their forces and "
                  "moments, or their elongations, so that forces grow with K_T and K_r up to their limits."},
      {.name = "stage.until",
       .field = in<&S::stages, &StageScene::until>,
       .choices = {"equilibrium", "aggregated", "time", "strain", "failure"},
       .meaning =
           "What ends the stage: equilibrium; aggregated, i.e. equilibrium of a single cluster; a time; the strain of "
           "a driven direction; failure, when the stress of a driven direction has lost the part stage.drop of the "
           "largest change it had. If it is not met within stage.max_time the exit code is 3."},
      {.name = "stage.time",
       .field = in<&S::stages, &StageScene::time>,
       .unit = "T0",
       .range = not_negative,
       .meaning = "Length of a stage with until = \"time\"."},
      {.name = "stage.strain",
       .field = in<&S::stages, &StageScene::strain>,
       .range = not_negative,
       .meaning = "|1 - L/L0| of a driven direction that ends a stage with until = \"strain\"."},
      {.name = "stage.drop",
       .field = in<&S::stages, &StageScene::drop>,
       .range = {0, 1, true, true},
       .meaning = "Part of the peak stress whose loss is failure."},
      {.name = "stage.max_time",
       .field = in<&S::stages, &StageScene::max_time>,
       .unit = "T0",
       .range = positive,
       .meaning = "The stage gives up after so long."},

      {.name = "output.series",
       .field = in<&S::output, &OutputScene::series>,
       .meaning = "CSV file of the time series; empty: none."},
      {.name = "output.series_interval",
       .field = in<&S::output, &OutputScene::series_interval>,
       .unit = "T0",
       .range = positive,
       .condition = has_series,
       .meaning = "Time between two lines of the series."},
      {.name = "output.energies",
       .field = in<&S::output, &OutputScene::energies>,
       .condition = has_series,
       .meaning = "Energy ledger in the series: kinetic, elastic, adhesive, and the work of damping, sliding, rolling "
                  "and cell."},
      {.name = "output.stages",
       .field = in<&S::output, &OutputScene::stages>,
       .meaning = "Keep the state at the end of each stage but the last: STATE.stage0.h5, STATE.stage1.h5, ..."},
      {.name = "output.snapshot_times",
       .field = in<&S::output, &OutputScene::snapshot_times>,
       .unit = "T0",
       .range = not_negative,
       .meaning = "Times at which a copy of the state is kept."},
      {.name = "output.snapshot_solid_fractions",
       .field = in<&S::output, &OutputScene::snapshot_solid_fractions>,
       .range = {0, kInfinity, true, false},
       .meaning = "Solid fractions at which a copy of the state is kept."},

      {.name = "units.a",
       .field = in<&S::units, &UnitsScene::length>,
       .unit = "m",
       .range = positive,
       .meaning = "Unit of length a."},
      {.name = "units.density",
       .field = in<&S::units, &UnitsScene::density>,
       .unit = "kg/m^2",
       .range = positive,
       .meaning = "Mass of the disks over their area; m = density pi a^2 / 4."},
      {.name = "units.F0",
       .field = in<&S::units, &UnitsScene::force>,
       .unit = "N",
       .range = positive,
       .meaning = "Unit of force F0 (without cohesion: a P)."},
  };
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> table = make_table();
  return table;
}

bool belongs_to_stage(const SceneKey& key) { return key.name.starts_with("stage."); }
bool belongs_to_units(const SceneKey& key) { return key.name.starts_with("units."); }

std::string table_of(const SceneKey& key) {
  const std::size_t dot = key.name.find('.');
  return dot == std::string_view::npos ? std::string{} : std::string(key.name.substr(0, dot));
}

std::string_view leaf_of(const SceneKey& key) { return key.name.substr(key.name.find('.') + 1); }

std::string full_name(const SceneKey& key, std::size_t stage) {
  if (!belongs_to_stage(key)) return std::string(key.name);
  return "stage." + std::to_string(stage) + "." + std::string(leaf_of(key));
}

bool applies(const SceneKey& key, const Scene& scene) {
  return (!key.condition.holds || key.condition.holds(scene)) && (!belongs_to_units(key) || scene.units);
}

}  // namespace isostat
