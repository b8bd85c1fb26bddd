#include "dem/scene_keys.hpp"

#include <algorithm>
#include <array>
#include <charconv>
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
constexpr SceneRange any{};
constexpr SceneRange positive{0, kInfinity, true, false};
constexpr SceneRange not_negative{0, kInfinity, false, false};
constexpr SceneRange from(double low, double high) { return {low, high, false, false}; }

bool random_start(const Scene& s) { return s.grains.file.empty(); }
bool has_friction(const Scene& s) { return s.law.friction > 0; }
bool has_rolling(const Scene& s) { return s.law.rolling; }
bool has_attraction(const Scene& s) { return s.law.attraction > 0; }
bool has_finishing(const Scene& s) { return s.finish.method != Finish::none; }
bool has_series(const Scene& s) { return !s.output.series.empty(); }

std::vector<SceneKey> make_table() {
  using S = Scene;
  return {
      {"seed",
       seed_field,
       "",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "Seed of the random generator; the same scene and seed give the same bits for any number of threads."},

      {"grains.count",
       in<&S::grains, &GrainsScene::count>,
       "",
       from(1, 1e9),
       {},
       "",
       random_start,
       "grains.file is empty",
       "Number N of disks."},
      {"grains.solid_fraction",
       in<&S::grains, &GrainsScene::solid_fraction>,
       "",
       {0, 0.5, true, false},
       {},
       "",
       random_start,
       "grains.file is empty",
       "Solid fraction Phi_I of the initial state: sum of pi d^2/4 over the area of the cell. Equal disks placed at "
       "random without overlap saturate at 0.547, hence the limit."},
      {"grains.diameter_min",
       in<&S::grains, &GrainsScene::diameter_min>,
       "a",
       positive,
       {},
       "",
       random_start,
       "grains.file is empty",
       "Smallest diameter; diameters are uniform between the two."},
      {"grains.diameter_max",
       in<&S::grains, &GrainsScene::diameter_max>,
       "a",
       positive,
       {},
       "",
       random_start,
       "grains.file is empty",
       "Largest diameter, the unit of length: leave it at 1 unless you know why."},
      {"grains.file",
       in<&S::grains, &GrainsScene::file>,
       "",
       any,
       {},
       "",
       nullptr,
       "",
       "A state file or a plain-text network to start from instead of random positions; relative to the directory in "
       "which the program runs. Empty: random."},

      {"law.normal_stiffness",
       in<&S::law, &LawScene::normal_stiffness>,
       "F0/a",
       positive,
       {},
       "",
       nullptr,
       "",
       "K_N of the contacts. The stiffness parameter is kappa = K_N / max(F0/a, P)."},
      {"law.tangential_stiffness",
       in<&S::law, &LawScene::tangential_stiffness>,
       "F0/a",
       positive,
       {},
       "law.normal_stiffness",
       has_friction,
       "law.friction > 0",
       "K_T of the contacts."},
      {"law.damping",
       in<&S::law, &LawScene::damping>,
       "",
       from(0, 1),
       {},
       "",
       nullptr,
       "",
       "zeta, the normal viscous damping as a fraction of the critical damping of each pair (Gilabert 2007, Eq. 6)."},
      {"law.friction",
       in<&S::law, &LawScene::friction>,
       "",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "mu, Coulomb friction; its limit acts on the elastic repulsion K_N |h| alone. 0: frictionless, no rotations."},
      {"law.rolling", in<&S::law, &LawScene::rolling>, "", any, {}, "", nullptr, "", "Rolling resistance on or off."},
      {"law.rolling_friction",
       in<&S::law, &LawScene::rolling_friction>,
       "a",
       not_negative,
       {},
       "0.01 law.friction",
       has_rolling,
       "law.rolling = true",
       "mu_r: the rolling moment is at most mu_r K_N |h|."},
      {"law.rolling_stiffness",
       in<&S::law, &LawScene::rolling_stiffness>,
       "F0 a",
       positive,
       {},
       "1e-4 law.normal_stiffness",
       has_rolling,
       "law.rolling = true",
       "K_r of the rolling springs."},
      {"law.attraction",
       in<&S::law, &LawScene::attraction>,
       "F0",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "Attractive force F0 of a contact; 1 by the choice of unit, 0: no cohesion (then the unit of force is a P)."},
      {"law.attraction_range",
       in<&S::law, &LawScene::attraction_range>,
       "a",
       positive,
       {},
       "",
       has_attraction,
       "law.attraction > 0",
       "D0: the attraction falls linearly to zero at this gap."},

      {"step.fraction",
       in<&S::step, &StepScene::fraction>,
       "",
       positive,
       {},
       "",
       nullptr,
       "",
       "c of the time step dt = c sqrt(m_max / K_N). 0.06 is the reference, 0.10 to 0.12 production; above 0.16 "
       "packings are noisy; a step beyond the stability bound of the smallest grain is refused."},

      {"cell.inertia",
       in<&S::cell, &CellScene::inertia>,
       "sum m",
       positive,
       {},
       "",
       nullptr,
       "",
       "Mass of the cell's degrees of freedom (Gilabert 2007, Eq. 3) over the mass of all grains."},
      {"cell.aspect",
       in<&S::cell, &CellScene::aspect>,
       "",
       positive,
       {},
       "",
       random_start,
       "grains.file is empty",
       "L1 / L2 of the initial cell."},
      {"cell.rate_coupling",
       in<&S::cell, &CellScene::rate_coupling>,
       "",
       any,
       {},
       "",
       nullptr,
       "",
       "Add -(Ldot/L) v to the peculiar acceleration; the paper's equations have no such term."},

      {"equilibrium.force",
       in<&S::equilibrium, &EquilibriumScene::force>,
       "F1",
       positive,
       {},
       "",
       nullptr,
       "",
       "Largest net force on a grain, and with the unit F1 a the largest net moment (Gilabert 2007, Sec. II.D); "
       "F1 = max(F0, a P)."},
      {"equilibrium.pressure",
       in<&S::equilibrium, &EquilibriumScene::pressure>,
       "F1/a",
       positive,
       {},
       "",
       nullptr,
       "",
       "Largest difference between imposed and measured stress, in each controlled direction."},
      {"equilibrium.kinetic_energy",
       in<&S::equilibrium, &EquilibriumScene::kinetic_energy>,
       "F1 a",
       positive,
       {},
       "",
       nullptr,
       "",
       "Largest kinetic energy per grain."},

      {"finish.method",
       in<&S::finish, &FinishScene::method>,
       "",
       any,
       {"none", "drag", "newton"},
       "",
       nullptr,
       "",
       "What ends a stage faster than the bare law: none is the paper's pure law, drag a global viscous drag at the "
       "end, newton static solves under the same law down to rounding (docs/equilibrium.md). The state records which "
       "one acted."},
      {"finish.drag",
       in<&S::finish, &FinishScene::drag>,
       "1/T0",
       positive,
       {},
       "",
       has_finishing,
       "finish.method is not \"none\"",
       "Rate of the drag force -drag m v; with newton only of what rings without changing a contact."},
      {"finish.quiet_time",
       in<&S::finish, &FinishScene::quiet_time>,
       "T0",
       not_negative,
       {},
       "",
       has_finishing,
       "finish.method is not \"none\"",
       "Finishing starts when the kinetic criterion has been met for so long, in a network that carries the imposed "
       "stress."},
      {"finish.unchanged_time",
       in<&S::finish, &FinishScene::unchanged_time>,
       "T0",
       positive,
       {},
       "",
       has_finishing,
       "finish.method is not \"none\"",
       "It also starts when the set of contacts has been the same for so long: what still moves rings, hardly damped, "
       "and "
       "changes nothing."},

      {"stage.pressure",
       in<&S::stages, &StageScene::pressure>,
       "F0/a",
       not_negative,
       {},
       "fixed cell",
       nullptr,
       "",
       "P*, the stress imposed in both directions; without any stress or strain rate the cell stays fixed."},
      {"stage.pressures",
       in<&S::stages, &StageScene::pressures>,
       "F0/a",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "A load path: the stage is run once for each of these values of stage.pressure, in turn; velocities are drawn "
       "in the first one only. The resolved scene has them as stages of their own."},
      {"stage.stress_1",
       in<&S::stages, &StageScene::stress_1>,
       "F0/a",
       any,
       {},
       "as stage.pressure says",
       nullptr,
       "",
       "Stress imposed along direction 1, compression positive, tension negative; replaces stage.pressure there."},
      {"stage.stress_2",
       in<&S::stages, &StageScene::stress_2>,
       "F0/a",
       any,
       {},
       "as stage.pressure says",
       nullptr,
       "",
       "The same along direction 2."},
      {"stage.strain_rate_1",
       in<&S::stages, &StageScene::strain_rate_1>,
       "1/T0",
       any,
       {},
       "none imposed",
       nullptr,
       "",
       "Strain rate -Ldot/L0 imposed along direction 1 in place of a stress, L0 the cell at the start of the stage: "
       "positive shortens the cell, negative stretches it, 0 keeps it."},
      {"stage.strain_rate_2",
       in<&S::stages, &StageScene::strain_rate_2>,
       "1/T0",
       any,
       {},
       "none imposed",
       nullptr,
       "",
       "The same along direction 2."},
      {"stage.velocity",
       in<&S::stages, &StageScene::velocity>,
       "V*",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "Root mean square velocity drawn at the start of the stage, V* = sqrt(F0 D0 / m); 0: velocities are kept."},
      {"stage.max_strain_rate",
       in<&S::stages, &StageScene::max_strain_rate>,
       "1/T0",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "Cap of the strain rate of the cell; 0: no cap."},
      {"stage.normal_stiffness",
       in<&S::stages, &StageScene::normal_stiffness>,
       "F0/a",
       positive,
       {},
       "it stays",
       nullptr,
       "",
       "K_N that the contacts are brought to, exponentially in time over stage.stiffening_time; tangential forces and "
       "rolling moments are kept, K_T and K_r follow unless the scene sets them."},
      {"stage.stiffening_time",
       in<&S::stages, &StageScene::stiffening_time>,
       "T0",
       positive,
       {},
       "",
       nullptr,
       "",
       "Length of the change of K_N; the stage does not end before."},
      {"stage.until",
       in<&S::stages, &StageScene::until>,
       "",
       any,
       {"equilibrium", "aggregated", "time", "strain", "failure"},
       "",
       nullptr,
       "",
       "What ends the stage: equilibrium; aggregated, i.e. equilibrium of a single cluster; a time; the strain of a "
       "driven direction; failure, when the stress of a driven direction has lost the part stage.drop of the largest "
       "change it had. If it is not met within stage.max_time the exit code is 3."},
      {"stage.time",
       in<&S::stages, &StageScene::time>,
       "T0",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "Length of a stage with until = \"time\"."},
      {"stage.strain",
       in<&S::stages, &StageScene::strain>,
       "",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "|1 - L/L0| of a driven direction that ends a stage with until = \"strain\"."},
      {"stage.drop",
       in<&S::stages, &StageScene::drop>,
       "",
       {0, 1, true, true},
       {},
       "",
       nullptr,
       "",
       "Part of the peak stress whose loss is failure."},
      {"stage.max_time",
       in<&S::stages, &StageScene::max_time>,
       "T0",
       positive,
       {},
       "",
       nullptr,
       "",
       "The stage gives up after so long."},

      {"output.series",
       in<&S::output, &OutputScene::series>,
       "",
       any,
       {},
       "",
       nullptr,
       "",
       "CSV file of the time series; empty: none."},
      {"output.series_interval",
       in<&S::output, &OutputScene::series_interval>,
       "T0",
       positive,
       {},
       "",
       has_series,
       "output.series is given",
       "Time between two lines of the series."},
      {"output.energies",
       in<&S::output, &OutputScene::energies>,
       "",
       any,
       {},
       "",
       has_series,
       "output.series is given",
       "Energy ledger in the series: kinetic, elastic, adhesive, and the work of damping, sliding, rolling and cell."},
      {"output.stages",
       in<&S::output, &OutputScene::stages>,
       "",
       any,
       {},
       "",
       nullptr,
       "",
       "Keep the state at the end of each stage but the last: STATE.stage0.h5, STATE.stage1.h5, ..."},
      {"output.snapshot_times",
       in<&S::output, &OutputScene::snapshot_times>,
       "T0",
       not_negative,
       {},
       "",
       nullptr,
       "",
       "Times at which a copy of the state is kept."},
      {"output.snapshot_solid_fractions",
       in<&S::output, &OutputScene::snapshot_solid_fractions>,
       "",
       {0, kInfinity, true, false},
       {},
       "",
       nullptr,
       "",
       "Solid fractions at which a copy of the state is kept."},

      {"units.a", in<&S::units, &UnitsScene::length>, "m", positive, {}, "", nullptr, "", "Unit of length a."},
      {"units.density",
       in<&S::units, &UnitsScene::density>,
       "kg/m^2",
       positive,
       {},
       "",
       nullptr,
       "",
       "Mass of the disks over their area; m = density pi a^2 / 4."},
      {"units.F0",
       in<&S::units, &UnitsScene::force>,
       "N",
       positive,
       {},
       "",
       nullptr,
       "",
       "Unit of force F0 (without cohesion: a P)."},
  };
}

