#include "dem/triangles/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/input_error.hpp"
#include "dem/scene/text.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/time_step.hpp"

namespace isostat {
namespace {

void check_grains(const Scene& scene, std::vector<SceneConflict>& found) {
  const TriangleGrainsScene& g = scene.triangle_grains;
  if (g.file.empty() && !is_collision(scene) && g.size_min > g.size_max)
    found.push_back({"grains.size_min",
                     real_text(g.size_min),
                     "at most grains.size_max = " + real_text(g.size_max),
                     {"grains.size_min", "grains.size_max"}});
}

void check_law(const Scene& scene, std::vector<SceneConflict>& found) {
  const TriangleLawScene& l = scene.triangle_law;
  if (l.failure != BeamFailure::none && !l.limit_tension && !l.limit_shear && !l.limit_bending && !l.limit_stretch &&
      !l.limit_angle)
    found.push_back({"law.failure",
                     quoted_text(kBeamFailureNames[static_cast<std::size_t>(l.failure)]),
                     "needs a limit: law.limit_tension, limit_shear, limit_bending, limit_stretch or limit_angle",
                     {"law.failure", "law.limit_tension", "law.limit_shear", "law.limit_bending", "law.limit_stretch",
                      "law.limit_angle"}});
}

// Step, and walls in motion against it. Of a file the grains are not known here (dem/triangles/sample.cpp).
void check_step(const Scene& scene, std::vector<SceneConflict>& found) {
  const TriangleGrainsScene& g = scene.triangle_grains;
  if (!g.file.empty() || (!is_collision(scene) && g.size_min > g.size_max)) return;
  const std::vector<std::string> shapes =
      is_collision(scene) ? std::vector<std::string>{"square"} : shape_names(g.shape);
  const double size = is_collision(scene) ? g.size_max : g.size_min, modulus = scene.triangle_law.modulus;
  double fastest = 0, stable = std::numeric_limits<double>::infinity(), smallest = stable;
  for (const std::string& shape : shapes) try {
      const GrainTemplate grain = grain_template(grain_shape(shape, size), material_of(scene));
      fastest = std::max(fastest, step_frequency(grain, modulus));
      stable = std::min(stable, largest_step(grain, modulus, scene.step.integrator));
      smallest = std::min(smallest, std::sqrt(grain_area(grain)));
    } catch (const InputError& error) {
      const Fault& f = error.faults().front();
      const std::string place = f.line ? " (" + f.file + ":" + std::to_string(f.line) + ")" : "";
      found.push_back({"grains.shape",
                       quoted_text(shape),
                       f.rule + place,
                       {"grains.shape", "grains.size_min", "grains.size_max", "grains.density", "law.stiffness",
                        "law.bending", "law.damping"}});
      return;
    }
  const double bound = stable * fastest;
  if (!(triangle_step_fraction(scene) < bound))
    found.push_back({"step.fraction",
                     real_text(triangle_step_fraction(scene)),
                     "unstable for the smallest grain (" + real_text(size) + " cm) under \"" +
                         std::string(kIntegratorNames[static_cast<std::size_t>(scene.step.integrator)]) + "\"; below " +
                         real_text(bound),
                     {"step.fraction", "step.integrator", "grains.shape", "grains.size_min", "grains.size_max",
                      "grains.density", "law.modulus", "law.stiffness", "law.bending", "law.damping"}});
  else
    for (SceneConflict& c : wall_motion_conflicts(scene, triangle_step_fraction(scene) / fastest, smallest))
      found.push_back(std::move(c));
}

void check_stages(const Scene& scene, std::vector<SceneConflict>& found) {
  if (scene.finish.method == Finish::newton)
    found.push_back({"finish.method",
                     quoted_text("newton"),
                     "static solves know disks only; \"drag\" or \"none\"",
                     {"finish.method"}});
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageScene& s = scene.stages[i];
    const std::string until = stage_key(i, "until"), pressure = stage_key(i, "pressure");
    if (s.until == Until::aggregated)
      found.push_back({until, quoted_text(name(s.until)), "only of disks, which attract each other", {until}});
    if (scene.step.integrator == Integrator::gear && !cell_keys(s, i).empty())
      found.push_back({"step.integrator",
                       quoted_text("gear"),
                       "needs a cell that stays as it is; \"verlet\" where " + cell_keys(s, i).front() + " is given",
                       {"step.integrator", cell_keys(s, i).front()}});
    const bool loaded = largest_stress(imposed_stress<2>(s)).value_or(0) != 0 ||
                        std::any_of(s.pressures.begin(), s.pressures.end(), [](double p) { return p > 0; });
    if (s.until == Until::equilibrium && scene.gravity == 0 && !loaded)
      found.push_back({until,
                       quoted_text(name(s.until)),
                       "needs gravity, or " + pressure + " greater than 0: without them there is no force scale",
                       {until, pressure, "gravity", "container.shape"}});
  }
}

}  // namespace

std::vector<SceneConflict> triangle_conflicts(const Scene& scene) {
  std::vector<SceneConflict> found;
  check_grains(scene, found);
  check_law(scene, found);
  check_step(scene, found);
  check_stages(scene, found);
  return found;
}

}  // namespace isostat
