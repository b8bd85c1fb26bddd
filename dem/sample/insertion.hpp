// Modified hierarchical insertion (seed 000, Sec. 3, after Aste 1996): radii are listed up to beta times the volume of
// the room; largest first, each is tried at I random points and put where it overlaps nothing; in the same order each
// grain inside then grows until it touches its nearest neighbour.
//
// The points that must fail are not drawn, only counted: if a share p of the room is still open to a centre, the number
// of random points up to the first one in it is geometric. The packings have the distribution of the blind method,
// exactly.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/sample/enclosure.hpp"
#include "dem/sample/insertion_scene.hpp"
#include "dem/solver/random.hpp"

namespace isostat {

struct InsertionWork {
  double blind_trials = 0;            // random points of the room that the result stands for
  std::uint64_t points = 0;           // drawn
  std::size_t cells = 0, listed = 0;  // most cells at a time; radii
};

template <int D>
struct InsertedGrains {
  Enclosure<D> enclosure;
  std::vector<Vec<D>> position;      // [length] in the shell around the origin, or in [0, L)
  std::vector<double> radius;        // [length] grown, at most radius_max
  std::vector<double> drawn_radius;  // before growth, descending
  std::vector<std::uint8_t> soft;    // 1 of a soft-particle; empty: none was asked for
  double solid_fraction = 0;         // volume of the grains over that of the room
  double trials = 0;                 // I; with a wanted solid fraction the one that was found
  bool reached = true;               // the wanted solid fraction, to the last grain
  InsertionWork work;
};

// Radii of the law until their volume exceeds beta times `measure`, soft-particles' share left to them, descending.
std::vector<double> listed_radii(const InsertionScene& scene, int dimension, double measure, Random& random);

template <int D>
Enclosure<D> enclosure_of(const InsertionScene& scene);

// A pure function of scene and seed. A wanted solid fraction chooses the smallest I, to two per cent, that reaches it,
// and leaves out the last, smallest grains that are not needed; if a million trials each do not reach it, the packing
// is what they gave and `reached` is false (raise volume_factor, or the ratio of radii). Throws InputError with all
// broken rules.
template <int D>
InsertedGrains<D> insert_grains(const InsertionScene& scene, std::uint64_t seed);

}  // namespace isostat
