// What a listed pair of spheres carries for the force kernel: coefficients of the pair, and the histories of its
// springs. The columns of NeighbourLists (dem/solver/neighbours.hpp).
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dem/solver/aligned.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/kernel/pair_force.hpp"
#include "dem/spheres/sphere_store.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

// eta = 2 zeta sqrt(m_r k_N), of Hertz divided by d^(1/4) [F0 T0/a, F0 T0/a^(5/4)]; of a soft contact divided by
// sqrt(k_N) [m^(1/2)]. The inverse of m_r is 1/m_i + 1/m_j.
inline double damping_coefficient(const SphereLaw& law, double stiffness, double inverse_mass) {
  const double tangent = law.normal == NormalForce::hertz ? 1.5 * stiffness : stiffness;
  return 2 * law.damping * std::sqrt(tangent / inverse_mass);
}

class SpherePairs {
 public:
  static constexpr int kDimension = 3;
  using Bodies = SphereStore;
  using History = SphereHistory;
  static constexpr std::uint32_t kStride = spheres::kRowWidth;  // kernels name body k by the offset of its row

  // unlike: bodies of several kinds, whose pairs have constants of their own.
  explicit SpherePairs(const SphereLaw& law, bool unlike = false) : law_(law), unlike_(unlike) {}

  // n pairs that do nothing.
  void resize(std::size_t n) {
    radius_sum_.assign(n, 1.0), stiffness_.assign(n, 0.0), damping_.assign(n, 0.0);
    for (auto& t : tangential_) t.assign(law_.friction > 0 ? n : 0, 0.0);
    for (auto& m : moment_) m.assign(law_.rolling_friction > 0 ? n : 0, 0.0);
    const std::size_t own = unlike_ ? n : 0;
    tangential_ratio_.assign(own, 0.0), friction_.assign(own, 0.0), soft_.assign(own, spheres::kNotSoft);
    soft_contacts_.clear();
  }
  void fill(std::size_t k, const Bodies& bodies, std::size_t i, std::size_t j) {
    const SphereConstants &a = bodies.constants[i], &b = bodies.constants[j];
    const double inverse_mass = a.inverse_mass + b.inverse_mass;
    radius_sum_[k] = a.radius + b.radius;
    if (unlike_) return fill_unlike(k, pair_stiffness(law_, bodies.body(i), bodies.body(j)), inverse_mass);
    stiffness_[k] = pair_stiffness(law_, a.radius, b.radius).normal;
    damping_[k] = damping_coefficient(law_, stiffness_[k], inverse_mass);
  }
  History history(std::size_t k) const {
    History h;
    for (std::size_t a = 0; a < 3; ++a) {
      if (law_.friction > 0) h.tangential_force.c[a] = tangential_[a][k];
      if (law_.rolling_friction > 0) h.moment.c[a] = moment_[a][k];
    }
    return h;
  }
  void remember(std::size_t k, const History& h) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (law_.friction > 0) tangential_[a][k] = h.tangential_force.c[a];
      if (law_.rolling_friction > 0) moment_[a][k] = h.moment.c[a];
    }
  }
  // Seen from the other body both change their sign.
  static History turned(const History& h) { return {-1.0 * h.tangential_force, -1.0 * h.moment}; }

  // Another law: fill() every pair anew. Springs of an axis that was not there begin at zero.
  void set_law(const SphereLaw& law) {
    law_ = law;
    soft_contacts_.clear();
    for (auto& t : tangential_) t.resize(law_.friction > 0 ? size() : 0);
    for (auto& m : moment_) m.resize(law_.rolling_friction > 0 ? size() : 0);
  }
  void scale_springs(double tangential, double moment) {  // T and M of every pair, by these factors
    for (auto& column : tangential_)
      for (double& t : column) t *= tangential;
    for (auto& column : moment_)
      for (double& m : column) m *= moment;
  }

  std::size_t size() const { return radius_sum_.size(); }
  // The arrays as the kernels take them; i, j and shift are the lists'.
  spheres::PairArrays arrays(const std::uint32_t* i, const std::uint32_t* j, const std::uint8_t* shift) {
    const auto columns = [](std::array<AlignedVector<double>, 3>& c) {
      return std::array<double*, 3>{c[0].data(), c[1].data(), c[2].data()};
    };
    return {i,
            j,
            shift,
            radius_sum_.data(),
            stiffness_.data(),
            damping_.data(),
            tangential_ratio_.data(),
            friction_.data(),
            soft_.data(),
            soft_contacts_.data(),
            columns(tangential_),
            columns(moment_)};
  }

 private:
  void fill_unlike(std::size_t k, const ContactStiffness& c, double inverse_mass) {
    stiffness_[k] = c.normal, friction_[k] = c.friction;
    if (c.is_soft()) {
      soft_[k] = static_cast<std::int32_t>(soft_contacts_.size());
      soft_contacts_.push_back(c.soft);
      damping_[k] = 2 * law_.damping / std::sqrt(inverse_mass);
    } else {
      tangential_ratio_[k] = c.tangential / c.normal;
      damping_[k] = damping_coefficient(law_, c.normal, inverse_mass);
    }
  }

  SphereLaw law_;
  bool unlike_;
  AlignedVector<double> radius_sum_, stiffness_, damping_;
  AlignedVector<double> tangential_ratio_, friction_;  // of unlike bodies
  AlignedVector<std::int32_t> soft_;
  std::vector<SoftContact> soft_contacts_;
  std::array<AlignedVector<double>, 3> tangential_, moment_;
};

}  // namespace isostat
