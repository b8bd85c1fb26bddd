// How the forces of an input are to be read: whether it has any, their scale F1, and what counts as a loaded contact.
#pragma once
#include "analysis/input.hpp"

namespace isostat {

struct ForceReading {
  bool known = false;      // the input carries forces (a state of the solver, or a foreign packing with some force)
  bool law_known = false;  // AnalysisInput::has_law()
  bool cohesive = true;    // every interaction counts; false: only contacts whose force exceeds the threshold
  double scale = 1;  // F1 = max(F0, a P, heaviest weight); without a law the mean magnitude of the link forces [force
                     // unit of input]
  double threshold = 0;  // kLoadTolerance * scale
};

// Without a law a packing is read as cohesionless if it has forces and no normal force below -threshold.
ForceReading read_forces(const AnalysisInput& input);

template <int D>
double force_magnitude(const Link<D>& link);  // |F| = |N n + T t|

}  // namespace isostat
