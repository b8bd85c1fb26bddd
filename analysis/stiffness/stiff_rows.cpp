#include "analysis/stiffness/stiff_rows.hpp"

#include "analysis/rigidity/link_rows_3d.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

constexpr std::int64_t kMostDenseDofs = 10000;  // of --modes all: 2.5 GB, and half a CPU hour

}  // namespace

std::vector<SphereStiffness> sphere_stiffness(const AnalysisInput& input, const AnalysisOptions& options) {
  if (input.spheres_state) return by_link(*input.packing_3d, input.spheres_state->law);
  return by_link(*input.packing_3d, network_stiffness(*input.packing_3d, options.stiffness));
}

StiffRows stiff_rows(const AnalysisInput& input, const AnalysisOptions& options) {
  const NetworkLaw law = input.network_law(options);
  if (input.packing_3d) {
    const SphereNetwork network = input.spheres();
    RigidityMatrix g = in_contact_frames(network, rigidity_matrix(network, law, options.cell_free));
    std::vector<double> k = row_stiffness(g, sphere_stiffness(input, options));
    return {std::move(g), std::move(k)};
  }
  const LinkNetwork network = input.network();
  RigidityMatrix g = rigidity_matrix(network, law, options.cell_free);
  std::vector<double> k = row_stiffness(network, g, law_of(input, options));
  return {std::move(g), std::move(k)};
}

std::int64_t dof_count(const AnalysisInput& input, const AnalysisOptions& options) {
  const NetworkLaw law = input.network_law(options);
  return input.packing_3d ? dof_layout(input.spheres(), law, false).size()
                          : dof_layout(input.network(), law, false).size();
}

int mode_count(const AnalysisInput& input, const AnalysisOptions& options) {
  if (options.modes) return *options.modes;
  const std::int64_t dofs = dof_count(input, options);
  if (dofs > kMostDenseDofs)
    throw InputError(input.path, 0, "--modes", "all",
                     "is for at most " + std::to_string(kMostDenseDofs) + " degrees of freedom, and here are " +
                         std::to_string(dofs) + "; ask for a number of modes, or for --density-of-states");
  return kAllModes;
}

VibrationModes modes_of(const AnalysisInput& input, const AnalysisOptions& options, int count, bool displacements) {
  const NetworkLaw law = input.network_law(options);
  if (input.packing_3d)
    return vibration_modes(input.spheres(), law, sphere_stiffness(input, options), count, displacements);
  return vibration_modes(input.network(), law, law_of(input, options), count, displacements);
}

}  // namespace isostat
