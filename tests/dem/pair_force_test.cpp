// Every kernel (law x instruction set x tally x flow x images) against the reference law of
// tests/oracle/disk_reference, on random pairs: bodies shared by several pairs, some pairs in contact, some just
// formed, some across a gap, some out of reach, padding at the end.
#include "dem/disks/kernel/pair_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dem/disks/bodies_store.hpp"
#include "dem/input_error.hpp"
#include "dem/solver/aligned.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/solver/random.hpp"
#include "tests/oracle/disk_reference.hpp"
#include "tests/support/machine_isas.hpp"

namespace isostat {
namespace {

constexpr std::size_t kPairs = 237, kListed = 240;  // a multiple of the batch with three padding pairs
static_assert(kListed % kPairBatch == 0);
constexpr double kRounding = 1e-13;  // of the largest force

struct LawCase {
  bool adhesion, damping, friction, rolling;
};
std::vector<LawCase> law_cases() {
  std::vector<LawCase> list;
  for (bool adhesion : {false, true})
    for (bool damping : {false, true})
      for (int turning = 0; turning < 3; ++turning) list.push_back({adhesion, damping, turning > 0, turning > 1});
  return list;
}

DiskLaw law_of(const LawCase& c) {
  DiskLaw p;
  p.normal_stiffness = 1e3;
  if (c.adhesion) p.attraction = 1.5, p.attraction_range = 0.05;
  if (c.damping) p.damping = 0.6;
  if (c.friction) p.friction = 0.4, p.tangential_stiffness = 700;
  if (c.rolling) p.rolling_friction = 0.03, p.rolling_stiffness = 20;
  return p;
}

kernel::RowOffset offset(std::size_t body) { return static_cast<kernel::RowOffset>(body * kernel::kRowWidth); }

// Pair k joins bodies 2k and 2k+1, except that every fifth pair shares its first body with the pair before.
struct Fixture {
  PairForceInput in;
  BodiesStore bodies;
  AlignedVector<kernel::RowOffset> i, j;
  std::vector<std::size_t> first, second;  // bodies of the pairs
  AlignedVector<std::uint8_t> shift;
  AlignedVector<double> damping, sum, tangential, moment;
  std::vector<oracle::PairMoment> pairs;

