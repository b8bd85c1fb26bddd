// A cell of spheres that shears: the step loop against the obvious solver, which never lowers its tilt; stages that
// drive or load it, restarts, what is refused, and the tilt in every format.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/packing_header.hpp"
#include "dem/files/formats/xyz.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/physical_hash.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/spheres/series.hpp"
#include "dem/spheres/vtp.hpp"
#include "dem/state/link_ends.hpp"
#include "tests/oracle/sphere_solver.hpp"
#include "tests/support/shear_restart.hpp"
#include "tests/support/sphere_states.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/vtk_array.hpp"

namespace isostat {
namespace {

using oracle::RandomSpheres;
using oracle::SphereSolver;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Largest differences over the spheres, positions by their nearest image.
struct Difference {
  double position = 0, velocity = 0, spin = 0;
};
Difference difference(const State<Spheres>& s, const SphereSolver& reference) {
  Difference d;
  const Bodies<3>& b = s.packing.bodies;
  const double half = 0.5 * s.time_step;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const oracle::SphereMoment& r = reference.sphere(b.id[k]);
    Vec3 apart = b.position[k] - r.r;
    apart += s.packing.cell->offset(s.packing.cell->nearest_image(apart));
    d.position = std::max(d.position, norm(apart));
    d.velocity = std::max(d.velocity, norm(b.velocity[k] - r.half_velocity - (half / r.mass) * r.force));
    d.spin = std::max(d.spin, norm(b.spin[k] - r.half_spin - (half / r.inertia) * r.torque));
  }
  return d;
}

double total_spring(const State<Spheres>& s) {
  double sum = 0;
  for (const Link<3>& l : s.packing.links) sum += norm(l.tangential_force);
  return sum;
}

struct Case {
  const char* name;
  RandomSpheres spheres;
  std::optional<double> stress_1, stress_2, stress_3, stress_12;
  double shear_rate = 0;
  bool rate_coupling = false;
  double drag = 0;
  int remaps = 0;  // at least
};

RandomSpheres with(SphereLaw law, std::uint64_t seed) {
  RandomSpheres r;
  r.law = law, r.seed = seed, r.count = 48, r.room = 0.55, r.time_step = 5e-4;
  return r;
}
SphereLaw frictionless(SphereLaw law) {
  law.friction = law.wall_friction = law.rolling_friction = law.rolling_stiffness = 0;
  return law;
}
SphereLaw no_cohesion(SphereLaw law) {
  law.attraction = law.attraction_range = 0;
  return law;
}

// The cell turns back several times here: that changes nothing.
TEST(ShearedSpheres, MarchLikeTheReferenceSolver) {
  const SphereLaw hertz = oracle::soft_sphere_law(NormalForce::hertz),
                  linear = oracle::soft_sphere_law(NormalForce::linear);
  RandomSpheres polydisperse = with(hertz, 5);
  polydisperse.radius_min = 0.06, polydisperse.count = 90, polydisperse.room = 0.3, polydisperse.time_step = 1e-4;
  const double none = 0;
  const std::optional<double> keep;
  for (const Case& c : {Case{"constant volume", with(hertz, 1), keep, keep, keep, keep, 12, false, none, 3},
                        Case{"constant normal stress", with(linear, 2), keep, 20, keep, keep, -12, false, none, 3},
                        Case{"edges free", with(no_cohesion(hertz), 3), 20, 30, 25, keep, 12, false, none, 3},
                        Case{"shear stress alone", with(frictionless(linear), 4), keep, keep, keep, -40},
                        Case{"all stresses", with(no_cohesion(linear), 5), 20, 30, 25, 15},
                        Case{"coupling and drag", with(hertz, 6), 20, 30, 25, keep, 12, true, 0.5, 3},
                        Case{"size ratio 8", polydisperse, keep, 10, keep, keep, 40, false, none, 2}}) {
    SCOPED_TRACE(c.name);
    State<Spheres> s = random_state(c.spheres);
    CellControl<3> control;
    control.stress[0] = c.stress_1, control.stress[1] = c.stress_2, control.stress[2] = c.stress_3;
    control.stress.shear = c.stress_12, control.shear_rate = c.shear_rate;
    control.max_strain_rate = 2, control.inertia = 0.3 * oracle::total_mass(s);
    control.rate_coupling = c.rate_coupling;
    SphereSolver reference(s, control);
    Solver solver(s, control);
    solver.set_drag(c.drag), reference.set_drag(c.drag);
    int lowered = 0;
    double springs = 0;
    for (int k = 0; k < 600; ++k) {
      const double before = solver.cell()->tilt;
      solver.step(), reference.step();
      lowered += std::abs(solver.cell()->tilt - before) > 0.5 * solver.cell()->length[0];
      ASSERT_LE(std::abs(solver.cell()->tilt), 0.5 * solver.cell()->length[0]);
      springs = std::max(springs, reference.total_spring());
    }
    solver.snapshot(s);
    const PeriodicCell<3>& cell = *s.packing.cell;
    EXPECT_GE(lowered, c.remaps);
    EXPECT_NEAR(cell.tilt, reference.tilt() - std::lround(reference.tilt() / cell.length[0]) * cell.length[0], 1e-7);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(cell.length[a], reference.length()[a], 1e-7);
      EXPECT_NEAR(s.cell_motion.stress[a], reference.stress()[a], 1e-3);
    }
    EXPECT_NEAR(s.cell_motion.shear_strain_rate, reference.shear_strain_rate(), 1e-6);
    EXPECT_NEAR(s.cell_motion.shear_stress, reference.shear_stress(), 1e-3);
    const Difference d = difference(s, reference);
    EXPECT_LT(d.position, 1e-6);
    EXPECT_LT(d.velocity, 1e-4);
    EXPECT_LT(d.spin, 1e-3);
    EXPECT_GT(reference.contacts(), 10u);
    EXPECT_NEAR(total_spring(s), reference.total_spring(), 1e-4 * (1 + springs));
    EXPECT_EQ(springs > 1, c.spheres.law.friction > 0);
    EXPECT_GT(solver.engine().lists().inner_rebuilds(), 2u);
  }
}

