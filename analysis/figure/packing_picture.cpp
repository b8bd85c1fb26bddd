#include "analysis/figure/packing_picture.hpp"

#include <algorithm>

#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

constexpr double kMargin = 12;                                               // [pt] around the page
constexpr double kSmallestPage = 360;                                        // [pt] room for the legend
constexpr double kPagePerText = 62, kSmallestText = 8.5, kLargestText = 20;  // [-], [pt], [pt]
constexpr double kBar = 0.16, kSmallestBar = 36;                             // [page width], [pt] length scale

}  // namespace

PackingPicture::PackingPicture(const Packing<2>& packing, std::unique_ptr<PictureContent> content,
                               const RichText& length_unit)
    : content_(std::move(content)), pen_(packing, content_->margin(packing)) {
  PictureFrame& frame = pen_.frame();
  const Rect box = frame.box();
  const double text = std::clamp(std::max(box.width, box.height) / kPagePerText, kSmallestText, kLargestText);
  const double width = std::max(box.width, kSmallestPage);
  frame.place({{kMargin + (width - box.width) / 2, kMargin}});
  std::vector<LegendItem> items = content_->legend(pen_, text);
  const double bar = nice_below(std::max(kBar * box.width, kSmallestBar) / frame.scale());
  items.push_back(length_scale_item(bar * frame.scale(), number_with_unit(bar, length_unit)));
  legend_.emplace(std::move(items), text, width);
  legend_place_ = {{kMargin, kMargin + box.height + 0.5 * text}};
  size_ = {{width + 2 * kMargin, legend_place_[1] + legend_->height() + 0.5 * kMargin}};
}

void PackingPicture::draw(Canvas& canvas) const {
  const PictureFrame& frame = pen_.frame();
  if (frame.periodic()) canvas.clip(frame.box());
  content_->draw(canvas, pen_);
  if (frame.periodic()) {
    canvas.unclip();
    canvas.begin_group("cell");
    canvas.rectangle(frame.box(), {std::nullopt, Stroke{kInk, 0.9, {}}});
    canvas.end_group();
  }
  canvas.begin_group("legend");
  legend_->draw(canvas, legend_place_);
  canvas.end_group();
}

}  // namespace isostat
