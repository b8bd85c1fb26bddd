// Every kernel of spheres (law x instruction set x tally x flow x images) against the reference law of
// tests/oracle/sphere_reference, on random pairs: bodies shared by several pairs, some pairs in contact and sticking,
// some sliding, some just formed, some across a gap, some out of reach, padding at the end.
#include "dem/spheres/kernel/pair_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dem/input_error.hpp"
#include "dem/solver/aligned.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/solver/random.hpp"
#include "dem/spheres/pairs.hpp"
#include "tests/oracle/sphere_reference.hpp"
#include "tests/support/machine_isas.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat::spheres {
namespace {

constexpr std::size_t kPairs = 237, kListed = 240;  // a multiple of the batch with three padding pairs
static_assert(kListed % kPairBatch == 0);
constexpr double kRounding = 4e-12;  // of the largest force; turns are left out at the third order of the step
constexpr double kStep = 2e-5;

RowOffset offset(std::size_t body) { return static_cast<RowOffset>(body * kRowWidth); }

// Pair k joins bodies 2k and 2k+1, except that every fifth pair shares its first body with the pair before.
struct Fixture {
  PairForceInput in;
  SphereStore bodies;
  SpherePairs columns;
  AlignedVector<RowOffset> i, j;
  AlignedVector<std::uint8_t> shift;
  std::vector<std::size_t> first, second;  // bodies of the pairs
  std::vector<oracle::SpherePairMoment> pairs;
  int apart = 0;

