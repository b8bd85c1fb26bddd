#include "dem/scene/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/disks/scales.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

constexpr double kLargestOverlap = 0.1;  // [smallest diameter] static overlap F1 / K_N that still means a contact

std::string stage_key(std::size_t stage, const char* key) { return "stage." + std::to_string(stage) + "." + key; }

// Longer edge of the initial cell, L1 L2 = sum pi d^2/4 / Phi_I with the mean square of a uniform diameter.
double longest_edge(const Scene& scene) {
  const GrainsScene& g = scene.grains;
  const double mean_square = (g.diameter_min * (g.diameter_min + g.diameter_max) + g.diameter_max * g.diameter_max) / 3;
  const double area = g.count * std::numbers::pi / 4 * mean_square / g.solid_fraction;
  return std::sqrt(area * std::max(scene.cell.aspect, 1 / scene.cell.aspect));
}

// F1 [F0] of a stage, a = 1.
double largest_force(const LawScene& law, const StageScene& stage) {
  double force = std::max(law.attraction, std::abs(largest_stress(imposed_stress(stage)).value_or(0)));
  for (const double p : stage.pressures) force = std::max(force, p);
  return force;
}

void check_grains(const Scene& scene, std::vector<SceneConflict>& found) {
  const GrainsScene& g = scene.grains;
  if (g.file.empty() && g.diameter_min > g.diameter_max)
    found.push_back({"grains.diameter_min",
                     real_text(g.diameter_min),
                     "at most grains.diameter_max = " + real_text(g.diameter_max),
                     {"grains.diameter_min", "grains.diameter_max"}});
}

// Contacts must be stiff against the forces of the run, and soft against the rounding of coordinates.
void check_stiffness(const Scene& scene, std::vector<SceneConflict>& found) {
  const double stiffness = scene.law.normal_stiffness;
  const bool random = scene.grains.file.empty();
  double largest = scene.law.attraction, smallest = std::numeric_limits<double>::infinity();
  std::vector<std::string> involved{"law.normal_stiffness", "law.attraction", "grains.diameter_min"};
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const double force = largest_force(scene.law, scene.stages[i]);
    largest = std::max(largest, force);
    if (force > 0) smallest = std::min(smallest, force);
    for (const char* key : {"pressure", "pressures", "stress_1", "stress_2"}) involved.push_back(stage_key(i, key));
  }
  const double diameter = random ? scene.grains.diameter_min : 1.0;
  if (largest > kLargestOverlap * diameter * stiffness)
    found.push_back({"law.normal_stiffness", real_text(stiffness),
                     "too soft: the force scale F1 = max(F0, a P) = " + real_text(largest) +
                         " would overlap contacts by more than " + real_text(kLargestOverlap) +
                         " of the smallest diameter; at least " + real_text(largest / (kLargestOverlap * diameter)),
                     involved});
  // A gap is a difference of coordinates up to L, rounded to eps L; times K_N it must stay below the force tolerance.
  if (!random || smallest == std::numeric_limits<double>::infinity()) return;
  const double rounding = std::numeric_limits<double>::epsilon() * longest_edge(scene);
  const double stiffest = scene.equilibrium.force * smallest / rounding;
  if (stiffness > stiffest) {
    involved.insert(involved.end(), {"equilibrium.force", "grains.count", "grains.diameter_max",
                                     "grains.solid_fraction", "cell.aspect"});
    found.push_back({"law.normal_stiffness", real_text(stiffness),
                     "too stiff: the rounding of the coordinates alone makes forces above equilibrium.force; at most " +
                         real_text(stiffest),
                     involved});
  }
}

void check_step(const Scene& scene, std::vector<SceneConflict>& found) {
  const GrainsScene& g = scene.grains;
  const LawParameters law = resolve(scene.law);
  const double smallest = g.file.empty() ? g.diameter_min : 1.0, largest = g.file.empty() ? g.diameter_max : 1.0;
  const double bound = critical_time_step(law, smallest) / time_step(law, 1.0, largest);
  if (scene.step.fraction >= bound)
    found.push_back({"step.fraction",
                     real_text(scene.step.fraction),
                     "unstable for the smallest grain of this law; below " + real_text(bound) +
                         (bound > 0.06 ? ", 0.06 is the reference" : " (set by grains.diameter_min)"),
                     {"step.fraction", "grains.diameter_min", "grains.diameter_max", "law.normal_stiffness",
                      "law.tangential_stiffness", "law.rolling_stiffness", "law.friction", "law.rolling_friction"}});
}