std::string_view type_name(const SceneField& field) {
  constexpr std::array<std::string_view, std::variant_size_v<SceneField>> names{
      "boolean", "integer", "integer", "real", "real", "text", "list of reals", "text"};
  return names[field.index()];
}

// A scene in which every key has a home: one stage, and units.
Scene full_default() {
  Scene scene;
  scene.stages.resize(1);
  scene.units.emplace();
  return scene;
}

std::string number(double x) {  // for prose: 0.5, 1e+09
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr};
}

std::string range_text(const SceneRange& range) {
  const bool low = range.low > -kInfinity, high = range.high < kInfinity;
  if (low && high)
    return std::string("in ") + (range.low_open ? "(" : "[") + number(range.low) + ", " + number(range.high) +
           (range.high_open ? ")" : "]");
  if (low) return (range.low_open ? "> " : ">= ") + number(range.low);
  if (high) return (range.high_open ? "< " : "<= ") + number(range.high);
  return {};
}

// Scene is only looked at; the table hands out mutable fields because the parser writes through the same rows.
SceneField field_of(const SceneKey& key, const Scene& scene, std::size_t stage) {
  return key.field(const_cast<Scene&>(scene), stage);
}

std::string table_of(const SceneKey& key) {
  const std::size_t dot = key.name.find('.');
  return dot == std::string_view::npos ? std::string{} : std::string(key.name.substr(0, dot));
}

