#include "analysis/figure/picture_content.hpp"

namespace isostat {
namespace {

class MotionContent final : public PictureContent {
 public:
  explicit MotionContent(MotionOptions options) : marks_(std::move(options)) {}

  double margin(const Packing<2>& packing) const override { return marks_.margin(extent_of(packing).diameter); }

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("disks");
    pen.disks(canvas, marks_.styles(), marks_.paints(pen.outline(kDiskOutline)));
    canvas.end_group();
    marks_.draw_arrows(canvas, pen, pen.packing().bodies.position);
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override { return marks_.legend(pen, em); }

 private:
  MotionMarks marks_;
};

}  // namespace

std::unique_ptr<PictureContent> motion_content(MotionOptions options) {
  return std::make_unique<MotionContent>(std::move(options));
}

}  // namespace isostat
