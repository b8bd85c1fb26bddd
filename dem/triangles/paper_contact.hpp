// The contact force of Poeschel and Buchholtz 1995, Sec. 3, for one pair of triangles: Young's modulus Y times an area,
// perpendicular to the chord between crossings of edges, at its midpoint H.
//
//   i        Y min(D, A - D), D the part that the edge of one triangle cuts off the other, of area A   (Eq. 21)
//   ii       Y times the sum of both such parts, each on its side of S1S2                             (Eq. 22)
//   iii      two forces Y/2 times the area of the overlap, on S1S2 and on S1S4                        (Eq. 23);
//            S1 is the corner from where they push the two apart most
//   iv, v    one force of type i for each edge that crosses the other triangle twice: three and six of them, where the
//            paper takes two and three without saying which; so none depends on which triangle is called A
// Torques are (H - G) x F (Eqs. 19, 20 print the arm with the other sign). A pair in special position (a corner on an
// edge) takes the limit of i and ii, Y times the area along its gradient; one triangle inside the other meets no force.
// These forces have no energy: PHYSICS of the law in docs/grains.md.
#pragma once
#include "geometry/triangle_signs.hpp"
#include "geometry/vec.hpp"

namespace isostat {

struct PaperContact {
  Vec2 on_a{};                        // [dyn] force on A, on B the opposite
  double moment_a = 0, moment_b = 0;  // [dyn cm] about the centroids
};
// Corners anticlockwise; modulus Y.
PaperContact paper_contact(const Triangle& a, const Triangle& b, double modulus);

}  // namespace isostat
