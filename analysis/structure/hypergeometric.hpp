// The hypergeometric function of the fractal scattering law (Gilabert 2007, Eq. 28).
#pragma once

namespace isostat {

// 2F1((1 + d)/2, d/2; 1; -x^2) for 0 < d < 3 and any real x, to 1e-14 relative. It equals (1 + x^2)^(-d/2)
// P_{d-1}(1/sqrt(1 + x^2)) with the Legendre function P: its series about 1 serves |x| < 1, the connection formula to
// series about 0 (Abramowitz & Stegun 8.1.4) the rest, where GSL's own 2F1 fails.
double fractal_hypergeometric(double d, double x);

}  // namespace isostat
