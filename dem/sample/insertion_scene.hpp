// What a user asks of hierarchical insertion (seed 000, Sec. 3). Lengths in any one unit: only their ratios matter.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "dem/sample/size_distribution.hpp"
#include "dem/scene/check.hpp"

namespace isostat {

enum class InsertionRoom { shell, box };

struct InsertionScene {
  InsertionRoom room = InsertionRoom::shell;
  double shell_radius = 1;                     // R_s [length] of the sphere, in the plane of the circle
  std::array<double, 3> box{{2, 2, 2}};        // [length] edges of the periodic box, in the plane the first two
  double radius_min = 0.05, radius_max = 0.5;  // [length] bounds of the law; Pi = radius_max / radius_min
  double exponent = 3.5;                       // b of N(r) ~ r^-b; 0: uniform
  double volume_factor = 3;              // beta: volume of the listed grains over that of the room; from 1 on, but
                                         // with soft-particles from 0 on
  double trials = 3e4;                   // I >= 1: random points tried for each grain
  std::optional<double> solid_fraction;  // reached by the choice of I, in place of `trials`
  double soft_share = 0;                 // [-] of the listed volume that soft-particles have, all of one radius
  double soft_radius = 0;                // [length]; they are placed with the others and do not grow

  SizeDistribution sizes() const { return {radius_min, radius_max, exponent}; }
};

// Every broken rule, with keys `insertion.NAME`; dimension 2 or 3.
std::vector<SceneConflict> insertion_conflicts(const InsertionScene& scene, int dimension);

// Radii that no law with these bounds has: what a fit of the law must not be given.
std::vector<SceneConflict> radius_conflicts(const std::vector<double>& radii, double radius_min, double radius_max);

}  // namespace isostat
