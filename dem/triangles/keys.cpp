#include "dem/triangles/keys.hpp"

#include "dem/scene/key_rows.hpp"

namespace isostat {
namespace {

using G = TriangleGrainsScene;
using L = TriangleLawScene;

constexpr SceneCondition has_friction{[](const Scene& s) { return s.triangle_law.friction > 0; }, "law.friction > 0"};
constexpr SceneCondition has_failure{[](const Scene& s) { return s.triangle_law.failure != BeamFailure::none; },
                                     "law.failure is not \"none\""};
constexpr std::string_view kNoLimit = "never";

std::vector<SceneKey> grains_rows() {
  using S = Scene;
  using namespace key_rows;
  return {
      {.name = "grains.arrangement",
       .field = in<&S::triangle_grains, &G::arrangement>,
       .choices = names(kArrangementNames),
       .condition = random_start,
       .meaning = "random: at random positions without overlap, at rest. collision: two squares of side "
                  "grains.size_max with edges along the axes, in free space; the left one flies to the right against "
                  "the other, which is at rest (Poeschel and Buchholtz 1995, Sec. 6.1)."},
      {.name = "grains.count",
       .field = in<&S::triangle_grains, &G::count>,
       .range = from(1, 1e9),
       .condition = random_places,
       .meaning = "Number of grains, those of walls not counted."},
      {.name = "grains.shape",
       .field = in<&S::triangle_grains, &G::shape>,
       .condition = random_places,
       .meaning = "Shapes, separated by commas and taken in turn: square, triangle, polygonN (polygon6), rod, L, star, "
                  "or a file of corners (docs/grains.md), relative to the directory in which the program runs."},
      {.name = "grains.size_min",
       .field = in<&S::triangle_grains, &G::size_min>,
       .unit = "cm",
       .range = positive,
       .condition = random_places,
       .meaning = "Smallest size; sizes are uniform between the two. Side of a square, triangle or polygon, length of "
                  "a rod or of the arms of an L, diameter of a star; of a file a factor."},
      {.name = "grains.size_max",
       .field = in<&S::triangle_grains, &G::size_max>,
       .unit = "cm",
       .range = positive,
       .condition = random_start,
       .meaning = "Largest size."},
      {.name = "grains.density",
       .field = in<&S::triangle_grains, &G::density>,
       .unit = "g/cm^2",
       .range = positive,
       .condition = random_start,
       .meaning = "Mass of a grain over its area."},
      {.name = "grains.solid_fraction",
       .field = in<&S::triangle_grains, &G::solid_fraction>,
       .range = {0, 0.6, true, false},
       .condition = random_places,
       .meaning = "Area of the grains over the area that they are placed in: the cell, whose size follows; of a box, "
                  "hopper or drum the lower part that this takes. Equal squares placed at random without overlap "
                  "saturate near 0.53."},
      {.name = "grains.speed",
       .field = in<&S::triangle_grains, &G::speed>,
       .unit = "cm/s",
       .range = positive,
       .condition = collision,
       .meaning = "Of the left square of a collision."},
      {.name = "grains.offset",
       .field = in<&S::triangle_grains, &G::offset>,
       .unit = "sides",
       .range = {-1, 1, true, true},
       .condition = collision,
       .meaning = "By which the left square is higher."},
      {.name = "grains.file",
       .field = in<&S::triangle_grains, &G::file>,
       .meaning = "A state of triangles to start from instead; relative to the directory in which the program runs. "
                  "Empty: none."},
  };
}

std::vector<SceneKey> law_rows() {
  using S = Scene;
  using namespace key_rows;
  return {
      {.name = "law.contact",
       .field = in<&S::triangle_law, &L::contact>,
       .choices = names(kContactLawNames),
       .meaning = "overlap-energy: U = Y A_c^2 / (2 L_c), with A_c the overlap of two grains; conserves energy. paper: "
                  "force Y A_c on the chord of each pair of triangles (Poeschel and Buchholtz 1995, Sec. 3), which "
                  "does not."},
      {.name = "law.modulus",
       .field = in<&S::triangle_law, &L::modulus>,
       .unit = "g/(cm s^2)",
       .range = positive,
       .meaning = "Y of the contacts."},
      {.name = "law.overlap_length",
       .field = in<&S::triangle_law, &L::overlap_length>,
       .unit = "cm",
       .range = not_negative,
       .condition = {[](const Scene& s) { return s.triangle_law.contact == ContactLaw::overlap_energy; },
                     "law.contact is \"overlap-energy\""},
       .meaning = "L_c; 0: 2 l_i l_j / (l_i + l_j), with l the square root of the area of a grain."},
      {.name = "law.friction",
       .field = in<&S::triangle_law, &L::friction>,
       .range = not_negative,
       .meaning = "mu, Coulomb friction of an overlap; the paper has none."},
      {.name = "law.tangential_stiffness",
       .field = in<&S::triangle_law, &L::tangential_stiffness>,
       .unit = "g/s^2",
       .range = positive,
       .condition = has_friction,
       .meaning = "k_T of the friction spring of two grains."},
      {.name = "law.stiffness",
       .field = in<&S::triangle_law, &L::stiffness>,
       .unit = "g/s^2",
       .range = positive,
       .meaning = "E of the beams, a force per elongation."},
      {.name = "law.bending",
       .field = in<&S::triangle_law, &L::bending>,
       .unit = "g cm^3/s^2",
       .range = positive,
       .meaning = "E I of the beams."},
      {.name = "law.damping",
       .field = in<&S::triangle_law, &L::damping>,
       .unit = "g/s",
       .range = not_negative,
       .meaning = "gamma of the beams: force per rate of elongation; gamma I / L0 of the bending."},
      {.name = "law.failure",
       .field = in<&S::triangle_law, &L::failure>,
       .choices = names(kBeamFailureNames),
       .meaning = "What becomes of a beam beyond a limit: nothing; it breaks; it yields, so that its rest length or "
                  "its rest angles change."},
      {.name = "law.limit_tension",
       .field = in<&S::triangle_law, &L::limit_tension>,
       .unit = "dyn",
       .range = positive,
       .absent = kNoLimit,
       .condition = has_failure,
       .meaning = "Largest tension -N."},
      {.name = "law.limit_shear",
       .field = in<&S::triangle_law, &L::limit_shear>,
       .unit = "dyn",
       .range = positive,
       .absent = kNoLimit,
       .condition = has_failure,
       .meaning = "Largest force across the beam |T|."},
      {.name = "law.limit_bending",
       .field = in<&S::triangle_law, &L::limit_bending>,
       .unit = "dyn cm",
       .range = positive,
       .absent = kNoLimit,
       .condition = has_failure,
       .meaning = "Largest moment of an end."},
      {.name = "law.limit_stretch",
       .field = in<&S::triangle_law, &L::limit_stretch>,
       .range = positive,
       .absent = kNoLimit,
       .condition = has_failure,
       .meaning = "Largest |L/L0 - 1|."},
      {.name = "law.limit_angle",
       .field = in<&S::triangle_law, &L::limit_angle>,
       .unit = "rad",
       .range = positive,
       .absent = kNoLimit,
       .condition = has_failure,
       .meaning = "Largest rotation of an end against the chord."},

      {.name = "step.integrator",
       .field = in<&S::step, &StepScene::integrator>,
       .choices = names(kIntegratorNames),
       .meaning = "verlet: velocity Verlet with spins implicit in the dampers; gear: predictor-corrector of fourth "
                  "order, as in the paper, a quarter of the step."},
      {.name = "step.fraction",
       .field = in<&S::step, &StepScene::fraction>,
       .range = from(kLeastStepFraction, kInfinity),
       .absent = "0.6",
       .meaning = "c of the time step dt = c / omega, with omega the largest frequency of the smallest grain of each "
                  "shape (`isostat lab grain`). 0.6 is production, 0.2 the reference; a step beyond the stability "
                  "bound is refused."},
  };
}

}  // namespace

std::vector<SceneKey> triangle_keys() {
  std::vector<SceneKey> rows = grains_rows();
  for (SceneKey& row : law_rows()) rows.push_back(std::move(row));
  return key_rows::of(SceneSystem::triangles, std::move(rows));
}

}  // namespace isostat
