// What an input's rows of G weigh, and the vibrations that follow: one place for spheres and for what lies in the
// plane.
#pragma once
#include <vector>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/sphere_stiffness.hpp"
#include "analysis/stiffness/vibration.hpp"

namespace isostat {

// Stiffnesses of the links of a packing in space: of its own law, or what a packing without one is given.
std::vector<SphereStiffness> sphere_stiffness(const AnalysisInput& input, const AnalysisOptions& options);

// G with rows in which stiffness is diagonal (in space those of contact frames), and that stiffness.
struct StiffRows {
  RigidityMatrix g;
  std::vector<double> k;
};
StiffRows stiff_rows(const AnalysisInput& input, const AnalysisOptions& options);

// Degrees of freedom of the bodies in a fixed cell: columns of K.
std::int64_t dof_count(const AnalysisInput& input, const AnalysisOptions& options);
// How many modes --modes asks for. Throws InputError for `all` of too many degrees of freedom.
int mode_count(const AnalysisInput& input, const AnalysisOptions& options);
VibrationModes modes_of(const AnalysisInput& input, const AnalysisOptions& options, int count, bool displacements);

}  // namespace isostat
