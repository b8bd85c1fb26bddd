#include "dem/sample/hard_gas.hpp"

#include <algorithm>
#include <numeric>

namespace isostat {
namespace {

class Gas {
 public:
  Gas(const HardGas& gas, const std::vector<double>& radii, Placement<2>& placement, Bodies<2>& bodies, Random& random)
      : gas_(gas), radii_(radii), placement_(placement), bodies_(bodies), random_(random) {
    const double sum = std::accumulate(radii.begin(), radii.end(), 0.0);
    reach_ = 2 * gas.move * sum / static_cast<double>(radii.size());
  }

  void sweep() {
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const Vec2 from = bodies_.position[k];
      Vec2 to = from;
      for (int a = 0; a < 2; ++a) to[a] += reach_ * (2 * random_.uniform() - 1);
      to = gas_.cell.wrap(to);
      if (!placement_.free(to, bodies_.radius[k], bodies_, k)) continue;
      placement_.remove(from, k);
      placement_.add(to, k);
      bodies_.position[k] = to;
    }
  }

  // The part of their full size that all disks may have where they are, at most 1.
  double largest_part() const {
    double part = 1;
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      placement_.visit(bodies_.position[k], bodies_, [&](std::size_t other, double distance) {
        if (other != k) part = std::min(part, (distance - gas_.gap) / (radii_[k] + radii_[other]));
        return true;
      });
    return part;
  }

  void resize(double part) {
    for (std::size_t k = 0; k < bodies_.size(); ++k) bodies_.radius[k] = part == 1 ? radii_[k] : part * radii_[k];
  }

 private:
  const HardGas& gas_;
  const std::vector<double>& radii_;
  Placement<2>& placement_;
  Bodies<2>& bodies_;
  Random& random_;
  double reach_;  // [a]
};

}  // namespace

bool grow_and_mix(const HardGas& gas, const std::vector<double>& radii, Placement<2>& placement, Bodies<2>& bodies,
                  Random& random) {
  Gas disks(gas, radii, placement, bodies, random);
  int growth = 0;
  for (double part = 0; part < 1;) {
    if (++growth > gas.most_growth) return false;
    disks.sweep();
    part = disks.largest_part();
    disks.resize(part);
  }
  for (int k = 0; k < gas.sweeps; ++k) disks.sweep();
  return true;
}

}  // namespace isostat
