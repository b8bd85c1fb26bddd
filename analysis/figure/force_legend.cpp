#include "analysis/figure/force_legend.hpp"

#include <algorithm>

#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

// The threshold is in the force unit of the packing: F1 by name only where F1 is that unit.
RichText below(const ForceOptions& options, double threshold) {
  return rich("|`F`| < ") + number_with_unit(threshold, options.scale == 1 ? options.scale_label : RichText{});
}

// A bar not thicker than the text is high, for a round part of F1 (or a round number where F1 has no name).
LegendItem scale_bar(const ForceOptions& options, double width_of_scale, double em) {
  const double most = std::min(1.0, em / width_of_scale);
  const bool named = !options.scale_label.empty();
  const double fraction = most < 1 ? nice_below(most) : 1;
  const double force = named ? fraction * options.scale : nice_below(most * options.scale);
  const RichText value = !named          ? number_text(force)
                         : fraction == 1 ? options.scale_label
                                         : number_with_unit(fraction, options.scale_label);
  const char* measure = options.convention.width == ForceMeasure::total ? "|`F`| = " : "|`N`| = ";
  return force_scale_item(width_of_scale * force / options.scale, em, rich(measure) + value);
}

}  // namespace

std::vector<LegendItem> force_legend(const ForceOptions& options, const ForceMarks& marks, double width_of_scale,
                                     double em) {
  const auto& threshold = options.convention.threshold;
  std::vector<LegendItem> items;
  if (marks.color[0]) items.push_back(line_item(em, kCompressive, plain("compressive")));
  if (marks.color[1]) items.push_back(line_item(em, kTensile, plain("tensile")));
  if (marks.color[2])
    items.push_back(line_item(em, kDistant, threshold ? below(options, *threshold) : plain("distant")));
  const Stroke outline{kDiskOutline, 0.5, {}};
  if (marks.shade[1]) items.push_back(disk_item(em, {kRattler, outline}, plain("rattler")));
  if (marks.shade[2]) items.push_back(disk_item(em, {kUnstressed, outline}, plain("unstressed")));
  items.push_back(scale_bar(options, width_of_scale, em));
  return items;
}

}  // namespace isostat
