#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/figure/cluster_colors.hpp"
#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/picture_content.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Grains in the pale colour of their cluster, so that the forces on top are seen.
class StressedContent final : public PictureContent {
 public:
  explicit StressedContent(StressedOptions options) : options_(std::move(options)) {}

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    const std::vector<Link<2>>& links = pen.packing().links;
    std::vector<std::array<std::int32_t, 2>> meet;
    for (const Link<2>& link : links) meet.push_back({options_.of_grain[idx(link.i)], options_.of_grain[idx(link.j)]});
    const std::vector<std::size_t> color = cluster_colors(options_.clusters, meet);
    std::vector<Paint> paints;
    for (const Color& fill : cluster_fills()) paints.push_back({fill, pen.outline(kDiskOutline)});
    std::vector<std::size_t> style;
    for (const std::int32_t c : options_.of_grain) style.push_back(c < 0 ? 0 : cluster_fill(color[idx(c)], false));
    canvas.begin_group("disks");
    pen.disks(canvas, style, paints);
    canvas.end_group();

    std::vector<DrawnLink> quiet;
    std::array<std::vector<DrawnLink>, 2> stressed;
    for (std::size_t l = 0; l < links.size(); ++l) {
      if (options_.of_link[l] < 0)
        quiet.push_back({&links[l], std::min(0.05 * pen.diameter(), 0.6)});
      else
        stressed[links[l].normal_force < 0].push_back(
            {&links[l], width_of(drawn_force(links[l], {options_.width, {}}), pen)});
    }
    canvas.begin_group("links");
    pen.links(canvas, quiet, kFaint);
    for (auto& of_sign : stressed)
      std::stable_sort(of_sign.begin(), of_sign.end(), [](const auto& a, const auto& b) { return a.width < b.width; });
    pen.links(canvas, stressed[1], kTensile);
    pen.links(canvas, stressed[0], kCompressive);
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override {
    bool compressed = false, stretched = false, quiet = false;
    for (std::size_t l = 0; l < pen.packing().links.size(); ++l)
      (options_.of_link[l] < 0 ? quiet : pen.packing().links[l].normal_force < 0 ? stretched : compressed) = true;
    std::vector<LegendItem> items;
    const Stroke outline{kDiskOutline, 0.5, {}};
    if (options_.clusters > 0)
      items.push_back(disk_item(em, {cluster_fills()[cluster_fill(0, false)], outline}, plain("stressed cluster")));
    if (compressed) items.push_back(line_item(em, kCompressive, plain("compressive")));
    if (stretched) items.push_back(line_item(em, kTensile, plain("tensile")));
    if (quiet) items.push_back(line_item(em, kFaint, options_.below));
    if (options_.clusters > 0)
      items.push_back(
          force_scale_item(width_of(options_.scale, pen), em,
                           options_.scale_label.empty() ? number_text(options_.scale) : options_.scale_label));
    return items;
  }

 private:
  double width_of(double force, const PicturePen& pen) const {  // [pt]
    return options_.width_at_scale * pen.largest_diameter() * pen.frame().scale() * force / options_.scale;
  }
  StressedOptions options_;
};

// Links by why they can bear a force.
class LoopsContent final : public PictureContent {
 public:
  explicit LoopsContent(std::vector<LinkClass> classes) : classes_(std::move(classes)) {}

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("disks");
    pen.disks(canvas, std::vector<std::size_t>(pen.packing().bodies.size(), 0), {{kDisk, pen.outline(kDiskOutline)}});
    canvas.end_group();
    canvas.begin_group("links");
    for (const auto& mark : kMarks) {
      std::vector<DrawnLink> drawn;
      for (std::size_t l = 0; l < classes_.size(); ++l)
        if (classes_[l] == mark.which)
          drawn.push_back({&pen.packing().links[l], std::clamp(mark.width * pen.diameter(), 0.4, 6.0)});
      pen.links(canvas, drawn, mark.color);
    }
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen&, double em) const override {
    std::vector<LegendItem> items;
    for (const auto& mark : kMarks)
      if (std::find(classes_.begin(), classes_.end(), mark.which) != classes_.end())
        items.push_back(line_item(em, mark.color, plain(mark.label)));
    return items;
  }

 private:
  struct Mark {
    LinkClass which;
    Color color;
    double width;  // [mean diameter]
    const char* label;
  };
  static constexpr std::array<Mark, 3> kMarks{{{LinkClass::tree, kFaint, 0.09, "on no loop"},
                                               {LinkClass::loop, kCurves[0], 0.16, "on a loop: by moments"},
                                               {LinkClass::cluster, kCurves[1], 0.22, "self-stressed by forces"}}};
  std::vector<LinkClass> classes_;
};

}  // namespace

std::unique_ptr<PictureContent> stressed_content(StressedOptions options) {
  return std::make_unique<StressedContent>(std::move(options));
}

std::unique_ptr<PictureContent> loops_content(std::vector<LinkClass> classes) {
  return std::make_unique<LoopsContent>(std::move(classes));
}

}  // namespace isostat
