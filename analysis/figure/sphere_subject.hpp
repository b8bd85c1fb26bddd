// A packing of spheres seen from one side, in its cell or between its walls.
#pragma once
#include <memory>
#include <vector>

#include "analysis/figure/picture_subject.hpp"
#include "analysis/figure/sphere_content.hpp"

namespace isostat {

class SphereSubject final : public PictureSubject {
 public:
  SphereSubject(SpherePacking packing, const SphereView& seen, std::unique_ptr<SphereContent> content)
      : packing_(std::move(packing)), seen_(seen), content_(std::move(content)) {}
  Extent extent() const override { return extent_of(packing_, seen_.view, content_->margin(packing_)); }
  void draw(Canvas& canvas, const PictureFrame& frame) const override;
  std::vector<LegendItem> legend(const PictureFrame& frame, double em) const override;

 private:
  SpherePacking packing_;
  SphereView seen_;
  std::unique_ptr<SphereContent> content_;
};

// Where x, y and z lead on the page; an axis along the line of sight is left out.
LegendItem axes_item(double em, const View& view);

}  // namespace isostat
