// Grains of triangles in their frame: how their triangles, seams and outlines come onto the page.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "analysis/figure/picture_pen.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// [cm] of a circle of the grain's area, one a grain.
std::vector<double> grain_diameters(const TrianglePacking& packing);

// Corners of the inside of a container; offset: of its origin against where it was built.
struct Room {
  Vec2 low, high;
};
std::optional<Room> room_of(const ContainerScene& container, const Vec2& offset = {});

// Around the grains, walls made of grains and the room; a long smooth wall shows as a strip and is cut where it leads
// away. `margin` as for disks. Throws std::invalid_argument for a packing without grains.
Extent extent_of(const TrianglePacking& packing, const std::optional<Room>& room = std::nullopt, double margin = 0);

class TrianglePen : public FramePen {
 public:
  // Keeps a reference to the packing.
  TrianglePen(const TrianglePacking& packing, const PictureFrame& frame);

  const TrianglePacking& packing() const { return packing_; }
  const std::vector<std::int32_t>& grain() const { return grain_; }  // of each triangle
  GrainPart part(std::size_t triangle) const;

  // Groups "walls" and "grains". style[k] is the index of the paint of triangle k of a free grain; walls have a paint
  // of their own, lids none, but a dashed outline. An edge along a beam is a seam; the others are the strong outline of
  // the grain: where a beam has broken, too.
  void grains(Canvas& canvas, const std::vector<std::size_t>& style, const std::vector<Paint>& paints) const;
  // The fill, and seams of its shade.
  Paint paint(const Color& fill) const;

 private:
  std::vector<Bar> outlines(GrainPart part, double width) const;

  const TrianglePacking& packing_;
  std::vector<std::int32_t> grain_;
  std::vector<Polygon> triangle_;          // [cm]
  std::vector<std::array<bool, 3>> seam_;  // edge n of a triangle, from its corner n
};

}  // namespace isostat
