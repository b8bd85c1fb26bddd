// Quadrature points that stand for the common part of two disks in a Fourier transform.
#pragma once
#include <array>
#include <map>

#include "geometry/gauss_legendre.hpp"
#include "geometry/union_terms.hpp"

namespace isostat {

class OverlapPoints {
 public:
  // Appends to out.point, out.point_weight. k_max [1/length]: points resolve exp(ik.r) up to it with an error of
  // `tolerance` times a disk's squared radius.
  OverlapPoints(UnionTerms& out, double k_max, double tolerance) : out_(out), k_max_(k_max), tolerance_(tolerance) {}

  // Lens of two disks whose circles cross, times `weight`: centre p, vector to the other centre, radii r and q.
  // Returns the weight with which each of the two whole disks enters besides: where the centre of one lies beyond the
  // common chord, the lens is that disk plus a (negative) crescent.
  std::array<double, 2> lens(const Vec2& p, const Vec2& branch, double r, double q, double weight);

 private:
  int points_for(double phase, double share) const;
  const Quadrature& rule(int n);
  void add(const Vec2& at, double weight) { out_.point.push_back(at), out_.point_weight.push_back(weight); }

  UnionTerms& out_;
  double k_max_, tolerance_;
  std::map<int, Quadrature> rules_;
};

}  // namespace isostat
