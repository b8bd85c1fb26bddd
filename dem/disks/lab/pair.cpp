#include "dem/disks/lab/pair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/disks/at_rest.hpp"
#include "dem/disks/lab/few_bodies.hpp"
#include "dem/solver/aligned.hpp"

namespace isostat::lab {
namespace {

// Runs until the disks have touched and parted again, or for at most `time` [T0].
State<Disks> collide(const LawScene& law, const std::vector<Disk>& disks, double fraction, double time) {
  State<Disks> state = few_bodies(law, disks, fraction);
  Solver solver(state, {});
  bool touched = false;
  while (solver.time() < time) {
    solver.step();
    solver.snapshot(state);
    const bool touching = !state.packing.links.empty();
    if (touched && !touching) break;
    touched = touched || touching;
  }
  return state;
}

// Disk 1 comes from the right with a gap such that the first step in contact begins at the given phase of a step,
// aimed such that its centre is then at (a, 0): the impact is the same for every step and phase.
std::vector<Disk> approach(double dt, double normal_speed, double tangential_speed, double phase) {
  const double time = (3 + phase) * dt;  // to contact
  return {{0, 0, 0.5, 0, 0, 0},
          {1 + time * normal_speed, -time * tangential_speed, 0.5, -normal_speed, tangential_speed, 0}};
}

double collision_time(const LawScene& law) {
  return 20 * std::numbers::pi / std::sqrt(2 * law.normal_stiffness);  // ten undamped half periods, m_r = 1/2
}

double exact_restitution(double zeta) { return std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta)); }

// Two disks held and moved by hand: rows written, one kernel call a step.
class HeldPair {
 public:
  HeldPair(const LawScene& scene, double overlap) : law_(resolve(scene)) {
    law_.damping = 0;
    kernel_ = select_kernel(law_, Tally::nothing, best_isa());
    rows_.assign(4 * kernel::kRowWidth, 0.0);
    loads_.assign(4 * kernel::kLoadWidth, 0.0);
    rows_[3 * kernel::kRowWidth] = 1e6;
    std::fill(std::begin(i_), std::end(i_), 2 * kernel::kRowWidth);  // the padding pair
    std::fill(std::begin(j_), std::end(j_), 3 * kernel::kRowWidth);
    std::fill(std::begin(shift_), std::end(shift_), kNoImage<2>);
    std::fill(std::begin(sum_), std::end(sum_), 1.0);
    i_[0] = 0, j_[0] = kernel::kRowWidth;
    set_gap(-overlap);
  }
  void set_gap(double gap) { rows_[kernel::kRowWidth] = 1 + gap; }
  // One step of unit length with relative velocity (tangential, of 1) and spin of 1; returns (N, T, M).
  struct Forces {
    double normal, tangential, moment;
  };
  Forces move(double tangential, double spin) {
    double* one = rows_.data() + kernel::kRowWidth;
    one[3] = tangential + 0.5 * spin * one[0], one[4] = 0.5 * spin, one[5] = spin;  // cancels the slip of the spin
    std::fill(loads_.begin(), loads_.end(), 0.0);
    PairForceInput in;
    in.rows = rows_.data(), in.loads = loads_.data(), in.law = law_, in.time_step = 1, in.begin = 0,
    in.end = kPairBatch;
    in.pairs = {i_, j_, shift_, damping_, sum_, tangential_, moment_};
    kernel_(in);
    return {loads_[kernel::kLoadWidth], tangential_[0], moment_[0]};
  }

 private:
  DiskLaw law_;
  PairForceKernel kernel_ = nullptr;
  AlignedVector<double> rows_, loads_;
  alignas(64) kernel::RowOffset i_[kPairBatch], j_[kPairBatch];
  std::uint8_t shift_[kPairBatch];
  alignas(64) double damping_[kPairBatch] = {}, sum_[kPairBatch];
  alignas(64) double tangential_[kPairBatch] = {}, moment_[kPairBatch] = {};
};

// A triangular wave of the displacement, from 0 to +amplitude, to -amplitude, and back, twice; the second cycle counts.
template <class Move>
LoadCycle cycle(double stiffness, double limit, double amplitude, int points, Move&& move) {
  LoadCycle c;
  double u = 0, exact = 0, last = 0;
  const double du = 4 * amplitude / points;
  for (int k = 0; k < 2 * points; ++k) {
    const int quarter = (k % points) * 4 / points;
    const double step = quarter == 1 || quarter == 2 ? -du : du;
    u += step;
    const double force = move(step);
    exact = std::clamp(exact - stiffness * step, -limit, limit);
    if (k >= points) {
      c.points.push_back({u, force, exact});
      c.dissipated -= 0.5 * (force + last) * step;
    }
    last = force;
  }
  c.exact = std::max(0.0, 4 * limit * (amplitude - limit / stiffness));
  return c;
}

}  // namespace

