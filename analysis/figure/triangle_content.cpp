#include "analysis/figure/triangle_content.hpp"

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

std::vector<LegendItem> parts_legend(const TrianglePen& pen, double em) {
  const std::vector<GrainPart>& part = pen.packing().grains.part;
  const auto has = [&](GrainPart p) { return std::find(part.begin(), part.end(), p) != part.end(); };
  std::vector<LegendItem> items;
  if (has(GrainPart::wall)) items.push_back(disk_item(em, {kWall, std::nullopt}, plain("wall")));
  if (has(GrainPart::lid))
    items.push_back(
        {2.2 * em,
         [=](Canvas& canvas, const Vec2& p) {
           canvas.polyline(std::array{p, p + Vec2{{2.2 * em, 0}}}, Stroke{kInk, 0.1 * em, {0.4 * em, 0.25 * em}});
         },
         plain("lid")});
  return items;
}

class TriangleGrainsContent final : public TriangleContent {
 public:
  void draw(Canvas& canvas, const TrianglePen& pen) const override {
    pen.grains(canvas, std::vector<std::size_t>(pen.packing().bodies.size(), 0), {pen.paint(kGrain)});
  }
  std::vector<LegendItem> legend(const TrianglePen& pen, double em) const override { return parts_legend(pen, em); }
};

class TriangleMotionContent final : public TriangleContent {
 public:
  TriangleMotionContent(std::vector<Vec2> centre, MotionOptions options)
      : centre_(std::move(centre)), marks_(std::move(options)) {}

  double margin(const TrianglePacking& packing) const override { return marks_.margin(extent_of(packing).diameter); }

  void draw(Canvas& canvas, const TrianglePen& pen) const override {
    const std::vector<std::size_t> of_grain = marks_.styles();
    std::vector<std::size_t> style;
    for (const std::int32_t g : pen.grain()) style.push_back(of_grain[idx(g)]);
    std::vector<Paint> paints = marks_.paints({});
    for (Paint& paint : paints) paint = pen.paint(*paint.fill);
    pen.grains(canvas, style, paints);
    marks_.draw_arrows(canvas, pen, centre_);
  }

  std::vector<LegendItem> legend(const TrianglePen& pen, double em) const override { return marks_.legend(pen, em); }

 private:
  std::vector<Vec2> centre_;
  MotionMarks marks_;
};

}  // namespace

// Triangles of a grain may be listed in several images of a cell: each is taken where it is nearest to the first.
GrainMotion grain_motion(const TrianglePacking& packing, const std::vector<Vec2>& velocity,
                         const std::vector<double>& spin) {
  const Bodies<2>& b = packing.bodies;
  GrainMotion motion;
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    const auto first = idx(packing.grains.begin[g]), last = idx(packing.grains.begin[g + 1]);
    std::vector<Vec2> place;
    double mass = 0, inertia = 0, moment = 0;
    Vec2 centre{}, mean{};
    for (std::size_t k = first; k < last; ++k) {
      Vec2 from_first = b.position[k] - b.position[first];
      if (packing.cell) from_first += packing.cell->offset(packing.cell->nearest_image(from_first));
      place.push_back(from_first);
      mass += b.mass[k], centre += b.mass[k] * from_first, mean += b.mass[k] * velocity[k];
    }
    centre = (1 / mass) * centre, mean = (1 / mass) * mean;
    for (std::size_t k = first; k < last; ++k) {
      const Vec2 r = place[k - first] - centre, v = velocity[k] - mean;
      inertia += b.inertia[k] + b.mass[k] * dot(r, r);
      moment += b.inertia[k] * spin[k] + b.mass[k] * (r[0] * v[1] - r[1] * v[0]);
    }
    const bool moves = packing.grains.part[g] == GrainPart::free;
    motion.centre.push_back(b.position[first] + centre);
    motion.velocity.push_back(moves ? mean : Vec2{});
    motion.spin.push_back(moves ? moment / inertia : 0);
  }
  return motion;
}

std::unique_ptr<TriangleContent> triangle_grains_content() { return std::make_unique<TriangleGrainsContent>(); }

std::unique_ptr<TriangleContent> triangle_motion_content(std::vector<Vec2> centre, MotionOptions options) {
  return std::make_unique<TriangleMotionContent>(std::move(centre), std::move(options));
}

}  // namespace isostat