bool waits_for_equilibrium(const StageScene& s) { return s.until == "equilibrium" || s.until == "aggregated"; }

// Each direction has one master, and the end of a stage must be one that its directions can reach.
void check_control(const Scene& scene, std::size_t i, std::vector<SceneConflict>& found) {
  const StageScene& s = scene.stages[i];
  const auto key = [i](const char* name) { return stage_key(i, name); };
  const auto one_master = [&](const std::optional<double>& stress, const std::optional<double>& rate, const char* k) {
    if (stress && rate)
      found.push_back({key(k),
                       real_text(*rate),
                       "a direction has an imposed stress or a strain rate, not both",
                       {key(k), key(k == std::string("strain_rate_1") ? "stress_1" : "stress_2")}});
  };
  one_master(s.stress_1, s.strain_rate_1, "strain_rate_1");
  one_master(s.stress_2, s.strain_rate_2, "strain_rate_2");
  const bool driven = s.strain_rate_1.value_or(0) != 0 || s.strain_rate_2.value_or(0) != 0;
  const std::vector<std::string> involved{key("until"), key("strain_rate_1"), key("strain_rate_2")};
  if (waits_for_equilibrium(s) && driven)
    found.push_back({key("until"), quoted_text(s.until),
                     "a driven cell never comes to rest: \"strain\", \"failure\" or \"time\"", involved});
  if ((s.until == "strain" || s.until == "failure") && !driven)
    found.push_back(
        {key("until"), quoted_text(s.until), "needs a strain rate other than 0 along a direction", involved});
  if (s.until == "strain" && !(s.strain > 0))
    found.push_back({key("strain"),
                     real_text(s.strain),
                     "greater than 0, since " + key("until") + " is \"strain\"",
                     {key("strain"), key("until")}});
  if (s.until == "aggregated" && !(scene.law.attraction > 0))
    found.push_back({key("until"), quoted_text(s.until), "needs law.attraction > 0", {key("until"), "law.attraction"}});
  if (!s.pressures.empty() && s.pressure)
    found.push_back({key("pressures"), "", "either pressure or pressures", {key("pressure"), key("pressures")}});
}

void check_stages(const Scene& scene, std::vector<SceneConflict>& found) {
  if (scene.stages.empty()) found.push_back({"stage", "", "at least one [[stage]]", {"stage"}});
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageScene& s = scene.stages[i];
    const std::string until = stage_key(i, "until"), time = stage_key(i, "time");
    if (s.until == "time" && !(s.time > 0))
      found.push_back({time, real_text(s.time), "greater than 0, since " + until + " is \"time\"", {time, until}});
    if (s.until != "time" && s.time > 0)
      found.push_back({time, real_text(s.time), "only with " + until + " = \"time\"", {time, until}});
    check_control(scene, i, found);
    if (scene.law.attraction > 0) continue;
    const std::string velocity = stage_key(i, "velocity"), pressure = stage_key(i, "pressure");
    if (s.velocity > 0)
      found.push_back({velocity,
                       real_text(s.velocity),
                       "0, since law.attraction is 0: the unit V* = sqrt(F0 D0 / m) vanishes",
                       {velocity, "law.attraction"}});
    if (waits_for_equilibrium(s) && !(largest_force(scene.law, s) > 0))
      found.push_back({pressure,
                       s.pressure ? real_text(*s.pressure) : "",
                       "greater than 0, since law.attraction is 0 and " + until + " is \"" + s.until +
                           "\": without attraction or pressure there is no force scale",
                       {pressure, until, "law.attraction"}});
  }
}

}  // namespace

std::vector<SceneConflict> conflicts(const Scene& scene) {
  std::vector<SceneConflict> found;
  check_grains(scene, found);
  check_stiffness(scene, found);
  check_step(scene, found);
  check_stages(scene, found);
  return found;
}

}  // namespace isostat