Restitution restitution(const LawScene& given, double fraction, double speed, int phases) {
  LawScene law = given;
  law.attraction = 0;
  Restitution r;
  r.step_fraction = fraction;
  r.exact = exact_restitution(law.damping);
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < phases; ++k) {
    const double dt = fraction / std::sqrt(law.normal_stiffness);
    const State<Disks> end = collide(law, approach(dt, speed, 0, (k + 0.5) / phases), fraction, collision_time(law));
    const double e = (disk(end, 1).vx - disk(end, 0).vx) / speed;
    r.mean += e / phases;
    low = std::min(low, e), high = std::max(high, e);
  }
  r.spread = high - low;
  return r;
}

PullOff pull_off(const LawScene& law, double fraction) {
  PullOff p;
  const double v_star = std::sqrt(law.attraction * law.attraction_range);
  p.exact = std::numbers::sqrt2 * v_star;
  auto separates = [&](double speed) {
    State<Disks> state = few_bodies(law, {{0, 0, 0.5, -speed / 2, 0, 0}, {1, 0, 0.5, speed / 2, 0, 0}}, fraction);
    Solver solver(state, {});
    for (const double end = 20 * law.attraction_range / v_star; solver.time() < end; solver.step()) {
    }
    solver.snapshot(state);
    return state.packing.links.empty();
  };
  double low = 0, high = 4 * p.exact;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (separates(middle) ? high : low) = middle;
  }
  p.speed = high;
  for (const LawPoint& point : normal_curve(law, 2000)) p.largest_tension = std::max(p.largest_tension, -point.force);
  return p;
}

ObliqueImpact oblique_impact(const LawScene& given, double fraction, double normal_speed, double tangential_speed,
                             int phases) {
  LawScene law = given;
  law.attraction = 0;
  ObliqueImpact o;
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < phases; ++k) {
    const double dt = fraction / std::sqrt(law.normal_stiffness);
    const State<Disks> end =
        collide(law, approach(dt, normal_speed, tangential_speed, (k + 0.5) / phases), fraction, collision_time(law));
    const Disk one = disk(end, 1);
    o.normal_velocity += one.vx / phases, o.tangential_velocity += one.vy / phases, o.spin += one.spin / phases;
    low = std::min(low, one.vy), high = std::max(high, one.vy);
  }
  o.spread = high - low;
  o.sliding_exact = tangential_speed - law.friction * 0.5 * (1 + exact_restitution(law.damping)) * normal_speed;
  return o;
}

std::vector<LawPoint> normal_curve(const LawScene& scene, int points) {
  const DiskLaw law = resolve(scene);
  const double deflection = (law.attraction > 0 ? law.attraction : 1.0) / law.normal_stiffness;
  const double low = -3 * deflection, high = law.attraction > 0 ? 1.5 * law.attraction_range : 3 * deflection;
  std::vector<LawPoint> curve;
  HeldPair pair(scene, 0);
  for (int k = 0; k <= points; ++k) {
    const double h = low + (high - low) * k / points;
    pair.set_gap(h);
    const double gap = (1 + h) - 1;  // what the kernel sees
    curve.push_back({h, pair.move(0, 0).normal, at_rest(law, gap).force});
  }
  return curve;
}

LoadCycle tangential_cycle(const LawScene& scene, double overlap, double amplitude, int points) {
  const DiskLaw law = resolve(scene);
  HeldPair pair(scene, overlap);
  return cycle(law.tangential_stiffness, law.friction * law.normal_stiffness * overlap, amplitude, points,
               [&](double du) { return pair.move(du, 0).tangential; });
}

LoadCycle rolling_cycle(const LawScene& scene, double overlap, double amplitude, int points) {
  const DiskLaw law = resolve(scene);
  HeldPair pair(scene, overlap);
  return cycle(law.rolling_stiffness, law.rolling_friction * law.normal_stiffness * overlap, amplitude, points,
               [&](double angle) { return pair.move(0, angle).moment; });
}

}  // namespace isostat::lab