  Fixture(const DiskLaw& law, bool images, std::uint64_t seed) {
    Random random(seed);
    auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    bodies.resize(2 * kPairs);
    i.assign(kListed, offset(2 * kPairs)), j.assign(kListed, offset(2 * kPairs + 1)), shift.assign(kListed, 4);
    damping.assign(kListed, 0), sum.assign(kListed, 1), tangential.assign(kListed, 0), moment.assign(kListed, 0);
    in.law = law;
    in.time_step = 0.01;
    in.images = images;
    in.flow_half[0] = -0.3, in.flow_half[1] = 0.2, in.flow_now[0] = -0.31, in.flow_now[1] = 0.19;
    in.shear_half = 0.4, in.shear_now = 0.41;
    const double length[2] = {7, 9};
    for (int c = 0; c < 9; ++c) in.offset_x[c] = (c % 3 - 1) * length[0], in.offset_y[c] = (c / 3 - 1) * length[1];

    for (std::size_t k = 0; k < 2 * kPairs; ++k) {
      const double radius = between(0.2, 0.5), mass = 4 * radius * radius;
      bodies.constants[k] = {1 / mass, 8 / (mass * 4 * radius * radius), radius, mass};
      double* row = bodies.row(k);
      row[0] = between(0, 7), row[1] = between(0, 9);
      row[2] = between(-1, 1), row[3] = between(-1, 1), row[5] = between(-3, 3), row[4] = radius * row[5];
      row[6] = row[2] + between(-0.1, 0.1), row[7] = row[3] + between(-0.1, 0.1);
    }
    for (std::size_t k = 0; k < kPairs; ++k) {
      const std::size_t a = k % 5 == 4 ? 2 * (k - 1) : 2 * k, b = 2 * k + 1;
      i[k] = offset(a), j[k] = offset(b), first.push_back(a), second.push_back(b);
      const BodyConstants &ca = bodies.constants[a], &cb = bodies.constants[b];
      const std::uint8_t code = images ? static_cast<std::uint8_t>(k % 9) : 4;
      shift[k] = code;
      sum[k] = ca.radius + cb.radius;
      const double gap = k % 7 == 0 ? between(0.05, 0.5) : k % 3 == 0 ? between(0, 0.05) : between(-0.02, 0);
      const double angle = between(0, 6.28), distance = sum[k] + gap;
      double* row = bodies.row(b);
      row[0] = bodies.row(a)[0] + distance * std::cos(angle) - in.offset_x[code];
      row[1] = bodies.row(a)[1] + distance * std::sin(angle) - in.offset_y[code];
      const double reduced = ca.mass * cb.mass / (ca.mass + cb.mass);
      damping[k] = law.damping * 2 * std::sqrt(law.normal_stiffness * reduced);
      if (gap < 0 && law.friction > 0) tangential[k] = between(-8, 8);  // up to mu N_e = 8: some slide
      if (gap < 0 && law.rolling_friction > 0) moment[k] = between(-0.6, 0.6);
    }
    for (std::size_t k = 0; k < kPairs; ++k) {
      const std::size_t a = first[k], b = second[k];
      const double *ra = bodies.row(a), *rb = bodies.row(b);
      oracle::PairMoment p;
      p.x = rb[0] + in.offset_x[shift[k]] - ra[0], p.y = rb[1] + in.offset_y[shift[k]] - ra[1];
      p.radius_i = bodies.constants[a].radius, p.radius_j = bodies.constants[b].radius;
      p.mass_i = bodies.constants[a].mass, p.mass_j = bodies.constants[b].mass;
      p.u = rb[2] - ra[2], p.v = rb[3] - ra[3], p.p = rb[6] - ra[6], p.q = rb[7] - ra[7];
      p.spin_i = ra[5], p.spin_j = rb[5];
      p.tangential = tangential[k], p.moment = moment[k];
      p.time_step = in.time_step;
      pairs.push_back(p);
    }
    in.rows = bodies.rows.data(), in.loads = bodies.loads.data();
    in.pairs = {i.data(), j.data(), shift.data(), damping.data(), sum.data(), tangential.data(), moment.data()};
    in.begin = 0, in.end = kListed;
  }
};

struct Sums {
  double virial[2] = {0, 0}, sliding = 0, rolling = 0, shear_virial = 0;
};

// Loads by body (Fx, Fy, moment) and sums, from the reference; springs are left in `pairs`.
Sums reference(Fixture& f, bool flow, bool shear, std::vector<double>& loads, int& contacts, int& formed, int& slid) {
  Sums s;
  loads.assign(3 * f.bodies.size(), 0);
  for (std::size_t k = 0; k < kPairs; ++k) {
    oracle::PairMoment p = f.pairs[k];
    if (flow) {
      p.u += f.in.flow_half[0] * p.x, p.v += f.in.flow_half[1] * p.y;
      p.p += f.in.flow_now[0] * p.x, p.q += f.in.flow_now[1] * p.y;
    }
    if (shear) p.u += f.in.shear_half * p.y, p.p += f.in.shear_now * p.y;
    const oracle::PairResponse r = oracle::pair_response(f.in.law, p);
    const double closing = -(p.x * p.u + p.y * p.v) / std::hypot(p.x, p.y);
    contacts += r.gap < 0, formed += r.gap < 0 && r.gap + closing * p.time_step > 0, slid += r.sliding > 0;
    double *a = &loads[3 * f.first[k]], *b = &loads[3 * f.second[k]];
    a[0] -= r.fx, a[1] -= r.fy, a[2] += r.moment_i;
    b[0] += r.fx, b[1] += r.fy, b[2] += r.moment_j;
    s.virial[0] += r.fx * p.x, s.virial[1] += r.fy * p.y;
    s.sliding += r.sliding, s.rolling += r.rolling;
    if (shear) s.shear_virial += r.fx * p.y;
    f.pairs[k].tangential = r.tangential, f.pairs[k].moment = r.moment;
  }
  return s;
}

TEST(PairForce, EveryKernelIsTheReferenceLaw) {
  for (const LawCase& c : law_cases())
    for (Isa isa : machine_isas())
      for (const auto& [tally, flow] :
           {std::pair(Tally::nothing, Flow::stretch), std::pair(Tally::stress, Flow::stretch),
            std::pair(Tally::energy, Flow::stretch), std::pair(Tally::stress, Flow::shear),
            std::pair(Tally::energy, Flow::shear)})
        for (bool images : {false, true}) {
          SCOPED_TRACE(std::string(name(isa)) + (c.adhesion ? " adhesion" : "") + (c.damping ? " damping" : "") +
                       (c.friction ? " friction" : "") + (c.rolling ? " rolling" : "") + " tally " +
                       std::to_string(static_cast<int>(tally)) + (flow == Flow::shear ? " shear" : "") +
                       (images ? " images" : ""));
          const DiskLaw law = law_of(c);
          Fixture f(law, images, 7);
          std::vector<double> expected;
          int contacts = 0, formed = 0, slid = 0;
          // A kernel that measures nothing serves fixed cells: it ignores the flow.
          const Sums sums =
              reference(f, tally != Tally::nothing, flow == Flow::shear, expected, contacts, formed, slid);
          ASSERT_GT(contacts, 80);
          ASSERT_GT(formed, 10);
          ASSERT_TRUE(!c.friction || slid > 10);
          const PairForceTally got = select_kernel(law, tally, isa, flow)(f.in);
          const double scale = 100;
          EXPECT_NEAR(got.shear_virial, sums.shear_virial, 1e-11 * scale);
          EXPECT_EQ(got.shear_virial != 0, flow == Flow::shear);
          for (std::size_t k = 0; k < f.bodies.size(); ++k) {
            const double* load = f.bodies.load(k);
            ASSERT_NEAR(load[0], expected[3 * k], kRounding * scale) << "Fx of " << k;
            ASSERT_NEAR(load[1], expected[3 * k + 1], kRounding * scale) << "Fy of " << k;
            ASSERT_NEAR(f.bodies.constants[k].radius * load[2] + load[3], expected[3 * k + 2], kRounding * scale)
                << "moment of " << k;
          }
          for (std::size_t k = 0; k < kPairs; ++k) {
            ASSERT_NEAR(f.tangential[k], f.pairs[k].tangential, kRounding * scale) << "T of pair " << k;
            ASSERT_NEAR(f.moment[k], f.pairs[k].moment, kRounding * scale) << "M of pair " << k;
          }
          for (std::size_t k = kPairs; k < kListed; ++k) ASSERT_TRUE(f.tangential[k] == 0 && f.moment[k] == 0);
          for (std::size_t k = f.bodies.size(); k < f.bodies.size() + 2; ++k)
            for (int m = 0; m < 4; ++m) ASSERT_EQ(f.bodies.load(k)[m], 0) << "padding bears no load";
          if (tally != Tally::nothing) {
            EXPECT_NEAR(got.virial[0], sums.virial[0], 1e-11 * scale);
            EXPECT_NEAR(got.virial[1], sums.virial[1], 1e-11 * scale);
          } else {
            EXPECT_TRUE(got.virial[0] == 0 && got.virial[1] == 0);
          }
          if (tally == Tally::energy) {
            EXPECT_NEAR(got.sliding, sums.sliding, 1e-12 * scale);
            EXPECT_NEAR(got.rolling, sums.rolling, 1e-12 * scale);
            EXPECT_EQ(got.sliding > 0, c.friction);
            EXPECT_EQ(got.rolling > 0, c.rolling);
          }
        }
}

// Watching must not change the run: the stress and energy instances give the same bits; so does the one without a
// tally when nothing flows.
TEST(PairForce, TalliesDoNotChangeABit) {
  for (const LawCase& c : law_cases())
    for (Isa isa : machine_isas())
      for (bool flow : {false, true}) {
        const DiskLaw law = law_of(c);
        std::vector<Fixture> runs;
        for (Tally tally : {Tally::stress, Tally::energy, Tally::nothing}) {
          if (flow && tally == Tally::nothing) continue;
          Fixture f(law, true, 11);
          if (!flow) f.in.flow_half[0] = f.in.flow_half[1] = f.in.flow_now[0] = f.in.flow_now[1] = 0;
          select_kernel(law, tally, isa)(f.in);
          runs.push_back(std::move(f));
        }
        for (std::size_t r = 1; r < runs.size(); ++r) {
          EXPECT_EQ(runs[r].bodies.loads, runs[0].bodies.loads) << name(isa);
          EXPECT_EQ(runs[r].tangential, runs[0].tangential) << name(isa);
          EXPECT_EQ(runs[r].moment, runs[0].moment) << name(isa);
        }
      }
}

TEST(PairForce, AnUnlistedCompositionIsRefusedWithTheList) {
  DiskLaw law = law_of({true, true, false, false});
  law.rolling_friction = 0.1, law.rolling_stiffness = 1;  // rolling resistance without friction
  try {
    select_kernel(law, Tally::nothing, Isa::scalar);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("adhesion linear, damping critical, friction coulomb, rolling elastoplastic"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace isostat
