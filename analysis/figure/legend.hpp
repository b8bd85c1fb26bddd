// A row (or rows) of symbols with their labels under a picture.
#pragma once
#include <functional>
#include <vector>

#include "analysis/figure/canvas.hpp"

namespace isostat {

struct LegendItem {
  double width = 0;                                            // [pt] of the symbol
  std::function<void(Canvas&, const Vec2& left)> draw_symbol;  // from the middle of its left edge
  RichText label;
};

// Symbols are sized by the text size em [pt].
LegendItem line_item(double em, const Color& color, RichText label);
LegendItem force_scale_item(double thickness, double em, RichText label);  // a bar as thick as a link of that force
LegendItem disk_item(double em, const Paint& paint, RichText label);
LegendItem ball_item(double em, const Color& color, RichText label);
LegendItem length_scale_item(double length, RichText label);  // |---|
LegendItem text_item(RichText label);
LegendItem color_bar_item(double em, std::function<Color(double)> map, RichText low, RichText high);

class Legend {
 public:
  Legend(std::vector<LegendItem> items, double text_size, double width);  // wraps to rows of that width [pt]
  double height() const { return rows_ * row_height(); }
  void draw(Canvas& canvas, const Vec2& top_left) const;

 private:
  double row_height() const { return 1.9 * size_; }
  struct Place {
    double x = 0;
    int row = 0;
  };
  std::vector<LegendItem> items_;
  std::vector<Place> places_;
  double size_;
  int rows_ = 0;
};

}  // namespace isostat
