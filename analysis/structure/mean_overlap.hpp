// Areas common to two disks, averaged over directions: the autocorrelation of disks in closed form.
#pragma once

namespace isostat {

// Area common to disks of radii r, q at distance s [length^2].
double lens_area(double r, double q, double s);

// Mean of lens_area over all directions of a shift of length x, for centres at distance d before the shift [length^2]:
// (1/pi) int_0^pi lens(r, q, sqrt(d^2 + x^2 - 2 d x cos phi)) dphi, by one Gauss rule between the angles where the
// disks cease to be apart or to contain one another, after a substitution that takes the powers 3/2 at both ends away.
// Good to about 1e-6 of the smaller disk; its Fourier transform is J0(kd) times the two form factors.
double mean_overlap(double r, double q, double d, double x);

}  // namespace isostat
