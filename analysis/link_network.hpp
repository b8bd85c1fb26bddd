// What G is made of: bodies and links of a packing, and for grains of triangles the overlaps, each a link that touches
// every triangle it clips. A view; a packing of disks is one by itself.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/state/packing.hpp"
#include "dem/triangles/triangles.hpp"
#include "geometry/overlap_boundary.hpp"
#include "geometry/triangle_signs.hpp"

namespace isostat {

// Two triangles of an overlap, and which edges bound what they have in common.
struct AreaPair {
  std::int32_t i = 0, j = 0;  // bodies
  ImageShift<2> shift{};      // of j
  OverlapBoundary boundary;
};

// An overlap of two grains. As a link its velocity is the rate at which the area A shrinks, its force the pressure p.
struct AreaLink {
  std::vector<AreaPair> pairs;
  std::int32_t grain_i = 0, grain_j = 0;
  ImageShift<2> shift{};                                  // of grain j
  double area = 0;                                        // A [cm^2]
  double stiffness = 0;                                   // Y / L_c: dp = -stiffness dA
  double pressure = 0;                                    // p = Y A / L_c [dyn/cm]
  double tangential_force = 0, tangential_stiffness = 0;  // of friction
};

struct LinkNetwork {
  const Packing<2>& packing;            // the free bodies first; links (of triangles: beams alone)
  std::int32_t free = 0;                // bodies from here on are held: they have no columns
  std::span<const AreaLink> areas;      // link l of G, l >= packing.links.size(), is area l - packing.links.size()
  std::span<const Triangle> corners;    // of the bodies
  std::span<const std::int32_t> grain;  // of the bodies

  // Implicit: every packing of disks is a network. With walls in it, put_free_first() comes before.
  LinkNetwork(const Packing<2>& p);
  LinkNetwork(const Packing<2>& p, std::int32_t free_bodies, std::span<const AreaLink> overlaps,
              std::span<const Triangle> triangles, std::span<const std::int32_t> grains)
      : packing(p), free(free_bodies), areas(overlaps), corners(triangles), grain(grains) {}

  bool of_triangles() const { return !corners.empty(); }
  bool is_free(std::int32_t body) const { return body < free; }
  bool any_held() const { return static_cast<std::size_t>(free) < packing.bodies.size(); }
  std::size_t links() const { return packing.links.size() + areas.size(); }
  bool is_area(std::size_t link) const { return link >= packing.links.size(); }
  const AreaLink& area(std::size_t link) const { return areas[link - packing.links.size()]; }
  // f(i, j, shift of j) for the bodies of a link; of an overlap for each pair of triangles.
  template <class F>
  void each_bond(std::size_t link, F&& f) const {
    if (!is_area(link)) return f(packing.links[link].i, packing.links[link].j, packing.links[link].shift);
    for (const AreaPair& p : area(link).pairs) f(p.i, p.j, p.shift);
  }
};

// Walls and lids become the last bodies; else the order stays.
void put_free_first(Packing<2>& packing);

// A network with the memory behind it.
struct OwnedNetwork {
  Packing<2> packing;
  std::int32_t free = 0;
  std::vector<AreaLink> areas;
  std::vector<Triangle> corners;
  std::vector<std::int32_t> grain;  // of each body: index into Grains

  LinkNetwork view() const { return {packing, free, areas, corners, grain}; }
};

// Bodies are the triangles in the order of the state, free ones first. corners: of each triangle, anticlockwise. Two
// grains with one Overlap in the packing are one link, whatever the pieces of their overlap (the law sums over them);
// with as many as there are connected pieces, each is a link (a network). Forces of overlaps by the law
// `overlap-energy` from the area as it is, of springs as the state has them.
OwnedNetwork triangle_network(const TrianglePacking& packing, const std::vector<Triangle>& corners,
                              const TriangleLaw& law);

}  // namespace isostat
