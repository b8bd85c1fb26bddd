// The scattering function of a fractal-blob structure, Gilabert 2007, Eq. 28.
#pragma once

namespace isostat {

struct ScatteringParameters {
  double fractal_dimension = 0;  // d_F, between 1 and 2
  double blob_size = 0;          // xi [length]
  double amplitude = 0;          // 2 pi Phi l^(2 - d_F)
  double constant = 0;           // Cst
};

// I(k) = Cst + amplitude Gamma(d_F) xi^d_F 2F1[(1 + d_F)/2, d_F/2; 1; -(xi k)^2], in the unit of an area; k >= 0.
double scattering_curve(double k, const ScatteringParameters& parameters);

}  // namespace isostat
