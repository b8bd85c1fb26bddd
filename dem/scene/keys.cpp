// The rows that all systems share, and the table made of them and of each system's own.
#include "dem/scene/keys.hpp"

#include <algorithm>

#include "dem/scene/key_rows.hpp"

namespace isostat {
namespace {

SceneField seed_field(Scene& scene, std::size_t) { return &scene.seed; }
SceneField system_field(Scene& scene, std::size_t) { return &scene.system; }

constexpr SceneCondition has_finishing{[](const Scene& s) { return s.finish.method != Finish::none; },
                                       "finish.method is not \"none\""};
constexpr SceneCondition has_cell{[](const Scene& s) { return s.container.shape == ContainerShape::none; },
                                  "container.shape is \"none\""};
constexpr SceneCondition has_random_cell{
    [](const Scene& s) { return key_rows::random_start.holds(s) && has_cell.holds(s); },
    "grains.file is empty and container.shape is \"none\""};
constexpr SceneCondition has_series{[](const Scene& s) { return !s.output.series.empty(); }, "output.series is given"};

std::vector<SceneKey> common_keys() {
  using S = Scene;
  using namespace key_rows;
  constexpr SystemSet of_disks = SystemSet::only(SceneSystem::disks),
                      of_round_grains = SystemSet::both(SceneSystem::disks, SceneSystem::spheres);
  return {
      {.name = "system",
       .field = system_field,
       .choices = names(kSystemNames),
       .hidden_at_default = true,
       .meaning = "What the grains are: disks, or triangles joined by beams."},
      {.name = "seed",
       .field = seed_field,
       .range = not_negative,
       .meaning =
           "Seed of the random generator; the same scene and seed give the same bits for any number of threads."},

      {.name = "cell.inertia",
       .field = in<&S::cell, &CellScene::inertia>,
       .unit = "sum m",
       .range = positive,
       .condition = has_cell,
       .meaning = "Mass of the cell's degrees of freedom (Gilabert 2007, Eq. 3) over the mass of all grains."},
      {.name = "cell.aspect",
       .field = in<&S::cell, &CellScene::aspect>,
       .range = positive,
       .condition = has_random_cell,
       .meaning = "L1 / L2 of the initial cell."},
      {.name = "cell.damping",
       .field = in<&S::cell, &CellScene::damping>,
       .unit = "1/T0",
       .range = not_negative,
       .condition = has_cell,
       .meaning =
           "Rate at which the motion of edges under an imposed stress is damped, so that their inertia does not carry "
           "them beyond balance; the paper's cell has none and swings (docs/measured/loading.md)."},
      {.name = "cell.rate_coupling",
       .field = in<&S::cell, &CellScene::rate_coupling>,
       .condition = has_cell,
       .meaning =
           "Add -(Ldot/L) v to the peculiar acceleration, in a cell that shears also -(shear rate) v_y along x; the "
           "paper's equations have no such term."},

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
       .meaning = "Largest difference between imposed and measured stress, in each controlled direction and in shear."},
      {.name = "equilibrium.kinetic_energy",
       .field = in<&S::equilibrium, &EquilibriumScene::kinetic_energy>,
       .unit = "F1 a",
       .range = positive,
       .meaning = "Largest kinetic energy per grain."},

      {.name = "finish.method",
       .field = in<&S::finish, &FinishScene::method>,
       .choices = names(kFinishNames),
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
       .hidden_at_default = true,
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
      {.name = "stage.stress_12",
       .field = in<&S::stages, &StageScene::stress_12>,
       .unit = "F0/a",
       .absent = "the cell keeps its angles",
       .systems = of_round_grains,
       .meaning =
           "Shear stress sigma_12 imposed by tilting the cell, work-conjugate to the strain -d(tilt)/L2; 0 with a "
           "pressure makes a packing without shear stress (docs/shear.md)."},
      {.name = "stage.shear_rate",
       .field = in<&S::stages, &StageScene::shear_rate>,
       .unit = "1/T0",
       .absent = "none imposed",
       .systems = of_round_grains,
       .meaning = "Rate d(tilt)/dt / L2 imposed in place of a shear stress: positive moves the top of the cell along "
                  "direction 1, 0 keeps its angles."},
      {.name = "stage.ramp_time",
       .field = in<&S::stages, &StageScene::ramp_time>,
       .unit = "T0",
       .range = not_negative,
       .meaning = "Imposed stresses and strain rates go linearly in so long a time from what they were (a stress that "
                  "was not imposed: from the one that is there) to what the stage asks for, and the stage does not "
                  "end before; 0: at once."},
      {.name = "stage.velocity",
       .field = in<&S::stages, &StageScene::velocity>,
       .unit = "V*",
       .range = not_negative,
       .systems = of_disks,
       .meaning = "Root mean square velocity drawn at the start of the stage, V* = sqrt(F0 D0 / m), without cohesion a "
                  "sqrt(P / m) "
                  "with P of the first stage that imposes a stress, or a/T0 if none does; 0: velocities are kept."},
      {.name = "stage.velocity_of",
       .field = in<&S::stages, &StageScene::velocity_of>,
       .choices = names(kVelocityOfNames),
       .systems = of_disks,
       .meaning =
           "Whose root mean square stage.velocity is: that of the velocity vector, or of each of its "
           "components (the standard deviation of a Maxwell distribution), by the root of the dimension faster."},
      {.name = "stage.max_strain_rate",
       .field = in<&S::stages, &StageScene::max_strain_rate>,
       .unit = "1/T0",
       .range = not_negative,
       .meaning = "Cap of the strain rate of the cell where a stress drives it; 0: no cap."},
      {.name = "stage.max_edge_speed",
       .field = in<&S::stages, &StageScene::max_edge_speed>,
       .unit = "a/T0",
       .range = positive,
       .absent = "no cap",
       .meaning = "Cap of the speed |dL/dt| of each edge of the cell that a stress controls, besides "
                  "stage.max_strain_rate."},
      {.name = "stage.normal_stiffness",
       .field = in<&S::stages, &StageScene::normal_stiffness>,
       .unit = "F0/a",
       .range = positive,
       .absent = "it stays",
       .systems = of_disks,
       .meaning = "K_N that the contacts are brought to, exponentially in time over stage.stiffening_time; K_T and "
                  "K_r follow unless the scene sets them."},
      {.name = "stage.stiffening_time",
       .field = in<&S::stages, &StageScene::stiffening_time>,
       .unit = "T0",
       .range = positive,
       .systems = of_disks,
       .meaning = "Length of the change of K_N; the stage does not end before."},
      {.name = "stage.stiffening_keeps",
       .field = in<&S::stages, &StageScene::stiffening_keeps>,
       .choices = names(kSpringsNames),
       .systems = of_disks,
       .meaning = "What the springs of friction and rolling keep while their stiffness changes: their forces and "
                  "moments, or their elongations, so that forces grow with K_T and K_r up to their limits."},
      {.name = "stage.until",
       .field = in<&S::stages, &StageScene::until>,
       .choices = names(kUntilNames),
       .meaning =
           "What ends the stage: equilibrium; aggregated, i.e. equilibrium of a single cluster (disks); a time; the "
           "strain of a driven direction; failure, when the stress that a driven or ramped direction carries has lost "
           "the "
           "part stage.drop of its peak (docs/equilibrium.md); empty, when every grain has left a hopper; clogged, "
           "when none has left it "
           "for stage.clog_time; separated, when two colliding grains have met and left each other. If it "
           "is not met within stage.max_time the exit code is 3."},
      {.name = "stage.time",
       .field = in<&S::stages, &StageScene::time>,
       .unit = "T0",
       .range = not_negative,
       .meaning = "Length of a stage with until = \"time\"."},
      {.name = "stage.strain",
       .field = in<&S::stages, &StageScene::strain>,
       .range = not_negative,
       .meaning = "|1 - L/L0| of a driven direction, or the shear strain d(tilt)/L2 summed up, that ends a stage with "
                  "until = \"strain\"."},
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
       .meaning = "Energy ledger in the series: what is stored, what damping, sliding, rolling and drag dissipate, and "
                  "the work of a moving cell or container."},
      {.name = "output.stages",
       .field = in<&S::output, &OutputScene::stages>,
       .meaning = "Keep the state at the end of each stage but the last: STATE.stage0.h5, STATE.stage1.h5, ..."},
      {.name = "output.snapshot_interval",
       .field = in<&S::output, &OutputScene::snapshot_interval>,
       .unit = "T0",
       .range = positive,
       .absent = "none",
       .meaning = "Time between two copies of the state, STATE.snapshot0001.h5, ..., at its multiples."},
      {.name = "output.snapshot_times",
       .field = in<&S::output, &OutputScene::snapshot_times>,
       .unit = "T0",
       .range = not_negative,
       .meaning = "Times at which a copy of the state is kept."},
      {.name = "output.snapshot_solid_fractions",
       .field = in<&S::output, &OutputScene::snapshot_solid_fractions>,
       .range = {0, kInfinity, true, false},
       .meaning = "Solid fractions at which a copy of the state is kept."},
  };
}

// The order of tables in documentation and echo.
constexpr std::array<std::string_view, 11> kTables{
    "", "grains", "law", "container", "step", "cell", "equilibrium", "finish", "stage", "output", "units"};
std::ptrdiff_t place(const SceneKey& key) {
  return std::find(kTables.begin(), kTables.end(), table_of(key)) - kTables.begin();
}

std::vector<SceneKey> make_table() {
  std::vector<SceneKey> table = common_keys();
  for (SceneKey& key : surroundings_keys()) table.push_back(std::move(key));
  for (SceneKey& key : system_keys()) table.push_back(std::move(key));
  std::stable_sort(table.begin(), table.end(),
                   [](const SceneKey& a, const SceneKey& b) { return place(a) < place(b); });
  return table;
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> table = make_table();
  return table;
}

const std::vector<SceneKey>& scene_keys(SceneSystem system) {
  static const auto tables = [] {
    std::array<std::vector<SceneKey>, kSystemNames.size()> all;
    for (std::size_t s = 0; s < all.size(); ++s)
      for (const SceneKey& key : scene_keys())
        if (key.systems.has(static_cast<SceneSystem>(s))) all[s].push_back(key);
    return all;
  }();
  return tables[static_cast<std::size_t>(system)];
}

std::string names_of(SystemSet systems) {
  std::string text;
  for (std::size_t s = 0; s < kSystemNames.size(); ++s)
    if (systems.has(static_cast<SceneSystem>(s))) text += (text.empty() ? "" : " and ") + std::string(kSystemNames[s]);
  return text;
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
  return key.systems.has(scene.system) && (!key.condition.holds || key.condition.holds(scene)) &&
         (!belongs_to_units(key) || scene.units);
}

}  // namespace isostat
