// Pairs of triangles for tests and benchmarks of overlaps: from random ones to those that rounding cannot tell apart.
#pragma once
#include <random>
#include <string_view>

#include "geometry/triangle_signs.hpp"

namespace isostat::oracle {

struct TrianglePair {
  Triangle a, b;
};

enum class PairKind {
  random,     // corners in the unit square
  shallow,    // a corner a little way into an edge, as in a settled bed: 1e-1 to 1e-12 of the side
  lattice,    // integer corners up to 4
  shared,     // a corner or an edge in common
  on_edge,    // a corner of one on an edge of the other, as near as rounding allows
  collinear,  // an edge of each on one line
  nested,     // one inside the other, some with a corner or edge on the outer one's
  identical,  // the same triangle twice
  sliver,     // long and thin
  flat,       // one of the two without area
};
inline constexpr PairKind kPairKinds[] = {
    PairKind::random,    PairKind::shallow, PairKind::lattice,   PairKind::shared, PairKind::on_edge,
    PairKind::collinear, PairKind::nested,  PairKind::identical, PairKind::sliver, PairKind::flat};
std::string_view name(PairKind kind);

// `nudge`: each coordinate moves by at most so many units in the last place. Corners in either orientation.
TrianglePair triangle_pair(PairKind kind, int nudge, std::mt19937_64& random);

// Equilateral-like triangles of unit circumradius with a corner `depth` inside an edge of the other (negative:
// outside), anticlockwise.
TrianglePair corner_into_edge(double depth, std::mt19937_64& random);

// Both moved by (x, y), all corners rounded.
TrianglePair moved(const TrianglePair& p, double x, double y);
// Multiplied by 2^exponent.
TrianglePair scaled(const TrianglePair& p, int exponent);
Triangle anticlockwise(Triangle t);

}  // namespace isostat::oracle
