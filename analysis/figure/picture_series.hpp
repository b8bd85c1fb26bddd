// Pictures of several packings on pages of one size: one scale, one window that has room for all, one legend.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "analysis/figure/canvas.hpp"
#include "analysis/figure/legend.hpp"
#include "analysis/figure/picture_subject.hpp"

namespace isostat {

class PictureSeries {
 public:
  // length_unit: of the scale bar, may be empty. captions: one a picture, above its window, or none at all. page [pt]:
  // its size, whatever the packings; std::invalid_argument if the legend fills it. None: as the packings want it.
  explicit PictureSeries(std::vector<std::unique_ptr<PictureSubject>> subjects, const RichText& length_unit = {},
                         std::vector<RichText> captions = {}, std::optional<Vec2> page = std::nullopt);

  std::size_t size() const { return subjects_.size(); }
  Vec2 page() const { return page_; }  // [pt]

  // What differs from page to page, and what does not.
  void draw_packing(Canvas& canvas, std::size_t k) const;
  void draw_legend(Canvas& canvas) const;
  // All in one window, the last on top in full strength, the earlier the paler.
  void draw_stroboscopic(Canvas& canvas) const;

 private:
  void lay_out(const RichText& length_unit, const std::optional<Vec2>& page);
  void draw_window(Canvas& canvas, std::size_t k) const;

  std::vector<std::unique_ptr<PictureSubject>> subjects_;
  std::vector<PictureFrame> frames_;
  std::vector<RichText> captions_;
  std::optional<Legend> legend_;
  double text_ = 0, around_ = 0;  // [pt] of letters; height of what is above and below the window
  Vec2 legend_place_{}, page_{};
};

}  // namespace isostat
