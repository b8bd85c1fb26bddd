// What `isostat analyze` works on: a packing, the law it may bring, and the options of the command line.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/link_network.hpp"
#include "analysis/network/force_measure.hpp"
#include "analysis/sphere_network.hpp"
#include "analysis/stiffness/density_options.hpp"
#include "analysis/structure/fit_constant.hpp"
#include "dem/disks/disks.hpp"
#include "dem/spheres/spheres.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

enum class NetworkLaw { frictionless, friction, rolling };  // which rows a link contributes to G

inline constexpr std::array<std::string_view, 3> kNetworkLawNames{"frictionless", "friction", "rolling"};
constexpr std::string_view name_of(NetworkLaw law) { return kNetworkLawNames[static_cast<std::size_t>(law)]; }
std::optional<NetworkLaw> network_law_named(std::string_view name);  // none: no such law

struct AnalysisOptions {
  std::optional<NetworkLaw> law;           // --law; none: the state's own law (a network: friction)
  bool cell_free = false;                  // --cell free: add the diagonal strain dofs
  std::optional<double> gap_tolerance;     // --gap-tolerance [length of the input]
  std::optional<std::vector<double>> box;  // --box: edges of the cell of a file that has none
  bool prestress = false;                  // --prestress: modes of the full tangent, too
  bool near_null = false;                  // --near-null: near-null singular values of G whatever its size
  int most_vectors = 20;                   // --vectors: of each basis of the section bases
  std::optional<int> modes = 20;           // --modes: lowest vibration modes; 0: not asked for; none: all
  std::optional<DensityOptions> density;   // --density-of-states; none: not asked for
  std::optional<double> bin_width;         // --bins [F1; of N_over_mean the mean]: of histograms; none: 0.02, and 0.1
  std::vector<double> stiffness;           // --stiffness: K_N, K_T, K_R of a packing without a law, as given
  double k_max = 0;                        // --k-max [1/length]; 0: the section's default
  using Window = std::optional<std::array<double, 2>>;
  Window k_window;                                   // --k-window [1/length]: of the fits of I(k); none: the default
  Window r_window;                                   // --r-window [length]: of the fits of C(r) and M(r)
  Window pore_window;                                // --pore-window [length]: of the exponent of pore sizes
  FitConstant fit_constant = FitConstant::free;      // --fit-constant: of Eq. 28
  bool window_scan = false;                          // --window-scan: fits of I(k) and C(r) in other windows, too
  std::optional<double> pore_size;                   // --pore-size [length]: what a small pore is; none: a
  std::optional<double> threshold;                   // --threshold [force]: what a stressed link bears; none: F1/100
  ForceMeasure force_measure = ForceMeasure::total;  // --force: of what the threshold is
  std::function<void(std::string_view)> begins{};    // hears the name of each section that is about to be computed
};

struct AnalysisInput {
  std::string path;
  State<Disks> state;  // a network or foreign packing is a state without law; walls last (put_free_first)
  std::optional<SpherePacking> packing_3d;  // a packing in space; `state` then has no grains
  std::optional<State<Spheres>>
      spheres_state;         // that it comes from: law and walls, its bodies and links are moved out. None: no law
  bool links_given = false;  // the file lists contacts (a state always does); false: found by touching
  std::optional<double> touching_tolerance;  // gap up to which contacts were found [length]; none: not by touching
  std::optional<State<TriangleGrains>> triangles;  // a packing of triangles; `state` then has no grains
  OwnedNetwork triangle_links;                     // of its triangles, see set_triangles()

  void set_triangles(State<TriangleGrains> of_grains, const std::vector<Triangle>& corners);

  // Of disks; of triangles: the triangles and their beams, free ones first.
  const Packing<2>& packing() const { return triangles ? triangle_links.packing : state.packing; }
  SphereNetwork spheres() const { return *packing_3d; }
  LinkNetwork network() const { return triangles ? triangle_links.view() : LinkNetwork(state.packing); }
  // It knows its law. Disks: it comes from a run of the solver and is in reduced units; false for a foreign packing
  // kept as .h5. Triangles always do, a network that of triangle_network_law().
  bool has_law() const {
    if (packing_3d) return spheres_state.has_value();
    return triangles ? triangles->law.modulus > 0 : state.law.normal_stiffness > 0;
  }
  bool has_cell() const { return packing_3d ? packing_3d->cell.has_value() : packing().cell.has_value(); }
  std::size_t grains() const {
    return packing_3d ? count_free(*packing_3d) : triangles ? triangles->packing.grains.size() : count_free(packing());
  }
  NetworkLaw network_law(const AnalysisOptions& options) const;
};

}  // namespace isostat
