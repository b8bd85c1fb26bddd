// What a listed pair of disks carries for the force kernel: coefficients of the pair, and the histories of its springs.
// The columns of NeighbourLists (dem/solver/neighbours.hpp).
#pragma once
#include <cmath>
#include <cstdint>

#include "dem/disks/bodies_store.hpp"
#include "dem/disks/disks.hpp"
#include "dem/solver/aligned.hpp"

namespace isostat {

class DiskPairs {
 public:
  static constexpr int kDimension = 2;
  using Bodies = BodiesStore;
  using History = DiskHistory;
  static constexpr std::uint32_t kStride = kernel::kRowWidth;  // kernels name body k by the offset of its row

  explicit DiskPairs(const DiskLaw& law) : damping_ratio_(law.damping), stiffness_(law.normal_stiffness) {}

  // n pairs that do nothing.
  void resize(std::size_t n) {
    damping_.assign(n, 0.0), radius_sum_.assign(n, 1.0);
    tangential_.assign(n, 0.0), moment_.assign(n, 0.0);
  }
  void fill(std::size_t k, const Bodies& bodies, std::size_t i, std::size_t j) {
    const BodyConstants &a = bodies.constants[i], &b = bodies.constants[j];
    radius_sum_[k] = a.radius + b.radius;
    damping_[k] = damping_of(a, b);
  }
  History history(std::size_t k) const { return {tangential_[k], moment_[k]}; }
  void remember(std::size_t k, const History& h) { tangential_[k] = h.tangential_force, moment_[k] = h.moment; }
  // Seen from the other body T is the same and M changes its sign.
  static History turned(const History& h) { return {h.tangential_force, -h.moment}; }

  void set_stiffness(double stiffness) { stiffness_ = stiffness; }  // K_N [F0/a]
  void set_damping(std::size_t k, const BodyConstants& a, const BodyConstants& b) { damping_[k] = damping_of(a, b); }
  void scale_springs(double tangential, double moment) {  // T and M of every pair, by these factors
    for (double& t : tangential_) t *= tangential;
    for (double& m : moment_) m *= moment;
  }

  const double* damping() const { return damping_.data(); }
  const double* radius_sum() const { return radius_sum_.data(); }
  double* tangential() { return tangential_.data(); }
  double* moment() { return moment_.data(); }

 private:
  // zeta times the critical damping of the pair (Gilabert 2007, Eq. 6) [F0 T0/a]
  double damping_of(const BodyConstants& a, const BodyConstants& b) const {
    return damping_ratio_ * std::sqrt(4 * stiffness_ / (a.inverse_mass + b.inverse_mass));
  }

  double damping_ratio_, stiffness_;
  AlignedVector<double> damping_, radius_sum_, tangential_, moment_;
};

}  // namespace isostat