// Every pair that interacts is in the lists of a leaning cell: links as from all pairs and images, of sizes alike and
// of very many.
TEST(ShearedSpheres, ListsMissNoPair) {
  for (const double smallest : {0.25, 0.05}) {
    RandomSpheres r;
    r.count = 200, r.radius_min = smallest, r.room = 0.3, r.speed = 3, r.time_step = 2e-4;
    State<Spheres> s = random_state(r);
    CellControl<3> control;
    control.shear_rate = 8, control.strain_rate = {{0.5, -0.5, 0.3}};
    Solver solver(s, control, {});
    double leaned = 0;
    for (int look = 0; look < 12; ++look) {
      solver.run(60);
      solver.snapshot(s);
      const Bodies<3>& b = s.packing.bodies;
      const PeriodicCell<3>& cell = *s.packing.cell;
      leaned = std::max(leaned, std::abs(cell.tilt) / cell.length[0]);
      std::size_t interacting = 0;
      for (std::size_t i = 0; i < b.size(); ++i)
        for (std::size_t j = i + 1; j < b.size(); ++j)
          for (int code = 0; code < 125; ++code) {
            const ImageShift<3> shift{code % 5 - 2, code / 5 % 5 - 2, code / 25 - 2};
            const Vec3 d = b.position[j] + cell.offset(shift) - b.position[i];
            interacting += norm(d) - b.radius[i] - b.radius[j] < s.law.attraction_range;
          }
      EXPECT_EQ(s.packing.links.size(), interacting);
    }
    EXPECT_GT(leaned, 0.3);
  }
}

