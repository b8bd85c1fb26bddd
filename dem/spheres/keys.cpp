#include "dem/spheres/keys.hpp"

#include "dem/scene/size_rows.hpp"

namespace isostat {
namespace {

constexpr SceneCondition is_hertz{[](const Scene& s) { return s.sphere_law.normal == NormalForce::hertz; },
                                  "law.normal is \"hertz\""};
constexpr SceneCondition is_linear{[](const Scene& s) { return s.sphere_law.normal == NormalForce::linear; },
                                   "law.normal is \"linear\""};
constexpr SceneCondition has_linear_friction{
    [](const Scene& s) { return is_linear.holds(s) && s.sphere_law.friction > 0; },
    "law.normal is \"linear\" and law.friction > 0"};
constexpr SceneCondition has_friction{[](const Scene& s) { return s.sphere_law.friction > 0; }, "law.friction > 0"};
constexpr SceneCondition has_rolling{[](const Scene& s) { return s.sphere_law.rolling; }, "law.rolling = true"};
constexpr SceneCondition has_attraction{[](const Scene& s) { return s.sphere_law.attraction > 0; },
                                        "law.attraction > 0"};

bool arranged(const Scene& s, SphereArrangement a) {
  return s.sphere_grains.file.empty() && s.sphere_grains.arrangement == a;
}
bool is_soft(const Scene& s) {
  return arranged(s, SphereArrangement::soft_wall) || arranged(s, SphereArrangement::soft_pair);
}
constexpr SceneCondition is_random{[](const Scene& s) { return arranged(s, SphereArrangement::random); },
                                   "grains.arrangement is \"random\""};
constexpr SceneCondition in_box{[](const Scene& s) { return arranged(s, SphereArrangement::insertion); },
                                "grains.arrangement is \"insertion\""};
constexpr SceneCondition in_shell{[](const Scene& s) { return is_soft(s); }, "grains.arrangement is a soft-particle's"};
constexpr SceneCondition is_inserted{[](const Scene& s) { return in_box.holds(s) || is_soft(s); },
                                     "grains.arrangement is not \"random\""};

constexpr SceneCondition has_second{
    [](const Scene& s) { return s.sphere_grains.second_share > 0 || !s.sphere_grains.file.empty(); },
    "grains.second_share > 0, or with grains.file"};
constexpr SceneCondition has_soft{
    [](const Scene& s) { return s.sphere_grains.soft_share > 0 || !s.sphere_grains.file.empty(); },
    "grains.soft_share > 0, or with grains.file"};

std::vector<SceneKey> grain_keys() {
  using S = Scene;
  using G = SphereGrainsScene;
  using namespace key_rows;
  return {
      {.name = "grains.arrangement",
       .field = in<&S::sphere_grains, &G::arrangement>,
       .choices = names(kSphereArrangementNames),
       .condition = random_start,
       .meaning = "Where the spheres begin: random, a given number of them in a periodic cell; insertion, as many as "
                  "hierarchical insertion (docs/spheres.md) puts into a periodic cube; soft-particle-wall and "
                  "soft-particle-pair, the same in a rigid shell that touches a wall, or another such particle, below "
                  "it."},
      {.name = "grains.edge",
       .field = in<&S::sphere_grains, &G::edge>,
       .unit = "a",
       .range = positive,
       .condition = in_box,
       .meaning = "Edge of the cube."},
      {.name = "grains.shell_radius",
       .field = in<&S::sphere_grains, &G::shell_radius>,
       .unit = "a",
       .range = positive,
       .condition = in_shell,
       .meaning = "R_s, radius of the shell."},
      {.name = "grains.volume_factor",
       .field = in<&S::sphere_grains, &G::volume_factor>,
       .range = positive,
       .condition = is_inserted,
       .meaning =
           "beta: volume of the grains that are listed over that of the room; at least 1, but with soft-particles "
           "it may be what is to be there, for of more the large grains leave them no room."},
      {.name = "grains.trials",
       .field = in<&S::sphere_grains, &G::trials>,
       .range = from(1, 1e15),
       .condition = is_inserted,
       .meaning = "I: random points that each listed grain is tried at."},
      {.name = "grains.inserted_fraction",
       .field = in<&S::sphere_grains, &G::inserted_fraction>,
       .range = {0, 1, true, true},
       .absent = "as grains.trials gives",
       .condition = is_inserted,
       .meaning =
           "Solid fraction of the room that insertion is to reach, by the choice of the number of trials in place "
           "of grains.trials."},
      {.name = "grains.count",
       .field = in<&S::sphere_grains, &G::count>,
       .range = from(1, 1e9),
       .condition = is_random,
       .meaning = "Number N of spheres."},
      {.name = "grains.solid_fraction",
       .field = in<&S::sphere_grains, &G::solid_fraction>,
       .range = {0, 1, true, true},
       .condition = is_random,
       .meaning = "Solid fraction Phi_I of the initial state. Up to 0.36 the spheres are placed at random without "
                  "overlap (equal ones saturate at 0.38); beyond it they are pushed apart until none overlaps, which "
                  "succeeds below the density at which they jam, about 0.64."},
      {.name = "grains.density",
       .field = in<&S::sphere_grains, &G::density>,
       .unit = "m/a^3",
       .range = positive,
       .meaning = "Mass per volume; by default a sphere of diameter a has the mass m."},
      {.name = "grains.second_share",
       .field = in<&S::sphere_grains, &G::second_share>,
       .range = from(0, 1),
       .condition = random_start,
       .meaning = "Share of the grains, by number, that are of a second material, drawn at random."},
      {.name = "grains.second_density",
       .field = in<&S::sphere_grains, &G::second_density>,
       .unit = "m/a^3",
       .range = positive,
       .absent = "grains.density",
       .condition = has_second,
       .meaning = "Mass per volume of the second material."},
      {.name = "grains.soft_share",
       .field = in<&S::sphere_grains, &G::soft_share>,
       .range = {0, 1, false, true},
       .condition = random_start,
       .meaning = "Share of the volume (by insertion, of the listed volume) that belongs to soft-particles beside the "
                  "grains, single bodies that stand for packings of smaller grains (docs/spheres.md). 0: none."},
      {.name = "grains.soft_radius",
       .field = in<&S::sphere_grains, &G::soft_radius>,
       .unit = "a",
       .range = not_negative,
       .condition = has_soft,
       .meaning = "R_s, radius of the soft-particles."},
      {.name = "grains.soft_density",
       .field = in<&S::sphere_grains, &G::soft_density>,
       .unit = "m/a^3",
       .range = positive,
       .absent = "0.7 grains.density",
       .condition = has_soft,
       .meaning = "Mass of what a soft-particle holds over the volume of its shell."},
  };
}

std::vector<SceneKey> law_keys() {
  using S = Scene;
  using L = SphereLawScene;
  using namespace key_rows;
  return {
      {.name = "law.normal",
       .field = in<&S::sphere_law, &L::normal>,
       .choices = names(kNormalForceNames),
       .meaning = "Elastic repulsion of a contact: hertz, 4/3 E* sqrt(R*) d^(3/2) of the overlap d, with the "
                  "incremental tangential stiffness 8 G* sqrt(R* d) of Mindlin and Tsuji; or linear, K_N d and K_T."},
      {.name = "law.modulus",
       .field = in<&S::sphere_law, &L::modulus>,
       .unit = "F0/a^2",
       .range = positive,
       .condition = is_hertz,
       .meaning = "Young's modulus E of the grains."},
      {.name = "law.poisson",
       .field = in<&S::sphere_law, &L::poisson>,
       .range = {-1, 0.5, true, false},
       .condition = is_hertz,
       .meaning = "Poisson's ratio nu."},
      {.name = "law.second_modulus",
       .field = in<&S::sphere_law, &L::second_modulus>,
       .unit = "F0/a^2",
       .range = positive,
       .absent = "law.modulus",
       .condition = has_second,
       .meaning = "Young's modulus of the second material."},
      {.name = "law.second_poisson",
       .field = in<&S::sphere_law, &L::second_poisson>,
       .range = {-1, 0.5, true, false},
       .absent = "law.poisson",
       .condition = has_second,
       .meaning = "Poisson's ratio of the second material."},
      {.name = "law.wall_modulus",
       .field = in<&S::sphere_law, &L::wall_modulus>,
       .unit = "F0/a^2",
       .range = positive,
       .absent = "law.modulus",
       .condition = is_hertz,
       .meaning = "Young's modulus of walls and shells."},
      {.name = "law.wall_poisson",
       .field = in<&S::sphere_law, &L::wall_poisson>,
       .range = {-1, 0.5, true, false},
       .absent = "law.poisson",
       .condition = is_hertz,
       .meaning = "Poisson's ratio of walls and shells."},
      {.name = "law.wall_friction",
       .field = in<&S::sphere_law, &L::wall_friction>,
       .range = not_negative,
       .absent = "law.friction",
       .meaning = "Coulomb friction at walls and shells."},
      {.name = "law.soft_solid",
       .field = in<&S::sphere_law, &L::soft_solid>,
       .condition = has_soft,
       .meaning =
           "Contact of a soft-particle with a grain or a wall, six numbers: force, exponent, offset, tangential, "
           "tangential exponent, friction. With x = d/R_s of the overlap d the repulsion is "
           "E R_s^2 max(0, force x^exponent + offset), k_T is E R_s tangential (x^e - delta^e) beyond the "
           "threshold delta. `isostat lab soft-laws` measures them."},
      {.name = "law.soft_soft",
       .field = in<&S::sphere_law, &L::soft_soft>,
       .condition = has_soft,
       .meaning = "The same of two soft-particles."},
      {.name = "law.soft_curvature",
       .field = in<&S::sphere_law, &L::soft_curvature>,
       .range = not_negative,
       .condition = has_soft,
       .meaning =
           "q: against a grain of radius R a soft-particle has (R/(R + R_s))^q times the force it has at a wall."},
      {.name = "law.normal_stiffness",
       .field = in<&S::sphere_law, &L::normal_stiffness>,
       .unit = "F0/a",
       .range = positive,
       .condition = is_linear,
       .meaning = "K_N of the contacts."},
      {.name = "law.tangential_stiffness",
       .field = in<&S::sphere_law, &L::tangential_stiffness>,
       .unit = "F0/a",
       .range = positive,
       .absent = "law.normal_stiffness",
       .condition = has_linear_friction,
       .meaning = "K_T of the contacts."},
      {.name = "law.damping",
       .field = in<&S::sphere_law, &L::damping>,
       .range = from(0, 1),
       .meaning =
           "zeta, the normal viscous damping as a fraction of the critical damping 2 sqrt(m k_n) of each pair at "
           "the stiffness of its overlap (Tsuji 1992); in contact only."},
      {.name = "law.tangential_damping",
       .field = in<&S::sphere_law, &L::tangential_damping>,
       .range = not_negative,
       .condition = has_friction,
       .meaning = "Tangential viscous damping over the normal one; with the spring it obeys the Coulomb limit."},
      {.name = "law.friction",
       .field = in<&S::sphere_law, &L::friction>,
       .range = not_negative,
       .meaning =
           "mu, Coulomb friction; its limit acts on the elastic repulsion alone. 0: frictionless, no rotations."},
      {.name = "law.rolling", .field = in<&S::sphere_law, &L::rolling>, .meaning = "Rolling resistance on or off."},
      {.name = "law.rolling_friction",
       .field = in<&S::sphere_law, &L::rolling_friction>,
       .unit = "a",
       .range = not_negative,
       .absent = "0.01 law.friction",
       .condition = has_rolling,
       .meaning = "mu_r: the rolling and twisting moment is at most mu_r times the elastic repulsion."},
      {.name = "law.rolling_stiffness",
       .field = in<&S::sphere_law, &L::rolling_stiffness>,
       .unit = "F0 a",
       .range = positive,
       .absent = "1e-4 law.normal_stiffness (hertz: 1e-4 law.modulus)",
       .condition = has_rolling,
       .meaning = "K_r of the rolling springs."},
      {.name = "law.attraction",
       .field = in<&S::sphere_law, &L::attraction>,
       .unit = "F0",
       .range = not_negative,
       .meaning = "Attractive force F0 of a contact (Gilabert 2007, Eq. 4); 0: no cohesion."},
      {.name = "law.attraction_range",
       .field = in<&S::sphere_law, &L::attraction_range>,
       .unit = "a",
       .range = positive,
       .condition = has_attraction,
       .meaning = "D0: the attraction falls linearly to zero at this gap."},
      {.name = "step.fraction",
       .field = in<&S::step, &StepScene::fraction>,
       .range = from(kLeastStepFraction, kInfinity),
       .absent = "0.1, or half the bound if that is less",
       .meaning = "c of the time step dt = c sqrt(m / k) of the smallest grain, k the normal stiffness of its contact "
                  "with another as small; Hertz: at an overlap of a tenth of its radius. Beyond the stability bound it "
                  "is refused."},
  };
}

std::vector<SceneKey> stage_keys() {
  using S = Scene;
  using namespace key_rows;
  return {
      {.name = "stage.stress_3",
       .field = in<&S::stages, &StageScene::stress_3>,
       .unit = "F0/a^2",
       .absent = "as stage.pressure says",
       .meaning = "Stress imposed along direction 3, as stage.stress_1."},
      {.name = "stage.strain_rate_3",
       .field = in<&S::stages, &StageScene::strain_rate_3>,
       .unit = "1/T0",
       .absent = "none imposed",
       .meaning = "Strain rate imposed along direction 3, as stage.strain_rate_1."},
      {.name = "stage.velocity",
       .field = in<&S::stages, &StageScene::velocity>,
       .unit = "V*",
       .range = not_negative,
       .meaning =
           "Root mean square velocity drawn at the start of the stage, V* = sqrt(F0 D0 / m), without cohesion "
           "a sqrt(a P / m) with P of the first stage that imposes a stress, or a/T0 if none does; 0: velocities are "
           "kept."},
      {.name = "stage.velocity_of",
       .field = in<&S::stages, &StageScene::velocity_of>,
       .choices = names(kVelocityOfNames),
       .meaning =
           "Whose root mean square stage.velocity is: that of the velocity vector, or of each of its "
           "components (the standard deviation of a Maxwell distribution), by the root of the dimension faster."},
      {.name = "stage.stop",
       .field = in<&S::stages, &StageScene::stop>,
       .meaning = "All velocities and spins, of walls too, are set to zero when the stage begins: the stops of the "
                  "soft-particles' protocol."},
      {.name = "stage.approach",
       .field = in<&S::stages, &StageScene::approach>,
       .unit = "a/T0",
       .condition = in_shell,
       .meaning =
           "Speed of the first soft-particle, shell and grains, towards its partner during this stage; negative: "
           "away from it."},
      {.name = "stage.friction",
       .field = in<&S::stages, &StageScene::friction>,
       .range = not_negative,
       .absent = "it stays",
       .meaning = "mu from this stage on, in place of law.friction: frictionless to the isostatic state, then "
                  "frictional."},
  };
}

}  // namespace

std::vector<SceneKey> sphere_keys() {
  using namespace key_rows;
  std::vector<SceneKey> rows;
  for (const auto& part :
       {grain_keys(), size_rows<&Scene::sphere_grains, random_start.holds>(random_start.in_words, "Largest diameter."),
        file_rows<&Scene::sphere_grains, &SphereGrainsScene::file, &SphereGrainsScene::box>(), law_keys(),
        stage_keys()})
    rows.insert(rows.end(), part.begin(), part.end());
  return of(SceneSystem::spheres, std::move(rows));
}

}  // namespace isostat
