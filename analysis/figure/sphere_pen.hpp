// A packing of spheres seen from one side: where its spheres and links are on the page and how deep, and the painter's
// order, far before near. Of disjoint spheres whose pictures overlap, the one whose centre is nearer hides the other,
// whatever their radii: along any line of sight both intersections are centred at the depth of the centre.
#pragma once
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "analysis/figure/canvas.hpp"
#include "analysis/figure/picture_pen.hpp"
#include "analysis/figure/view.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

// What is paler for being far; the same in all pictures of a series.
struct DepthRange {
  double far = 0, near = 0;  // [length]
};

struct SphereView {
  View view;
  DepthRange range;
};

// Of centres: of the cell, else of the spheres themselves.
DepthRange depth_range(const SpherePacking& packing, const View& view);
DepthRange around(const DepthRange& a, const DepthRange& b);

// Places in a picture count from the middle of the cell, so that cells of a series are concentric; without a cell from
// the packing's own origin.
Vec3 middle_of(const SpherePacking& packing);

// Half of the edge k of a cell, and half of how far the cell reaches along a direction (a unit vector).
Vec3 half_edge(const PeriodicCell<3>& cell, int k);
double half_reach(const PeriodicCell<3>& cell, const Vec3& along);

// Window around the cell, the spheres as they stick out of it, and the walls.
Extent extent_of(const SpherePacking& packing, const View& view, double margin = 0);

class SpherePen : public FramePen {
 public:
  static constexpr int kLevels = 12;  // of depth, each of one shade

  // Keeps a reference to the packing.
  SpherePen(const SpherePacking& packing, const PictureFrame& frame, const SphereView& seen);

  const SpherePacking& packing() const { return packing_; }
  const View& view() const { return seen_.view; }
  double largest_diameter() const { return largest_diameter_; }            // [length] a
  double points(double length) const { return length * frame().scale(); }  // [pt]

  const Vec3& place(std::size_t body) const { return place_[body]; }  // in the cell
  Vec2 page(const Vec3& place) const { return frame().page(view().flat(place)); }
  int level(const Vec3& place) const;  // 0 far, kLevels - 1 near
  static Color faded(const Color& color, int level, double most_white);

  // Bodies by level, far before near within each.
  std::vector<std::vector<std::size_t>> layers() const;
  // In the order given; style[i] is the index of body i's colour.
  void balls(Canvas& canvas, std::span<const std::size_t> bodies, const std::vector<std::size_t>& style,
             const std::vector<Color>& colors) const;

  // From centre to centre; a link that leaves the cell as two pieces, each from its centre to the contact point.
  std::vector<std::pair<Vec3, Vec3>> pieces(const Link<3>& link) const;
  // From the centre to the foot on the wall.
  std::pair<Vec3, Vec3> piece(const WallLink& link) const;

 private:
  const SpherePacking& packing_;
  SphereView seen_;
  std::vector<Vec3> place_;
  double largest_diameter_ = 0;
};

}  // namespace isostat