// The step in which the tilt is lowered is like any other: nothing jumps, springs included.
TEST(ShearedSpheres, TurnBackWithoutAnyoneNoticing) {
  RandomSpheres r;
  r.law.friction = 5, r.law.rolling_friction = 1, r.speed = 0.1, r.room = 0.4, r.time_step = 5e-4;
  State<Spheres> s = random_state(r);
  CellControl<3> control;
  control.shear_rate = 2;
  Solver solver(s, control);
  const auto sums = [&] {  // of |N|, |T|, |M|, and the number of links
    solver.snapshot(s);
    std::array<double, 4> sum{};
    for (const Link<3>& l : s.packing.links) {
      sum[0] += std::abs(l.normal_force), sum[1] += norm(l.tangential_force), sum[2] += norm(l.moment);
      sum[3] += 1;
    }
    return sum;
  };
  int turned = 0;
  std::array<double, 4> before = sums(), usual{};
  for (int k = 0; k < 700; ++k) {
    const double tilt = solver.cell()->tilt;
    solver.step();
    const auto now = sums();
    const bool turns = std::abs(solver.cell()->tilt - tilt) > 0.5 * solver.cell()->length[0];
    for (std::size_t n = 0; n < now.size(); ++n) {
      const double jump = std::abs(now[n] - before[n]);
      if (turns)
        EXPECT_LE(jump, 1.5 * usual[n] + 1e-12) << n;
      else if (k > 50)  // springs grow from nothing at first
        usual[n] = std::max(usual[n], jump);
    }
    turned += turns;
    before = now;
  }
  EXPECT_GE(turned, 1);
  EXPECT_GT(before[1], 1) << "there were springs to lose";
  EXPECT_LT(usual[1], 0.5 * before[1]) << "and a loss would show";
}

const std::string kScene =
    "system = \"spheres\"\nseed = 3\n[grains]\ncount = 60\nsolid_fraction = 0.5\ndiameter_min = 0.7\n"
    "[law]\nnormal = \"linear\"\nnormal_stiffness = 1e3\ntangential_stiffness = 7e2\nfriction = 0.4\ndamping = 0.5\n"
    "[cell]\ninertia = 1.0\n[finish]\nmethod = \"drag\"\ndrag = 1.0\n";

State<Spheres> packed(const std::string& stages) {
  const Scene scene = parse_scene(kScene + stages, "scene.toml", {});
  State<Spheres> s = initial_spheres(scene, scene.seed);
  const RunOutcome outcome = run_stages(s, {}, {});
  EXPECT_TRUE(outcome.all_met()) << s.progress.unmet;
  return s;
}

TEST(SphereShearStages, AnIsotropicPackingIsFreeOfShearStressIfItIsAskedFor) {
  const State<Spheres> fixed = packed("[[stage]]\npressure = 0.5\n"),
                       freed = packed("[[stage]]\npressure = 0.5\nstress_12 = 0.0\n");
  EXPECT_GT(std::abs(measured_stress(fixed.packing)[0][1]), 1e-3) << "chance leaves it somewhere";
  EXPECT_EQ(fixed.packing.cell->tilt, 0);
  const StressTensor3 stress = measured_stress(freed.packing);
  EXPECT_NE(freed.packing.cell->tilt, 0);
  EXPECT_LT(std::abs(stress[0][1]), 1e-4 * freed.certificate.force_scale);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(stress[static_cast<std::size_t>(a)][a], 0.5, 1e-4);
  EXPECT_TRUE(freed.certificate.equilibrated);
  ImposedStress<3> imposed = freed.imposed_stress;  // the certificate judges it
  imposed.shear = 0.1;
  const Certificate other = evaluate_certificate(freed.packing, freed.law, imposed, freed.scene.equilibrium);
  EXPECT_NEAR(other.pressure_error * other.force_scale, 0.1, 2e-4);
  EXPECT_FALSE(other.equilibrated);
  imposed = {}, imposed.shear = 2;
  EXPECT_EQ(force_scale(freed.law, imposed), 2);
}

