// chi_hat by slow, obvious ways: the sum over disks of 2 pi R J1(kR)/k exp(-ik.r), and for overlapping disks the
// boundary integral (i/k^2) of (k.n) exp(-ik.r) along the walls found by brute force.
#pragma once
#include <complex>

#include "tests/support/disk_packings.hpp"

namespace isostat::oracle {

std::complex<double> sum_over_disks(const Disks& disks, const Vec2& k);
std::complex<double> boundary_integral(const Disks& disks, const Vec2& k);  // of the union; k on the reciprocal lattice

}  // namespace isostat::oracle
