#include "dem/disks/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/disks/density.hpp"
#include "dem/disks/scales.hpp"
#include "dem/sample/grain_sizes.hpp"
#include "dem/scene/text.hpp"
#include "dem/state/container_region.hpp"

namespace isostat {
namespace {

constexpr double kPackedFraction = 0.8;  // [-] solid fraction of a bed of disks, about
constexpr double kLargestOverlap = 0.1;  // [smallest diameter] static overlap F1 / K_N that still means a contact

bool contained(const Scene& scene) { return scene.container.shape != ContainerShape::none; }

// Whether the grains are known before they are read from a file or table.
bool sizes_known(const GrainsScene& g) {
  return g.file.empty() && (g.arrangement == Arrangement::collision || g.law() != SizeLaw::table);
}

// Sum of pi d^2/4 to be expected, of known sizes.
double area_of_grains(const GrainsScene& g) { return g.count * std::numbers::pi / 4 * GrainSizes(g, 2).mean_power(2); }

double density_of_large(const GrainsScene& g) { return g.law() == SizeLaw::bidisperse ? g.density_ratio : 1; }

// Longer edge of the container or of the initial cell, L1 L2 = sum pi d^2/4 / Phi_I.
double longest_edge(const Scene& scene) {
  const ContainerScene& c = scene.container;
  if (contained(scene)) return std::max(2 * half_width(c), region_top(c) - region_bottom(c));
  const double area = area_of_grains(scene.grains) / scene.grains.solid_fraction;
  return std::sqrt(area * std::max(scene.cell.aspect, 1 / scene.cell.aspect));
}

double smallest_diameter(const Scene& scene) {
  const GrainsScene& g = scene.grains;
  return !g.file.empty() ? 1.0 : is_collision(scene) || !sizes_known(g) ? g.diameter_max : g.diameter_min;
}

double largest_diameter(const Scene& scene) { return scene.grains.file.empty() ? scene.grains.diameter_max : 1.0; }

// [m] of the heaviest grain, as far as it is known.
double largest_mass(const Scene& scene) {
  const double d = largest_diameter(scene), mass = d * d;
  if (!scene.grains.file.empty() || is_collision(scene)) return mass;
  const double small = smallest_diameter(scene);
  return std::max(mass * density_of_large(scene.grains), small * small);
}

// Weight of the heaviest grain [F0].
double heaviest(const Scene& scene) { return largest_mass(scene) * scene.gravity; }

// F1 [F0] of a stage, a = 1.
double largest_force(const Scene& scene, const StageScene& stage) {
  double force = std::max({scene.law.attraction, std::abs(largest_stress(imposed_stress<2>(stage)).value_or(0)),
                           std::abs(stage.stress_12.value_or(0)), heaviest(scene)});
  for (const double p : stage.pressures) force = std::max(force, p);
  return force;
}

void check_grains(const Scene& scene, std::vector<SceneConflict>& found) {
  const GrainsScene& g = scene.grains;
  if (g.file.empty() && !is_collision(scene))
    for (SceneConflict& c : size_conflicts(g, 2)) found.push_back(std::move(c));
}

// Contacts must be stiff against the forces of the run, and soft against the rounding of coordinates.
void check_stiffness(const Scene& scene, std::vector<SceneConflict>& found) {
  std::vector<std::pair<std::string, double>> stiffnesses{{"law.normal_stiffness", scene.law.normal_stiffness}};
  for (std::size_t i = 0; i < scene.stages.size(); ++i)
    if (const auto& k = scene.stages[i].normal_stiffness)
      stiffnesses.emplace_back(stage_key(i, "normal_stiffness"), *k);
  const bool random = sizes_known(scene.grains) && !is_collision(scene);
  double largest = scene.law.attraction, smallest = std::numeric_limits<double>::infinity();
  std::vector<std::string> involved{"law.normal_stiffness", "law.attraction", "grains.diameter_min", "gravity"};
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const double force = largest_force(scene, scene.stages[i]);
    largest = std::max(largest, force);
    if (force > 0) smallest = std::min(smallest, force);
    for (const char* key : {"pressure", "pressures", "stress_1", "stress_2", "stress_12"})
      involved.push_back(stage_key(i, key));
  }
  const double diameter = smallest_diameter(scene);
  for (const auto& [key, stiffness] : stiffnesses)
    if (largest > kLargestOverlap * diameter * stiffness) {
      involved.front() = key;
      found.push_back({key, real_text(stiffness),
                       "too soft: the force scale F1 = max(F0, a P, weight of a grain) = " + real_text(largest) +
                           " would overlap contacts by more than " + real_text(kLargestOverlap) +
                           " of the smallest diameter; at least " + real_text(largest / (kLargestOverlap * diameter)),
                       involved});
    }
  // A gap is a difference of coordinates up to L, rounded to eps L; times K_N it must stay below the force tolerance.
  if (!random || smallest == std::numeric_limits<double>::infinity()) return;
  const double rounding = std::numeric_limits<double>::epsilon() * longest_edge(scene);
  const double stiffest = scene.equilibrium.force * smallest / rounding;
  involved.insert(involved.end(),
                  {"equilibrium.force", "grains.count", "grains.diameter_max", "grains.solid_fraction", "cell.aspect"});
  for (const auto& [key, stiffness] : stiffnesses)
    if (stiffness > stiffest) {
      involved.front() = key;
      found.push_back(
          {key, real_text(stiffness),
           "too stiff: the rounding of the coordinates alone makes forces above equilibrium.force; at most " +
               real_text(stiffest),
           involved});
    }
}

void check_step(const Scene& scene, std::vector<SceneConflict>& found) {
  if (!scene.step.fraction) return;
  const DiskLaw law = resolve(scene.law);
  const double smallest = smallest_diameter(scene), largest = largest_diameter(scene);
  const double critical =
      std::min(critical_time_step(law, smallest),
               critical_time_step(law, largest, largest * largest * density_of_large(scene.grains)));
  const double bound = critical / time_step(law, 1.0, largest_mass(scene));
  if (*scene.step.fraction >= bound)
    found.push_back({"step.fraction",
                     real_text(*scene.step.fraction),
                     "unstable for the smallest grain of this law; below " + real_text(bound) +
                         (bound > 0.06 ? ", 0.06 is the reference" : " (set by grains.diameter_min)") +
                         ", or without this key as the grains bear",
                     {"step.fraction", "grains.diameter_min", "grains.diameter_max", "grains.sizes",
                      "grains.density_ratio", "law.normal_stiffness", "law.tangential_stiffness",
                      "law.rolling_stiffness", "law.friction", "law.rolling_friction"}});
}

// Without cohesion some ends have no meaning.
void check_cohesion(const Scene& scene, std::vector<SceneConflict>& found) {
  if (scene.law.attraction > 0) return;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageScene& s = scene.stages[i];
    const std::string until = stage_key(i, "until"), pressure = stage_key(i, "pressure");
    if (s.until == Until::aggregated)
      found.push_back({until, quoted_text(name(s.until)), "needs law.attraction > 0", {until, "law.attraction"}});
    if (waits_for_equilibrium(s.until) && !(largest_force(scene, s) > 0))
      found.push_back({pressure,
                       s.pressure ? real_text(*s.pressure) : "",
                       "greater than 0, since law.attraction is 0 and " + until + " is \"" +
                           std::string(name(s.until)) +
                           "\": without attraction, pressure or gravity there is no force scale",
                       {pressure, until, "law.attraction", "gravity"}});
  }
}