TEST(SphereShearStages, SimpleShearGoesToItsStrainUnderItsNormalStress) {
  const std::string packing = "[[stage]]\npressure = 0.5\n";
  State<Spheres> s = packed(packing +
                            "[[stage]]\nshear_rate = 0.05\nstress_2 = 0.5\nstrain_rate_1 = 0\nstrain_rate_3 = 0\n"
                            "until = \"strain\"\nstrain = 1.2\n");
  EXPECT_GE(s.cell_motion.shear_strain, 1.2);
  EXPECT_LT(s.cell_motion.shear_strain, 1.25) << "at the next look";
  for (const int a : {0, 2}) EXPECT_EQ(s.packing.cell->length[a], s.cell_motion.reference_length[a]);
  EXPECT_LE(std::abs(s.packing.cell->tilt), 0.5 * s.packing.cell->length[0]);
  EXPECT_NE(s.packing.cell->length[1], s.cell_motion.reference_length[1]);
  EXPECT_LT(measured_stress(s.packing)[0][1], -0.01) << "it resists";
  EXPECT_NEAR(-s.cell_motion.shear_strain_rate * s.cell_motion.reference_length[1] / s.packing.cell->length[1], 0.05,
              1e-5);
  const State<Spheres> kept = packed(packing + "[[stage]]\nshear_rate = -0.05\nuntil = \"strain\"\nstrain = 0.3\n");
  EXPECT_EQ(kept.packing.cell->length, kept.cell_motion.reference_length);
  EXPECT_LT(kept.packing.cell->tilt, 0);
  EXPECT_GT(measured_stress(kept.packing)[0][1], 0);
  std::string header;
  for (const SeriesColumn& c : series_columns(kept, false)) header += std::string(c.name) + ",";
  EXPECT_THAT(header, HasSubstr("imposed33,imposed12,tilt,shear_strain,shear_rate,inertial_number,"));
  const State<Spheres> failed =
      packed(packing + "[[stage]]\nshear_rate = 0.05\nstress_2 = 0.5\nuntil = \"failure\"\ndrop = 0.2\n");
  EXPECT_LT(failed.progress.carried_stress, 0.8 * failed.progress.peak_stress);
}

// The mean velocity of the grains is the affine one: the peculiar part has no profile.
TEST(SphereShearStages, TheVelocityProfileIsAffine) {
  const State<Spheres> start = packed(
      "[[stage]]\npressure = 0.5\n[[stage]]\nshear_rate = 0.1\nstress_2 = 0.5\nuntil = \"strain\"\nstrain = 0.5\n");
  CellControl<3> control;
  control.shear_rate = 0.1, control.stress[1] = 0.5, control.inertia = 60;
  State<Spheres> s = start;
  Solver solver(s, control);
  const double rate = 0.1;
  std::vector<Vec3> before(s.packing.bodies.size());
  std::array<double, 4> moved{};  // along x, unwrapped, by quarters of the height at the start of an interval
  std::array<double, 4> expected{};
  constexpr int kLooks = 200, kSteps = 200;
  for (int look = 0; look < kLooks; ++look) {
    solver.run(kSteps);
    solver.snapshot(s);
    const Bodies<3>& b = s.packing.bodies;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec3 f = s.packing.cell->fractions(s.packing.cell->wrap(b.position[k]));
      const auto slab = static_cast<std::size_t>(std::min(3.0, 4 * f[1]));
      const double height = f[1] * s.packing.cell->length[1];
      moved[slab] += b.velocity[k][0] + rate * height, expected[slab] += rate * height;
    }
  }
  const double top = expected[3];
  for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(moved[n] / top, expected[n] / top, 0.05) << n;
  EXPECT_GT(expected[3], 5 * expected[0]);
}

// Through a state file amid the shear, after the cell has turned back once.
TEST(SphereShearStages, RestartAsIfTheyHadRunStraight) {
  const Scene scene = parse_scene(kScene + kShearedAndReleased, "scene.toml", {});
  expect_restarts_as_straight(initial_spheres(scene, scene.seed));
}

