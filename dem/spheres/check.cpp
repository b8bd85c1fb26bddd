#include "dem/spheres/check.hpp"

#include <algorithm>
#include <cmath>

#include "dem/sample/grain_sizes.hpp"
#include "dem/scene/text.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/spheres/time_step.hpp"

namespace isostat {
namespace {

constexpr double kLargestOverlap = 0.1;  // [smallest diameter] static overlap that still means a contact

// F1 [F0] of a stage; a pressure acts on the cross-section of the largest grain.
double largest_force(const Scene& scene, const StageScene& stage) {
  const double diameter = scene.sphere_grains.file.empty() ? scene.sphere_grains.diameter_max : 1.0;
  double pressure =
      std::max(std::abs(largest_stress(imposed_stress<3>(stage)).value_or(0)), std::abs(stage.stress_12.value_or(0)));
  for (const double p : stage.pressures) pressure = std::max(pressure, p);
  return std::max(scene.sphere_law.attraction, pressure * diameter * diameter);
}

void check_grains(const Scene& scene, std::vector<SceneConflict>& found) {
  const SphereGrainsScene& g = scene.sphere_grains;
  if (!g.file.empty()) return;
  for (SceneConflict& c : size_conflicts(g, 3)) found.push_back(std::move(c));
  if (g.arrangement != SphereArrangement::random && g.law() != SizeLaw::uniform && g.law() != SizeLaw::power_law)
    found.push_back({"grains.sizes",
                     quoted_text(kSizeLawNames[static_cast<std::size_t>(g.sizes)]),
                     "\"uniform\" or \"power-law\", since grains.arrangement is " +
                         quoted_text(kSphereArrangementNames[static_cast<std::size_t>(g.arrangement)]),
                     {"grains.sizes", "grains.arrangement"}});
}

// Radii, rooms and trials of insertion, in the words of the scene.
void check_insertion(const Scene& scene, std::vector<SceneConflict>& found) {
  const SphereGrainsScene& g = scene.sphere_grains;
  if (!g.file.empty() || g.arrangement == SphereArrangement::random || g.diameter_min > g.diameter_max) return;
  for (const SceneConflict& c : insertion_conflicts(insertion_of(g), 3))
    found.push_back(
        {c.key == "insertion.volume_factor" ? "grains.volume_factor" : "grains.arrangement",
         c.key + " = " + c.value,
         c.rule,
         {"grains.arrangement", "grains.diameter_min", "grains.diameter_max", "grains.exponent", "grains.edge",
          "grains.shell_radius", "grains.volume_factor", "grains.trials", "grains.soft_share", "grains.soft_radius"}});
  if (g.arrangement == SphereArrangement::insertion) return;
  for (std::size_t i = 0; i < scene.stages.size(); ++i)
    for (const std::string& key : cell_keys(scene.stages[i], i))
      found.push_back(
          {key, "", "a key of the periodic cell, and soft-particles have none", {key, "grains.arrangement"}});
}

void check_stiffness(const Scene& scene, std::vector<SceneConflict>& found) {
  const SphereGrainsScene& g = scene.sphere_grains;
  if (!g.file.empty()) return;
  const SphereLaw law = resolve(scene.sphere_law);
  const bool hertz = law.normal == NormalForce::hertz;
  const double radius = g.diameter_min / 2, depth = 2 * kLargestOverlap;
  // N = 2/3 k d of Hertz's contact, k d of a linear one.
  const double most = (hertz ? 2.0 / 3 : 1.0) * stiffness_of_equal(law, radius, depth) * depth * radius;
  double largest = 0;
  std::vector<std::string> involved{"law.normal",     "law.modulus",         "law.normal_stiffness",
                                    "law.attraction", "grains.diameter_min", "grains.diameter_max"};
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    largest = std::max(largest, largest_force(scene, scene.stages[i]));
    for (const std::string& key : cell_keys(scene.stages[i], i)) involved.push_back(key);
  }
  if (largest > most)
    found.push_back({hertz ? "law.modulus" : "law.normal_stiffness",
                     real_text(hertz ? scene.sphere_law.modulus : scene.sphere_law.normal_stiffness),
                     "too soft: the force scale F1 = max(F0, a^2 P) = " + real_text(largest) +
                         " would overlap contacts of the smallest grains by more than " + real_text(kLargestOverlap) +
                         " of their diameter; at least " + real_text(largest / most) + " times as much",
                     involved});
}

void check_step(const Scene& scene, std::vector<SceneConflict>& found) {
  if (!scene.step.fraction) return;
  const SphereGrainsScene& g = scene.sphere_grains;
  const double bound = critical_fraction(scene, g.file.empty() ? g.diameter_min / 2 : 0.5);
  if (*scene.step.fraction >= bound)
    found.push_back({"step.fraction",
                     real_text(*scene.step.fraction),
                     "unstable for the smallest grain of this law; below " + real_text(bound) +
                         ", or without this key as the grains bear",
                     {"step.fraction", "law.friction", "law.rolling_stiffness", "law.tangential_stiffness"}});
}

void check_stages(const Scene& scene, std::vector<SceneConflict>& found) {
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageScene& s = scene.stages[i];
    const std::string until = stage_key(i, "until"), pressure = stage_key(i, "pressure");
    const bool cohesive = scene.sphere_law.attraction > 0;
    if (s.until == Until::aggregated && !cohesive)
      found.push_back({until, quoted_text(name(s.until)), "needs law.attraction > 0", {until, "law.attraction"}});
    if (waits_for_equilibrium(s.until) && !(largest_force(scene, s) > 0))
      found.push_back({pressure,
                       s.pressure ? real_text(*s.pressure) : "",
                       "greater than 0, since law.attraction is 0 and " + until + " is \"" +
                           std::string(name(s.until)) + "\": without attraction or pressure there is no force scale",
                       {pressure, until, "law.attraction"}});
  }
}

