// A plane section of spheres, drawn as disks are; walls are the lines and circles in which the plane cuts them.
#pragma once
#include <memory>
#include <vector>

#include "analysis/figure/picture_subject.hpp"
#include "analysis/figure/sphere_slice.hpp"

namespace isostat {

class SliceSubject final : public PictureSubject {
 public:
  // content: of `sliced.packing`, which is cut from the packing and may be empty. title: in the legend.
  SliceSubject(const SpherePacking& packing, const Slice& slice, SlicedSpheres sliced,
               std::unique_ptr<PictureContent> content, RichText title);
  Extent extent() const override { return extent_; }
  void draw(Canvas& canvas, const PictureFrame& frame) const override;
  std::vector<LegendItem> legend(const PictureFrame& frame, double em) const override;

 private:
  Slice slice_;
  std::vector<SphereWall> walls_;
  SlicedSpheres sliced_;
  std::unique_ptr<PictureContent> content_;
  RichText title_;
  Extent extent_;  // of the whole packing, so that slices of one packing have one scale
};

}  // namespace isostat