// The grains at the bottom of a container carry those above them.
void check_bed(const Scene& scene, std::vector<SceneConflict>& found) {
  if (!contained(scene) || !sizes_known(scene.grains)) return;
  const ContainerScene& c = scene.container;
  const double depth = height_of_area(c, area_of_grains(scene.grains) / kPackedFraction) - region_bottom(c);
  const double load = heaviest(scene) * std::max(1.0, depth / scene.grains.diameter_max);
  const double least = load / (kLargestOverlap * scene.grains.diameter_min);
  if (scene.law.normal_stiffness < least)
    found.push_back({"law.normal_stiffness",
                     real_text(scene.law.normal_stiffness),
                     "too soft: the bed, " + real_text(depth) +
                         " a deep, would overlap contacts at its bottom by more "
                         "than " +
                         real_text(kLargestOverlap) + " of the smallest diameter; at least " + real_text(least),
                     {"law.normal_stiffness", "gravity", "grains.count", "grains.diameter_min", "grains.diameter_max",
                      "container.width"}});
}

// What disks cannot do in a container, or under gravity.
void check_surroundings(const Scene& scene, std::vector<SceneConflict>& found) {
  if (!contained(scene)) return;
  if (scene.finish.method == Finish::newton)
    found.push_back({"finish.method",
                     quoted_text("newton"),
                     "static solves know neither weight nor walls: \"none\" or \"drag\" with a container",
                     {"finish.method", "container.shape", "gravity"}});
  const GrainsScene& g = scene.grains;
  if (!g.file.empty()) return;
  if (!is_collision(scene) && g.solid_fraction > kDensestAtRandom)
    found.push_back({"grains.solid_fraction",
                     real_text(g.solid_fraction),
                     "at most " + real_text(kDensestAtRandom) + " in a container, where disks are placed at random",
                     {"grains.solid_fraction", "container.shape"}});
  if (!scene.step.fraction || !sizes_known(g)) return;  // the grains say the time step
  const double dt = time_step(resolve(scene.law), *scene.step.fraction, largest_mass(scene));
  for (SceneConflict& c : wall_motion_conflicts(scene, dt, g.diameter_min)) found.push_back(std::move(c));
}

}  // namespace

std::vector<SceneConflict> disk_conflicts(const Scene& scene) {
  std::vector<SceneConflict> found;
  check_grains(scene, found);
  check_stiffness(scene, found);
  check_step(scene, found);
  check_cohesion(scene, found);
  check_bed(scene, found);
  check_surroundings(scene, found);
  return found;
}

}  // namespace isostat
