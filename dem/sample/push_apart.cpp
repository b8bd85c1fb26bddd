#include "dem/sample/push_apart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dem/sample/random_placement.hpp"

namespace isostat {
namespace {

constexpr double kMargin = 1e-3;    // [R_i + R_j] grains are pushed a little further than asked, to get there at all
constexpr double kSkin = 0.4;       // [mean radius] of the list of neighbours
constexpr int kMostSteps = 50000;   // it takes some hundred, and more only within 1 % of jamming
constexpr double kBalanced = 1e-5;  // forces that balance so well hold for ever: the grains have jammed

// A unit of mass for the smallest grain and of stiffness for its overlaps; others weigh as their volume, so that the
// one time step suits all.
template <int D>
class Relaxation {
 public:
  Relaxation(const PeriodicCell<D>& cell, double gap, Bodies<D>& bodies)
      : cell_(cell), gap_(gap), bodies_(bodies), velocity_(bodies.size()), force_(bodies.size()) {
    double sum = 0, smallest = INFINITY;
    for (const double r : bodies.radius) sum += r, smallest = std::min(smallest, r), largest_ = std::max(largest_, r);
    skin_ = kSkin * sum / static_cast<double>(bodies.size());
    for (const double r : bodies.radius) {
      double mass = 1;
      for (int a = 0; a < D; ++a) mass *= r / smallest;
      inverse_mass_.push_back(1 / mass);
    }
  }

  bool run() {
    list_neighbours();
    for (int step = 0; step < kMostSteps; ++step) {
      push();
      if (!overlap_) return true;
      if (net_ <= kBalanced * strongest_) return false;
      move();
    }
    return false;
  }

 private:
  struct Pair {
    std::int32_t i, j;
  };

  // The pairs that may come to touch before a grain has gone half the skin.
  void list_neighbours() {
    const std::size_t n = bodies_.size();
    for (Vec<D>& r : bodies_.position) r = cell_.wrap(r);
    Placement<D> places(Frame<D>{{}, cell_.length, true}, 2 * largest_ * (1 + kMargin) + skin_, gap_, n);
    for (std::size_t k = 0; k < n; ++k) places.add(bodies_.position[k], k);
    pairs_.clear();
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < n; ++i) {
      near.clear();
      places.visit(bodies_.position[i], bodies_, [&](std::size_t j, double distance) {
        if (j > i && distance < reach(i, j) + skin_) near.push_back(static_cast<std::int32_t>(j));
        return true;
      });
      std::sort(near.begin(), near.end());  // in a small cell a column is visited twice
      near.erase(std::unique(near.begin(), near.end()), near.end());
      for (const std::int32_t j : near) pairs_.push_back({static_cast<std::int32_t>(i), j});
    }
    listed_ = bodies_.position;
  }

  double reach(std::size_t i, std::size_t j) const {
    return (bodies_.radius[i] + bodies_.radius[j]) * (1 + kMargin) + gap_;
  }

  void push() {
    std::fill(force_.begin(), force_.end(), Vec<D>{});
    overlap_ = false, strongest_ = 0, net_ = 0;
    for (const Pair& pair : pairs_) {
      const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
      Vec<D> d = bodies_.position[j] - bodies_.position[i];
      d += cell_.offset(cell_.nearest_image(d));
      const double distance = norm(d), depth = reach(i, j) - distance;
      if (!(depth > 0)) continue;
      if (distance < bodies_.radius[i] + bodies_.radius[j] + gap_) overlap_ = true;
      if (distance == 0) continue;
      strongest_ = std::max(strongest_, depth);
      const Vec<D> f = (depth / distance) * d;
      force_[j] += f, force_[i] -= f;
    }
    for (const Vec<D>& f : force_) net_ = std::max(net_, norm(f));
  }

  // FIRE with the constants of its paper.
  void move() {
    double power = 0, forces = 0, speeds = 0;
    for (std::size_t k = 0; k < force_.size(); ++k) {
      power += dot(force_[k], velocity_[k]);
      forces += dot(force_[k], force_[k]), speeds += dot(velocity_[k], velocity_[k]);
    }
    if (power > 0) {
      const double turn = mixing_ * std::sqrt(speeds / forces);
      for (std::size_t k = 0; k < force_.size(); ++k) velocity_[k] = (1 - mixing_) * velocity_[k] + turn * force_[k];
      if (++downhill_ > 5) dt_ = std::min(1.1 * dt_, kLongestStep), mixing_ *= 0.99;
    } else {
      std::fill(velocity_.begin(), velocity_.end(), Vec<D>{});
      downhill_ = 0, dt_ *= 0.5, mixing_ = kMixing;
    }
    bool far = false;
    for (std::size_t k = 0; k < force_.size(); ++k) {
      velocity_[k] += (dt_ * inverse_mass_[k]) * force_[k];
      bodies_.position[k] += dt_ * velocity_[k];
      const Vec<D> way = bodies_.position[k] - listed_[k];
      far = far || 4 * dot(way, way) > skin_ * skin_;
    }
    if (far) list_neighbours();
  }

  static constexpr double kMixing = 0.1, kLongestStep = 0.3;

  const PeriodicCell<D>& cell_;
  const double gap_;
  Bodies<D>& bodies_;
  std::vector<Vec<D>> velocity_, force_, listed_;
  std::vector<double> inverse_mass_;
  std::vector<Pair> pairs_;
  double largest_ = 0, skin_ = 0;   // [a]
  double strongest_ = 0, net_ = 0;  // largest force of a pair, largest sum on a grain
  bool overlap_ = false;
  double dt_ = 0.1, mixing_ = kMixing;
  int downhill_ = 0;
};

}  // namespace

template <int D>
bool push_apart(const PeriodicCell<D>& cell, double gap, Bodies<D>& bodies) {
  const double diameter = 2 * *std::max_element(bodies.radius.begin(), bodies.radius.end());
  for (int a = 0; a < D; ++a)
    if (cell.length[a] < diameter * (1 + kMargin) + gap) return false;  // the largest would meet itself
  const bool apart = Relaxation<D>(cell, gap, bodies).run();
  for (Vec<D>& r : bodies.position) r = cell.wrap(r);
  return apart;
}

template bool push_apart(const PeriodicCell<2>&, double, Bodies<2>&);
template bool push_apart(const PeriodicCell<3>&, double, Bodies<3>&);

}  // namespace isostat