std::string faults(const std::string& text) {
  try {
    parse_scene(text, "scene.toml", {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SphereShearKeys, ContradictionsAreNamed) {
  EXPECT_THAT(faults(kScene + "[[stage]]\nstress_12 = 0.1\nshear_rate = 0.1\n"),
              AllOf(HasSubstr("stage.0.shear_rate"), HasSubstr("0.1"),
                    HasSubstr("a direction has an imposed stress or a strain rate, not both")));
  EXPECT_THAT(faults(kScene + "[[stage]]\nshear_rate = 0.1\n"),
              AllOf(HasSubstr("stage.0.until"), HasSubstr("a driven cell never comes to rest")));
  EXPECT_THAT(faults(kScene + "[[stage]]\nstress_12 = 500.0\nuntil = \"time\"\ntime = 1.0\n"),
              AllOf(HasSubstr("law.normal_stiffness"), HasSubstr("too soft")));
  EXPECT_EQ(faults(kScene + "[[stage]]\nshear_rate = 0.1\nuntil = \"failure\"\n"), "");
  EXPECT_EQ(faults(kScene + "[[stage]]\npressure = 1.0\nshear_rate = 0.0\n"), "");
}

TEST(SphereShearKeys, ACellWithWallsInItDoesNotShear) {
  RandomSpheres r;
  State<Spheres> s = random_state(r);
  SphereWall floor;
  floor.normal = {{0, 0, 1}};
  s.packing.walls = {floor};
  CellControl<3> control;
  control.shear_rate = 1;
  EXPECT_THROW(Solver(s, control), InputError);
}

State<Spheres> tilted_state() {
  RandomSpheres r;
  r.room = 0.45;
  State<Spheres> s = random_state(r);
  CellControl<3> control;
  control.shear_rate = 3;
  Solver solver(s, control);
  solver.run(120);
  solver.snapshot(s);
  s.scene.system = SceneSystem::spheres;
  return s;
}

void expect_same(const Packing<3>& a, const Packing<3>& b) {
  ASSERT_TRUE(b.cell);
  EXPECT_EQ(a.cell->length, b.cell->length);
  EXPECT_EQ(a.cell->tilt, b.cell->tilt);
  EXPECT_EQ(a.bodies.position, b.bodies.position);
}

TEST(SphereTiltInFiles, ComesBackFromEveryFormat) {
  const State<Spheres> s = tilted_state();
  ASSERT_GT(s.packing.cell->tilt, 0.5);
  ASSERT_GT(s.packing.links.size(), 60u);
  const TemporaryFolder folder;
  write_network(folder / "p.net", static_cast<const Packing<3>&>(s.packing));
  const PackingFile network = read_packing(folder / "p.net");
  ASSERT_TRUE(network.packing_3d);
  expect_same(s.packing, *network.packing_3d);
  ASSERT_EQ(network.packing_3d->links.size(), s.packing.links.size());
  for (std::size_t l = 0; l < s.packing.links.size(); ++l)
    EXPECT_NEAR(network.packing_3d->links[l].gap, s.packing.links[l].gap, 1e-14);
  write_files_atomically({{folder / "p.dump", grains_dump<3>(s.packing, 7)}});
  const PackingFile dump = read_packing(folder / "p.dump");
  ASSERT_TRUE(dump.packing_3d);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(dump.packing_3d->cell->length[a], s.packing.cell->length[a], 1e-13);
  EXPECT_EQ(dump.packing_3d->cell->tilt, s.packing.cell->tilt);
  write_files_atomically({{folder / "p.grains.csv", grains_csv<3>(s.packing)},
                          {folder / "p.contacts.csv", contacts_csv<3>(s.packing)},
                          {folder / "p.csv.toml", header_text(s)}});
  const PackingFile csv = read_packing(folder / "p.csv");
  ASSERT_TRUE(csv.spheres);
  expect_same(s.packing, csv.spheres->packing);
  EXPECT_EQ(csv.spheres->cell_motion.shear_strain_rate, s.cell_motion.shear_strain_rate);
  write_state(s, folder / "p.h5");
  const State<Spheres> back = read_state<Spheres>(folder / "p.h5");
  expect_same(s.packing, back.packing);
  EXPECT_EQ(encode_state(back), encode_state(s));
  const std::string xyz = extended_xyz<3>(s.packing, 0), lattice = xyz.substr(xyz.find("Lattice"), 200);
  EXPECT_THAT(lattice, HasSubstr("Lattice=\""));
  EXPECT_NE(xyz.find("pbc=\"T T T\""), std::string::npos);
  double edges[9];
  ASSERT_EQ(std::sscanf(lattice.c_str(), "Lattice=\"%lf %lf %lf %lf %lf %lf %lf %lf %lf", edges, edges + 1, edges + 2,
                        edges + 3, edges + 4, edges + 5, edges + 6, edges + 7, edges + 8),
            9);
  EXPECT_EQ(edges[3], s.packing.cell->tilt);
  EXPECT_EQ(edges[4], s.packing.cell->length[1]);
  for (const int zero : {1, 2, 5, 6, 7}) EXPECT_EQ(edges[zero], 0);
  State<Spheres> upright = s;
  upright.packing.cell->tilt = 0, upright.cell_motion.shear_strain_rate = 0;
  EXPECT_NE(physical_hash(upright), physical_hash(s));
}

// Every line of the ParaView file is as long as its branch vector, and spheres lie in the leaning cell.
TEST(SphereTiltInFiles, ParaViewDrawsWholeLinks) {
  const State<Spheres> s = tilted_state();
  const std::string vtp = vtk_polydata(s.packing, 0);
  const auto place = oracle::vtk_array<double>(vtp, "Points");
  const auto line = oracle::vtk_array<std::int64_t>(vtp, "connectivity", "<Lines>");
  ASSERT_EQ(line.size(), 2 * s.packing.links.size());
  const auto at = [&](std::size_t end) {
    const std::size_t n = 3 * static_cast<std::size_t>(line[end]);
    return Vec3{{place[n], place[n + 1], place[n + 2]}};
  };
  for (std::size_t l = 0; l < s.packing.links.size(); ++l)
    EXPECT_LT(norm(at(2 * l + 1) - at(2 * l) - ends<3>(s.packing, s.packing.links[l]).branch), 1e-12);
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) {
    const Vec3 f = s.packing.cell->fractions({{place[3 * k], place[3 * k + 1], place[3 * k + 2]}});
    for (int a = 0; a < 3; ++a) EXPECT_TRUE(f[a] > -1e-12 && f[a] < 1);
  }
}

// A file with any tilt starts a run in the shape nearest to a rectangle.
TEST(SphereTiltInFiles, ARunBeginsWithTheLowestTilt) {
  State<Spheres> s = tilted_state();
  const double tilt = s.packing.cell->tilt;
  s.packing.cell->tilt += 3 * s.packing.cell->length[0];
  for (Link<3>& l : s.packing.links) l.shift[0] -= 3 * l.shift[1];
  const TemporaryFolder folder;
  write_network(folder / "p.net", static_cast<const Packing<3>&>(s.packing));
  Scene scene = default_scene(SceneSystem::spheres);
  scene.sphere_grains.file = folder / "p.net";
  const State<Spheres> begun = initial_spheres(scene, 1);
  EXPECT_NEAR(begun.packing.cell->tilt, tilt, 1e-12);
  ASSERT_EQ(begun.packing.links.size(), s.packing.links.size());
  for (std::size_t l = 0; l < s.packing.links.size(); ++l)
    EXPECT_NEAR(frame(ends<3>(begun.packing, begun.packing.links[l])).gap, s.packing.links[l].gap, 1e-12);
}

std::string network_faults(const std::string& text) {
  const TemporaryFolder folder;
  write_files_atomically({{folder / "p.net", text}});
  try {
    read_packing(folder / "p.net");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SphereTiltInFiles, BadTiltsAreRefused) {
  EXPECT_THAT(network_faults("tilt 1\ngrain 0 0 0 0 1\n"), AllOf(HasSubstr(":1"), HasSubstr("needs a cell line")));
  EXPECT_THAT(network_faults("cell 4 4 4\ntilt 4000\ngrain 0 0 0 0 1\n"), HasSubstr("at most 100 L1"));
  EXPECT_EQ(network_faults("cell 4 4 4\ntilt 1\ngrain 0 0 0 0 1\n"), "");
  const TemporaryFolder folder;
  write_files_atomically({{folder / "p.dump",
                           "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 4 0\n0 "
                           "4 1\n0 4 0\nITEM: ATOMS id x y z radius\n1 0 0 0 1\n"}});
  EXPECT_THROW(read_packing(folder / "p.dump"), InputError) << "xz and yz stay 0";
}

}  // namespace
}  // namespace isostat