  Fixture(const SphereLaw& law, bool images, bool flows, bool shears, std::uint64_t seed) : columns(law) {
    Random random(seed);
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    const auto vector = [&](double size) {
      return Vec3{{between(-size, size), between(-size, size), between(-size, size)}};
    };
    bodies.resize(2 * kPairs);
    columns.resize(kListed);
    i.assign(kListed, offset(2 * kPairs)), j.assign(kListed, offset(2 * kPairs + 1));
    shift.assign(kListed, kNoImage<3>);
    in.law = law, in.time_step = kStep, in.images = images;
    const ContactStiffness unit = pair_stiffness(law, 1, 1);
    in.tangential_ratio = unit.tangential / unit.normal;
    if (flows) in.flow_half = {-0.3, 0.2, 0.1}, in.flow_now = {-0.31, 0.19, 0.12};
    if (shears) in.shear_half = 0.4, in.shear_now = 0.45;
    const Vec3 length{{7, 9, 8}};
    for (std::uint8_t c = 0; c < 27; ++c)
      for (std::size_t a = 0; a < 3; ++a) in.offset[a][c] = image_shift<3>(c)[a] * length.c[a];

    for (std::size_t k = 0; k < 2 * kPairs; ++k) {
      const double radius = between(0.2, 0.5), mass = 8 * radius * radius * radius;
      bodies.constants[k] = {1 / mass, 2.5 / (mass * radius * radius), radius, mass};
      bodies.place(k, {{between(0, 7), between(0, 9), between(0, 8)}});
      const Vec3 v = vector(1), w = vector(4);
      bodies.set_half_velocity(k, v), bodies.set_half_spin(k, w);
      put_triple(bodies.row(k) + Slot::velocity, v + vector(0.1));
      put_triple(bodies.row(k) + Slot::surface, radius * (w + vector(0.2)));
    }
    for (std::size_t k = 0; k < kPairs; ++k) {
      const std::size_t b = 2 * k + 1, a = k % 5 == 4 ? 2 * k - 2 : 2 * k;
      first.push_back(a), second.push_back(b);
      if (images) shift[k] = static_cast<std::uint8_t>(random.uniform() * 27);
      const ImageShift<3> s = image_shift<3>(shift[k]);
      const double sum = bodies.radius(a) + bodies.radius(b);
      Vec3 n = vector(1);
      n = (1 / norm(n)) * n;
      double gap = -0.05 * random.uniform();
      if (k % 4 == 3) gap = 0.04 * random.uniform();
      if (k % 7 == 6) gap = -(5 + 5 * random.uniform()) * 1e-6;  // formed in this step, or about to end
      const Vec3 r = (sum + gap) * n, image{{s[0] * length[0], s[1] * length[1], s[2] * length[2]}};
      bodies.place(b, bodies.position(a) + r - (images ? image : Vec3{}));
      columns.fill(k, bodies, a, b);
      i[k] = offset(a), j[k] = offset(b);

      oracle::SpherePairMoment p;
      p.r = bodies.position(b) + (images ? image : Vec3{}) - bodies.position(a);
      p.radius_i = bodies.radius(a), p.radius_j = bodies.radius(b);
      p.mass_i = bodies.constants[a].mass, p.mass_j = bodies.constants[b].mass;
      p.half_velocity = bodies.half_velocity(b) - bodies.half_velocity(a);
      p.velocity = triple_at(bodies.row(b) + Slot::velocity) - triple_at(bodies.row(a) + Slot::velocity);
      for (int c = 0; c < 3; ++c)
        p.half_velocity[c] += in.flow_half[c] * p.r[c], p.velocity[c] += in.flow_now[c] * p.r[c];
      p.half_velocity[0] += in.shear_half * p.r[1], p.velocity[0] += in.shear_now * p.r[1];
      p.half_spin_i = bodies.half_spin(a), p.half_spin_j = bodies.half_spin(b);
      p.spin_i = (1 / p.radius_i) * triple_at(bodies.row(a) + Slot::surface);
      p.spin_j = (1 / p.radius_j) * triple_at(bodies.row(b) + Slot::surface);
      p.time_step = kStep;
      // Springs normal to the normal of the step before, below or beyond the limit.
      if (gap < 0 && k % 7 != 6) {
        const Vec3 old = p.r - kStep * p.half_velocity;
        const double most = repulsion(law, pair_stiffness(law, p.radius_i, p.radius_j), gap);
        if (law.friction > 0) {
          const Vec3 t = cross(old, vector(1));
          p.tangential = (law.friction * most * (k % 3 == 0 ? 1.2 : 0.5) / norm(t)) * t;
        }
        if (law.rolling_friction > 0) p.moment = law.rolling_friction * most * vector(k % 2 == 0 ? 1.5 : 0.4);
      }
      columns.remember(k, {p.tangential, p.moment});
      p.tangential = columns.history(k).tangential_force, p.moment = columns.history(k).moment;
      pairs.push_back(p);
      apart += gap >= 0;
    }
    in.rows = bodies.rows.data(), in.spins = bodies.spins.data();
    in.loads = bodies.loads.data(), in.moments = bodies.moments.data();
    in.pairs = columns.arrays(i.data(), j.data(), shift.data());
    in.end = kListed;
  }
};

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

void compare(const SphereLaw& law, Isa isa, Tally tally, bool images, Flow flow) {
  Fixture f(law, images, tally == Tally::stress, flow == Flow::shear, 7);
  const std::size_t n = 2 * kPairs;
  std::vector<Vec3> force(n), torque(n);
  Vec3 virial{};
  double shear_virial = 0;
  double largest = 0, largest_moment = 0;
  std::vector<oracle::SpherePairResponse> expected;
  int sliding = 0, sticking = 0;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const auto response = oracle::pair_response(law, f.pairs[k]);
    force[f.second[k]] += response.force, force[f.first[k]] -= response.force;
    torque[f.second[k]] += response.moment_j, torque[f.first[k]] += response.moment_i;
    for (int a = 0; a < 3; ++a) virial[a] += response.force[a] * f.pairs[k].r[a];
    shear_virial += response.force[0] * f.pairs[k].r[1];
    largest = std::max(largest, norm(response.force)), largest_moment = std::max(largest_moment, norm(response.moment));
    if (response.gap < 0 && law.friction > 0) {
      const double limit =
          law.friction * repulsion(law, pair_stiffness(law, f.pairs[k].radius_i, f.pairs[k].radius_j), response.gap);
      (norm(response.tangential) > limit * (1 - 1e-9) ? sliding : sticking) += 1;
    }
    expected.push_back(response);
  }
  const PairForceTally sum = select_kernel(law, tally, isa, false, flow)(f.in);
  const double tolerance = kRounding * largest;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const SphereHistory h = f.columns.history(k);
    expect_near(h.tangential_force, expected[k].tangential, tolerance);
    expect_near(h.moment, expected[k].moment, kRounding * largest_moment);
  }
  for (std::size_t b = 0; b < n; ++b) {
    expect_near(f.bodies.force(b), force[b], tolerance);
    expect_near(f.bodies.torque(b), torque[b], tolerance);
  }
  for (std::size_t b = n; b < n + 2 * SphereStore::kPads; ++b) expect_near(triple_at(f.bodies.load(b)), {}, 0);
  if (tally == Tally::stress) {
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(sum.virial[a], virial.c[a], 1e-11 * largest);
  }
  EXPECT_NEAR(sum.shear_virial, flow == Flow::shear ? shear_virial : 0.0, 1e-11 * largest);
  EXPECT_GT(f.apart, 20);
  if (law.friction > 0) {
    EXPECT_GT(sliding, 20);
    EXPECT_GT(sticking, 20);
  }
}

TEST(SpherePairForce, IsTheLawForEveryKernel) {
  for (const Isa isa : machine_isas())
    for (const SphereLaw& law : oracle::sphere_laws())
      for (const auto& [tally, flow] : {std::pair(Tally::nothing, Flow::stretch),
                                        std::pair(Tally::stress, Flow::stretch), std::pair(Tally::stress, Flow::shear)})
        for (const bool images : {false, true}) {
          SCOPED_TRACE(std::string(name(isa)) + " " + oracle::words(law) + (images ? " images" : "") +
                       (flow == Flow::shear ? " shear" : ""));
          compare(law, isa, tally, images, flow);
        }
}

TEST(SpherePairForce, EveryLawIsListed) {
  EXPECT_EQ(oracle::sphere_laws().size(), 24u);
  const std::string list = supported_compositions();
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 28);  // four of them of unlike bodies
  SphereLaw rolling;                                          // without friction
  rolling.rolling_friction = 0.1, rolling.rolling_stiffness = 1;
  EXPECT_THROW(select_kernel(rolling, Tally::nothing, Isa::scalar), InputError);
}

}  // namespace
}  // namespace isostat::spheres
