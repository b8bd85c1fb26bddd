// The packing in its frame, and how disks, links and areas of it come onto the page: every image that shows in the
// cell.
#pragma once
#include <utility>
#include <vector>

#include "analysis/figure/canvas.hpp"
#include "analysis/figure/picture_frame.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct Bar {
  Vec2 from, to;  // [length of the packing] in any image
  double width;   // [pt]
};

// What packings of all systems have in common.
class FramePen {
 public:
  explicit FramePen(const PictureFrame& frame) : frame_(frame) {}

  const PictureFrame& frame() const { return frame_; }
  double diameter() const { return frame_.mean_diameter() * frame_.scale(); }  // [pt] mean
  Stroke outline(const Color& color) const;  // of grains; faint if they are small, or it would be all that one sees

  void bars(Canvas& canvas, const std::vector<Bar>& bars, const Color& color) const;
  // Corners in the packing's coordinates, in any image.
  void areas(Canvas& canvas, const std::vector<const Polygon*>& areas, const Paint& paint) const;

 private:
  PictureFrame frame_;
};

struct DrawnLink {
  const Link<2>* link;
  double width;  // [pt]
};

class PicturePen : public FramePen {
 public:
  // Keeps a reference to the packing.
  PicturePen(const Packing<2>& packing, const PictureFrame& frame);

  const Packing<2>& packing() const { return packing_; }
  double largest_diameter() const { return largest_diameter_; }  // [length] a

  // style[i] is the index of body i's paint. One batch a paint, in their order.
  void disks(Canvas& canvas, const std::vector<std::size_t>& style, const std::vector<Paint>& paints) const;
  void links(Canvas& canvas, const std::vector<DrawnLink>& links, const Color& color) const;

 private:
  const Packing<2>& packing_;
  double largest_diameter_ = 0;
};

// [pt] text: 0.05 a. The unit may be empty.
RichText number_with_unit(double x, const RichText& unit);

}  // namespace isostat
