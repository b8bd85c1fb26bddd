#include "analysis/figure/picture_series.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "analysis/figure/fading_canvas.hpp"
#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

constexpr double kMargin = 12;                                               // [pt] around the page
constexpr double kSmallestPage = 360;                                        // [pt] room for the legend
constexpr double kPagePerText = 62, kSmallestText = 8.5, kLargestText = 20;  // [-], [pt], [pt]
constexpr double kBar = 0.16, kSmallestBar = 36;                             // [page width], [pt] length scale
constexpr double kCaption = 1.7;                                             // [em] height of a caption's line
constexpr double kPalest = 0.85;                                             // part of white in the first of many

// Items that say the same, with symbols of the same size, stand once.
void add_new(std::vector<LegendItem>& items, std::vector<LegendItem> more) {
  for (LegendItem& item : more)
    if (std::none_of(items.begin(), items.end(),
                     [&](const LegendItem& i) { return i.label == item.label && i.width == item.width; }))
      items.push_back(std::move(item));
}

}  // namespace

PictureSeries::PictureSeries(std::vector<std::unique_ptr<PictureSubject>> subjects, const RichText& length_unit,
                             std::vector<RichText> captions, std::optional<Vec2> page)
    : subjects_(std::move(subjects)), captions_(std::move(captions)) {
  std::vector<Extent> extents;
  for (const auto& subject : subjects_) extents.push_back(subject->extent());
  Extent whole = extents.at(0);
  for (const Extent& e : extents) whole = around(whole, e);
  for (const Extent& e : extents) frames_.emplace_back(e, whole);

  if (page) {
    lay_out(length_unit, page);  // once to see how high the legend is
    const double beside = 2 * kMargin, above_and_below = around_;
    const Vec2 room = frames_[0].room();
    const double factor = std::min(((*page)[0] - beside) / room[0], ((*page)[1] - above_and_below) / room[1]);
    if (!(factor > 0)) throw std::invalid_argument("the page has no room beside the legend");
    for (PictureFrame& frame : frames_) frame.enlarge(factor);
  }
  lay_out(length_unit, page);
}

void PictureSeries::lay_out(const RichText& length_unit, const std::optional<Vec2>& page) {
  const Vec2 room = frames_[0].room();
  const double longer = page ? std::max((*page)[0], (*page)[1]) : std::max(room[0], room[1]);
  text_ = std::clamp(longer / kPagePerText, kSmallestText, kLargestText);
  const double width = page ? (*page)[0] - 2 * kMargin : std::max(room[0], kSmallestPage),
               top = kMargin + (captions_.empty() ? 0 : kCaption * text_);
  std::vector<LegendItem> items;
  for (std::size_t k = 0; k < subjects_.size(); ++k) {
    frames_[k].place({{kMargin + (width - room[0]) / 2, top}});
    add_new(items, subjects_[k]->legend(frames_[k], text_));
  }
  const double scale = frames_[0].scale(), bar = nice_below(std::max(kBar * room[0], kSmallestBar) / scale);
  items.push_back(length_scale_item(bar * scale, number_with_unit(bar, length_unit)));
  legend_.emplace(std::move(items), text_, width);
  legend_place_ = {{kMargin, top + room[1] + 0.5 * text_}};
  page_ = {{width + 2 * kMargin, legend_place_[1] + legend_->height() + 0.5 * kMargin}};
  around_ = page_[1] - room[1];
  if (!page) return;
  const double spare = std::max(0.0, (*page)[1] - page_[1]);  // a wide packing on a high page: in the middle of it
  for (std::size_t k = 0; k < subjects_.size(); ++k)
    frames_[k].place({{kMargin + (width - room[0]) / 2, top + 0.5 * spare}});
  legend_place_[1] += spare;
  page_ = *page;
}

namespace {

// What shows beyond its slanted edges is covered: the corners of a cell are lower left, lower right, and so round.
void draw_tilted(Canvas& canvas, const Polygon& cell, const Paint& edge) {
  const bool to_right = cell[3][0] > cell[0][0];
  const Vec2 &left_far = to_right ? cell[3] : cell[0], &right_far = to_right ? cell[1] : cell[2];
  const Vec2 left{{std::min(cell[0][0], cell[3][0]), left_far[1]}},
      right{{std::max(cell[1][0], cell[2][0]), right_far[1]}};
  const std::vector<Polygon> beyond{{cell[0], cell[3], left}, {cell[1], cell[2], right}};
  canvas.polygons(beyond, {kWhite, Stroke{kWhite, 0.9, {}}});
  canvas.polygons(std::vector<Polygon>{cell}, edge);
}

}  // namespace

void PictureSeries::draw_window(Canvas& canvas, std::size_t k) const {
  const PictureFrame& frame = frames_[k];
  if (frame.cuts()) canvas.clip(frame.box());
  subjects_[k]->draw(canvas, frame);
  if (frame.cuts()) canvas.unclip();
  if (!frame.periodic()) return;
  canvas.begin_group("cell");
  const Paint edge{std::nullopt, Stroke{kInk, 0.9, {}}};
  if (const auto cell = frame.tilted_cell())
    draw_tilted(canvas, *cell, edge);
  else
    canvas.rectangle(frame.box(), edge);
  canvas.end_group();
}

void PictureSeries::draw_packing(Canvas& canvas, std::size_t k) const {
  draw_window(canvas, k);
  if (captions_.empty()) return;
  canvas.begin_group("caption");
  canvas.text({{kMargin, kMargin + text_}}, captions_[k], {text_, Anchor::start, kInk, false});
  canvas.end_group();
}

void PictureSeries::draw_legend(Canvas& canvas) const {
  canvas.begin_group("legend");
  legend_->draw(canvas, legend_place_);
  canvas.end_group();
}

void PictureSeries::draw_stroboscopic(Canvas& canvas) const {
  const std::size_t last = subjects_.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    FadingCanvas pale(canvas, k == last ? 0 : kPalest * static_cast<double>(last - k) / static_cast<double>(last));
    draw_window(pale, k);
  }
  draw_legend(canvas);
}

}  // namespace isostat
