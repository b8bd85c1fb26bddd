// Picture of one packing of disks: its content in the frame of the cell, a legend and a length scale.
#pragma once
#include <memory>

#include "analysis/figure/picture_series.hpp"

namespace isostat {

class PackingPicture {
 public:
  // Keeps a reference to the packing. length_unit: of the scale bar, may be empty. Throws std::invalid_argument for a
  // packing without bodies.
  PackingPicture(const Packing<2>& packing, std::unique_ptr<PictureContent> content, const RichText& length_unit = {});
  Vec2 size() const { return series_->page(); }  // [pt] of the page
  void draw(Canvas& canvas) const {
    series_->draw_packing(canvas, 0);
    series_->draw_legend(canvas);
  }

 private:
  std::unique_ptr<PictureSeries> series_;
};

}  // namespace isostat
