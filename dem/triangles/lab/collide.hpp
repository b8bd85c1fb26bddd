// `lab collide-squares`: two squares of four triangles collide, Poeschel and Buchholtz 1995, Sec. 6.1, Figs. 14 and 15.
// The left one, higher by the offset, flies along +x; the other rests. Edges along the axes.
#pragma once
#include <optional>

#include "dem/scene/scene.hpp"

namespace isostat::lab {

struct CollisionSetup {
  double speed = 50;    // V [cm/s]
  double side = 0.14;   // s [cm]
  double offset = 0.5;  // [s]
  double damping = 9;   // gamma [g/s]
  ContactLaw law = ContactLaw::paper;
  Integrator integrator = Integrator::verlet;
  std::optional<double> step;  // c in dt = c/omega_max; none: halved until nothing changes any more
};

struct Collision {
  double translation = 0, rotation = 0;   // [E0] of the two grains as wholes, once they cannot meet again
  double stored = 0;                      // [E0] in their vibrations then, and in the overlap: dampers take it later
  double spin_first = 0, spin_final = 0;  // [V/s] mean of the two grains after their first contact, and at the end
  double step = 0;                        // c
  double change = 0;                      // largest of the four numbers' changes from twice this step; 0: not tried
  long long steps = 0;
  double cpu_seconds = 0;  // of stepping
};

// Largest c at which the square is stable with this integrator.
double largest_fraction(const CollisionSetup& setup);

// Without a step the numbers are those of the first c = kCoarsest/2^n (less for squares whose dampers need it)
// for which they have changed by less than
// kConverged in two halvings one after the other: force gradients jump where corners pass edges, so that errors fall
// like dt, erratically. Throws RunError where they do not, or where the squares do not part.
Collision collide_squares(const CollisionSetup& setup);
inline constexpr double kCoarsest = 0.04, kConverged = 2.5e-4;

}  // namespace isostat::lab