std::string_view leaf_of(const SceneKey& key) { return key.name.substr(key.name.find('.') + 1); }

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> table = make_table();
  return table;
}

bool belongs_to_stage(const SceneKey& key) { return key.name.starts_with("stage."); }
bool belongs_to_units(const SceneKey& key) { return key.name.starts_with("units."); }

std::string full_name(const SceneKey& key, std::size_t stage) {
  if (!belongs_to_stage(key)) return std::string(key.name);
  return "stage." + std::to_string(stage) + "." + std::string(leaf_of(key));
}

std::string real_text(double value) {
  if (value != value) return "nan";
  if (value - value != 0) return value > 0 ? "inf" : "-inf";
  std::string text = number(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string quoted_text(std::string_view value) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "\"";
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      text += '\\', text += c;
    else if (code < 0x20 || code == 0x7f)
      text += "\\u00", text += digits[code >> 4], text += digits[code & 15];
    else
      text += c;
  }
  return text + "\"";
}

std::string value_text(const SceneKey& key, const Scene& scene, std::size_t stage) {
  return std::visit(
      [&](const auto* value) -> std::string {
        using Type = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<Type, bool>)
          return *value ? "true" : "false";
        else if constexpr (std::is_same_v<Type, double>)
          return real_text(*value);
        else if constexpr (std::is_integral_v<Type>)
          return std::to_string(*value);
        else if constexpr (is_optional<Type>)
          return value->has_value() ? real_text(**value) : std::string{};
        else if constexpr (std::is_same_v<Type, std::string>)
          return quoted_text(*value);
        else if constexpr (is_vector<Type>) {
          std::string text;
          for (const double x : *value) text += (text.empty() ? "" : ", ") + real_text(x);
          return "[" + text + "]";
        } else
          return quoted_text(key.choices.at(static_cast<std::size_t>(*value)));
      },
      field_of(key, scene, stage));
}

