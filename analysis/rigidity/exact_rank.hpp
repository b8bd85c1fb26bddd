// H and K of a packing as integers, without a tolerance (Gilabert 2007, Appendix A: N_f + H = M + K).
//
// 1. Contraction to rigid bodies, exact.              (rigid_bodies.hpp)
// 2. Removal of dangling bodies, exact.               (body_network.hpp)
// 3. Rank of what is left modulo 2^52 - 47.           (modular_ldlt.hpp)   K_true <= K, as rank mod p <= rank
// 4. The same rank for random positions and radii
//    on the same topology, modulo 2^52 - 143.         K_generic <= K_true: special positions only lower a rank
// 5. Where the two differ, 3 again modulo 2^52 - 143.
//
// Random weights can hide a pivot, chance columns / p, and make K of one elimination too large; a wrong verdict needs
// two such accidents in different fields.
//
// The matrix meant is the exact one: coordinates are the rational numbers that the doubles are.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/input.hpp"
#include "analysis/sphere_network.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct RankTimings {
  double contraction = 0, assembly = 0, ordering = 0, elimination = 0;  // [s] wall clock
};

struct ExactRank {
  std::int64_t dofs = 0, rows = 0, rank = 0;  // N_f, M
  std::int64_t hyperstatic = 0, floppy = 0;   // H, K
  std::int64_t trivial = 0;                   // motions of the whole that no geometry can hinder
  std::int64_t rattler_modes = 0;             // of grains without any link
  std::int64_t mechanisms = 0;                // K - trivial - rattler modes
  // Certificate.
  std::int64_t floppy_generic = 0;    // lower bound of K
  std::vector<std::uint64_t> primes;  // that gave `floppy` for the actual positions
  bool certified = false;             // bounds meet, or two primes agree
  bool bounds_meet = false;           // K_generic = K: proved from both sides
  std::int64_t gear_modes = 0;        // bipartite components with a loop: R_i w_i = +-c (1 each, in space 3, part of K)
  std::int64_t bodies = 0;            // after contraction
  std::int64_t eliminated_columns = 0;  // of step 3
  RankTimings timings;
};

// Throws InputError if cell_free is asked for without a cell.
ExactRank exact_rank(const LinkNetwork& network, NetworkLaw law, bool cell_free);
ExactRank exact_rank(const SphereNetwork& network, NetworkLaw law, bool cell_free);

// Components of the graph of tangential rows that are bipartite and hold a loop: their disks can turn like gears,
// R_i w_i = +c on one side and -c on the other, whatever the positions (proportional lever arms); in space c is a
// vector: three null vectors each. Each is a list of grains. Empty for frictionless networks; a component with a moment
// row inside is none.
std::vector<std::vector<std::int32_t>> gear_components(const LinkNetwork& network, NetworkLaw law);
std::vector<std::vector<std::int32_t>> gear_components(const SphereNetwork& network, NetworkLaw law);

}  // namespace isostat