std::string list_text(const std::vector<double>& x) {
  std::string text = "[";
  for (const double v : x) text += (text.size() > 1 ? ", " : "") + real_text(v);
  return text + "]";
}
bool is_law(const std::vector<double>& x) {
  return x.size() == 6 && x[0] > 0 && x[1] >= 1 && x[2] <= 0 && x[3] >= 0 && x[4] > 0 && x[5] >= 0;
}

// Several materials, and soft-particles.
void check_kinds(const Scene& scene, std::vector<SceneConflict>& found) {
  const SphereGrainsScene& g = scene.sphere_grains;
  const SphereLawScene& law = scene.sphere_law;
  const bool soft = g.soft_share > 0 && g.file.empty();
  const std::string rule =
      "six numbers: force > 0, exponent >= 1, offset <= 0, tangential >= 0, tangential exponent > "
      "0, friction >= 0";
  const auto check_law = [&](const std::string& key, const std::vector<double>& x) {
    if (!is_law(x)) found.push_back({key, list_text(x), rule, {key}});
  };
  if (soft || !g.file.empty()) check_law("law.soft_solid", law.soft_solid), check_law("law.soft_soft", law.soft_soft);
  if (!(g.second_share > 0) && !soft) return;
  const std::string of = g.second_share > 0 ? "grains.second_share" : "grains.soft_share";
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& wanted) {
    found.push_back({key, value, wanted, {key, of}});
  };
  const std::string because = ", since " + of + " > 0";
  if (law.normal != NormalForce::hertz) refuse("law.normal", quoted_text("linear"), "\"hertz\"" + because);
  if (law.attraction > 0) refuse("law.attraction", real_text(law.attraction), "0" + because);
  if (law.rolling) refuse("law.rolling", "true", "false" + because);
  if (soft && !(g.soft_radius > 0))
    refuse("grains.soft_radius", real_text(g.soft_radius), "greater than 0, since grains.soft_share > 0");
}

// What spheres cannot do.
void check_limits(const Scene& scene, std::vector<SceneConflict>& found) {
  if (scene.container.shape != ContainerShape::none)
    found.push_back({"container.shape",
                     quoted_text(kContainerShapeNames[static_cast<std::size_t>(scene.container.shape)]),
                     "containers are of the plane: \"none\" for spheres",
                     {"container.shape"}});
  if (scene.output.energies)
    found.push_back({"output.energies", "true", "spheres keep no energy ledger", {"output.energies"}});
  if (scene.finish.method == Finish::newton)
    found.push_back({"finish.method",
                     quoted_text("newton"),
                     "static solves are of disks: \"none\" or \"drag\" for spheres",
                     {"finish.method"}});
}

}  // namespace

std::vector<SceneConflict> sphere_conflicts(const Scene& scene) {
  std::vector<SceneConflict> found;
  check_grains(scene, found);
  check_insertion(scene, found);
  check_stiffness(scene, found);
  check_step(scene, found);
  check_stages(scene, found);
  check_kinds(scene, found);
  check_limits(scene, found);
  return found;
}

}  // namespace isostat