std::string rule_text(const SceneKey& key) {
  const Scene scene = full_default();
  std::string text(type_name(field_of(key, scene, 0)));
  if (!key.choices.empty()) {
    text = "one of";
    for (const std::string_view choice : key.choices) text += " " + quoted_text(choice);
  }
  const std::string range = range_text(key.range);
  return range.empty() ? text : text + " " + range;
}

std::string scene_to_toml(const Scene& scene) {
  std::string text, table;
  const auto write = [&](const SceneKey& key, std::size_t stage) {
    if (key.applies && !key.applies(scene)) return;
    const std::string value = value_text(key, scene, stage);
    const std::string name(leaf_of(key));
    if (!value.empty())
      text += name + " = " + value + "\n";
    else
      text += "# " + name + ": " + std::string(key.absent) + "\n";
  };
  for (const SceneKey& key : scene_keys()) {
    if (belongs_to_stage(key) || (belongs_to_units(key) && !scene.units)) continue;
    if (table_of(key) != table) {
      table = table_of(key);
      text += "\n[" + table + "]\n";
    }
    write(key, 0);
  }
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    text += "\n[[stage]]\n";
    for (const SceneKey& key : scene_keys())
      if (belongs_to_stage(key)) write(key, stage);
  }
  return text;
}

std::string scene_documentation() {
  const Scene scene = full_default();
  std::string text =
      "# Scene keys\n\n"
      "Generated from the table in `dem/scene_keys.cpp`; run the tests with `ISOSTAT_REGENERATE=1` to write it "
      "anew.\n\n"
      "A scene is a TOML file. Every key has a default unless the table says otherwise; an unknown key is an error. On "
      "the command line, `--set KEY=VALUE` overrides a key with a TOML value (`0.5`, `true`, `'\"text\"'`); keys of "
      "the "
      "n-th `[[stage]]` are `stage.n.KEY`, counted from 0. An integer is accepted for a real. A key whose condition "
      "does not hold is ignored.\n\n"
      "Units: a is the largest diameter, m the mass of a disk of that diameter, F0 the attraction of a contact "
      "(without "
      "cohesion a P), T0 = sqrt(m a / F0), V* = sqrt(F0 D0 / m), F1 = max(F0, a P).\n";
  std::string table = "-";
  for (const SceneKey& key : scene_keys()) {
    if (table_of(key) != table) {
      table = table_of(key);
      const std::string heading = table.empty()           ? "Top level"
                                  : belongs_to_stage(key) ? "`[[stage]]`, in the order they run"
                                  : belongs_to_units(key)
                                      ? "`[units]`, maps the reduced run to SI; all three keys or no table"
                                      : "`[" + table + "]`";
      text += "\n## " + heading +
              "\n\n| key | type and range | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
    }
    std::string fallback = value_text(key, scene, 0);
    if (belongs_to_units(key)) fallback = "required";
    if (fallback.empty()) fallback = std::string(key.absent);
    const std::string unit = key.unit.empty() ? "-" : std::string(key.unit);
    text += "| `" + std::string(key.name) + "` | " + rule_text(key) + " | " + unit + " | " + fallback + " | " +
            std::string(key.meaning);
    if (key.applies) text += " Applies when " + std::string(key.applies_when) + ".";
    text += " |\n";
  }
  return text;
}

}  // namespace isostat
