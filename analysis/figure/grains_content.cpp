#include <algorithm>

#include "analysis/figure/picture_content.hpp"

namespace isostat {
namespace {

class GrainsContent final : public PictureContent {
 public:
  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("disks");
    const Stroke outline{kGrainOutline, pen.outline(kGrainOutline).width, {}};
    pen.disks(canvas, std::vector<std::size_t>(pen.packing().bodies.size(), 0), {Paint{kGrain, outline}});
    canvas.end_group();
    canvas.begin_group("links");
    const double width = std::clamp(0.06 * pen.diameter(), 0.2, 2.0);
    std::vector<DrawnLink> closed, distant, beams;
    for (const Link<2>& link : pen.packing().links)
      (is_contact(link.kind)         ? closed
       : link.kind == LinkKind::beam ? beams
                                     : distant)
          .push_back({&link, link.kind == LinkKind::beam ? 2 * width : width});
    pen.links(canvas, beams, kBeam);
    pen.links(canvas, distant, kDistant);
    pen.links(canvas, closed, kInk);
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override {
    bool closed = false, distant = false, beams = false;
    for (const Link<2>& link : pen.packing().links)
      (is_contact(link.kind) ? closed : link.kind == LinkKind::beam ? beams : distant) = true;
    std::vector<LegendItem> items;
    if (closed && (distant || beams)) items.push_back(line_item(em, kInk, plain("contact")));
    if (distant) items.push_back(line_item(em, kDistant, plain("distant")));
    if (beams) items.push_back(line_item(em, kBeam, plain("beam")));
    return items;
  }
};

}  // namespace

std::unique_ptr<PictureContent> grains_content() { return std::make_unique<GrainsContent>(); }

}  // namespace isostat
