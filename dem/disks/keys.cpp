#include "dem/disks/keys.hpp"

#include "dem/disks/density.hpp"
#include "dem/scene/size_rows.hpp"

namespace isostat {
namespace {

constexpr SceneCondition has_friction{[](const Scene& s) { return s.law.friction > 0; }, "law.friction > 0"};
constexpr SceneCondition has_rolling{[](const Scene& s) { return s.law.rolling; }, "law.rolling = true"};
constexpr SceneCondition has_attraction{[](const Scene& s) { return s.law.attraction > 0; }, "law.attraction > 0"};

}  // namespace

std::vector<SceneKey> disk_keys() {
  using S = Scene;
  using namespace key_rows;
  std::vector<SceneKey> rows{
      {.name = "grains.arrangement",
       .field = in<&S::grains, &GrainsScene::arrangement>,
       .choices = names(kArrangementNames),
       .condition = random_start,
       .hidden_at_default = true,
       .meaning = "random: at random positions without overlap, at rest. collision: two disks of diameter "
                  "grains.diameter_max in free space; the left one flies to the right against the other, which is "
                  "at rest."},
      {.name = "grains.count",
       .field = in<&S::grains, &GrainsScene::count>,
       .range = from(1, 1e9),
       .condition = random_places,
       .meaning = "Number N of disks."},
      {.name = "grains.solid_fraction",
       .field = in<&S::grains, &GrainsScene::solid_fraction>,
       .range = {0, 1, true, true},
       .condition = random_places,
       .meaning = "Solid fraction Phi_I of the initial state: sum of pi d^2/4 over the area of the cell. Up to 0.5 the "
                  "disks are placed at random without overlap, the largest first (equal ones saturate at 0.547); up to "
                  "0.65, without a container, they are a gas of hard disks in equilibrium (equal ones order at 0.70); "
                  "beyond it they are pushed apart until none overlaps, which succeeds below the density at which they "
                  "jam, about 0.84."},
      {.name = "grains.speed",
       .field = in<&S::grains, &GrainsScene::speed>,
       .unit = "a/T0",
       .range = positive,
       .condition = collision,
       .meaning = "Of the left disk of a collision."},
      {.name = "grains.offset",
       .field = in<&S::grains, &GrainsScene::offset>,
       .unit = "diameters",
       .range = {-1, 1, true, true},
       .condition = collision,
       .meaning = "By which the left disk is higher."},
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
       .range = from(kLeastStepFraction, kInfinity),
       .absent = "0.06, or half the bound if that is less",
       .meaning = "c of the time step dt = c sqrt(m_max / K_N). 0.06 is the reference, 0.10 to 0.12 production; above "
                  "0.16 packings are noisy; a step beyond the stability bound of the smallest and lightest grains is "
                  "refused."},

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
  for (SceneKey& row : size_rows<&S::grains, random_places.holds>(
           random_places.in_words, "Largest diameter, the unit of length: leave it at 1 unless you know why."))
    rows.push_back(std::move(row));
  for (SceneKey& row : file_rows<&S::grains, &GrainsScene::file, &GrainsScene::box>()) rows.push_back(std::move(row));
  return of(SceneSystem::disks, std::move(rows));
}

}  // namespace isostat
