// A packing of any system with what is shown of it: what a picture, or a series of them, is made of.
#pragma once
#include <memory>
#include <vector>

#include "analysis/figure/picture_content.hpp"
#include "analysis/figure/wall_lines.hpp"

namespace isostat {

class PictureSubject {
 public:
  virtual ~PictureSubject() = default;
  virtual Extent extent() const = 0;
  virtual void draw(Canvas& canvas, const PictureFrame& frame) const = 0;
  virtual std::vector<LegendItem> legend(const PictureFrame& frame, double em) const = 0;
};

// Keeps a reference to the packing. Smooth walls stand around it.
class DiskSubject final : public PictureSubject {
 public:
  DiskSubject(const Packing<2>& packing, std::unique_ptr<PictureContent> content, std::vector<SmoothWall> walls = {})
      : packing_(packing), content_(std::move(content)), walls_(std::move(walls)) {}
  Extent extent() const override { return with_walls(extent_of(packing_, content_->margin(packing_)), walls_); }
  void draw(Canvas& canvas, const PictureFrame& frame) const override {
    draw_walls(canvas, FramePen(frame), walls_);
    content_->draw(canvas, PicturePen(packing_, frame));
  }
  std::vector<LegendItem> legend(const PictureFrame& frame, double em) const override {
    return content_->legend(PicturePen(packing_, frame), em);
  }

 private:
  const Packing<2>& packing_;
  std::unique_ptr<PictureContent> content_;
  std::vector<SmoothWall> walls_;
};

}  // namespace isostat
