// Packings of grains and soft-particles in three resolutions.
#include "dem/spheres/lab/soft_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dem/spheres/lab/soft_particle.hpp"

namespace isostat {
namespace {

SoftPackingTest small() {
  const SoftParticleTest particle = soft_particle_defaults(SoftPartner::wall, SoftProtocol::fire);
  SoftPackingTest t;
  t.law = particle.law;
  t.law.soft_solid = {0.48, 2.6, -7e-4, 0.47, 2.46, 0.17}, t.law.soft_soft = {0.17, 4.3, -8e-5, 0.73, 4.9, 0.42};
  t.law.soft_curvature = 1.3;
  t.inside = particle.insertion;
  t.inside.radius_min = 0.4 * t.inside.radius_max, t.inside.trials = 1000;
  t.packing = t.inside;
  t.packing.room = InsertionRoom::box;
  t.packing.radius_min = t.inside.radius_max, t.packing.radius_max = 2.5 * t.inside.radius_max;
  t.packing.soft_radius = t.inside.shell_radius, t.packing.soft_share = 0.4;
  t.packing.volume_factor = 0.55, t.packing.trials = 1e5;
  t.packing.box.fill(6 * t.packing.radius_max);
  t.strain = {0.06, 0.12};
  t.increment = 0.01, t.most_iterations = 400;
  return t;
}

TEST(SoftPacking, IsOnePackingAtEachResolution) {
  const SoftPackingTest t = small();
  const SoftPackingRun model = compress_soft_packing(t, SoftResolution::model, 1),
                       shells = compress_soft_packing(t, SoftResolution::shells, 1),
                       free = compress_soft_packing(t, SoftResolution::free, 1);
  EXPECT_GT(model.solids, 10u);
  EXPECT_GT(model.softs, 5u);
  EXPECT_EQ(model.bodies, model.solids + model.softs);
  for (const SoftPackingRun* r : {&shells, &free}) {
    EXPECT_EQ(r->solids, model.solids);
    EXPECT_EQ(r->softs, model.softs);
    EXPECT_DOUBLE_EQ(r->solid_fraction, model.solid_fraction);
  }
  EXPECT_EQ(shells.bodies, free.bodies + free.softs);
  EXPECT_GT(free.bodies, model.solids + 5 * model.softs);
  // Pressed further it bears more, and the load on the grains is of the order of the pressure.
  for (const SoftPackingRun* r : {&model, &shells}) {
    ASSERT_EQ(r->points.size(), 2u);
    EXPECT_GT(r->points[1].pressure, r->points[0].pressure);
    double load = 0;
    for (const double l : r->points[1].solid_load) load += l / static_cast<double>(r->solids);
    EXPECT_GT(load, 0.2 * r->points[1].pressure);
    EXPECT_LT(load, 20 * r->points[1].pressure);
  }
  EXPECT_LT(free.points[1].pressure, shells.points[1].pressure);  // grains that may leave bear less
}

TEST(SoftPacking, IsAPureFunctionOfItsSeed) {
  const SoftPackingTest t = small();
  for (const SoftResolution r : {SoftResolution::model, SoftResolution::shells}) {
    const SoftPackingRun a = compress_soft_packing(t, r, 2), b = compress_soft_packing(t, r, 2);
    EXPECT_EQ(a.points[1].pressure, b.points[1].pressure);
    EXPECT_EQ(a.points[1].solid_load, b.points[1].solid_load);
    EXPECT_EQ(a.steps, b.steps);
  }
}

}  // namespace
}  // namespace isostat
