// Pictures of packings, mark by mark, against tiling the plane with copies of the packing.
#include "analysis/figure/packing_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "dem/files/network_file.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/recording_canvas.hpp"

namespace isostat {
namespace {

using oracle::RecordingCanvas;

struct Drawn {
  RecordingCanvas canvas;
  Rect window;   // the cell on the page
  double scale;  // [pt per unit length]
};

Drawn draw(const Packing<2>& packing, std::unique_ptr<PictureContent> content) {
  const PackingPicture picture(packing, std::move(content));
  Drawn d;
  picture.draw(d.canvas);
  d.canvas.finish();
  for (const auto& box : d.canvas.boxes)
    if (box.group == "cell") d.window = box.rect;
  if (packing.cell) d.scale = d.window.width / packing.cell->length[0];
  return d;
}

Vec2 to_page(const Drawn& d, const Vec2& r) {
  return {{d.window.x + d.scale * r[0], d.window.bottom() - d.scale * r[1]}};
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 u = b - a;
  const double t = std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0);
  return norm(p - a - t * u);
}

constexpr int kReach = 6;  // copies of the cell on each side, more than any shift of the random links

// Smallest of distance - radius over all copies of all disks.
double depth_in_disks(const Packing<2>& p, const Vec2& at) {
  double least = INFINITY;
  for (std::size_t i = 0; i < p.bodies.size(); ++i)
    for (int m = -kReach; m <= kReach; ++m)
      for (int n = -kReach; n <= kReach; ++n)
        least = std::min(least, norm(p.bodies.position[i] + p.cell->offset({m, n}) - at) - p.bodies.radius[i]);
  return least;
}

// The same for links of one colour: distance to the line between centres minus half its width.
double depth_in_links(const Packing<2>& p, const Vec2& at, LinkColor color, const ForceConvention& convention,
                      double width_of_unit_force) {
  double least = INFINITY;
  for (const Link<2>& link : p.links) {
    if (link_color(link, convention) != color) continue;
    const double half = 0.5 * width_of_unit_force * drawn_force(link, convention);
    const Vec2 a = p.bodies.position[static_cast<std::size_t>(link.i)];
    const Vec2 b = p.bodies.position[static_cast<std::size_t>(link.j)] + p.cell->offset(link.shift);
    for (int m = -kReach; m <= kReach; ++m)
      for (int n = -kReach; n <= kReach; ++n) {
        const Vec2 offset = p.cell->offset({m, n});
        least = std::min(least, distance_to_segment(at, a + offset, b + offset) - half);
      }
  }
  return least;
}

double drawn_depth(const RecordingCanvas& canvas, const Vec2& at) {
  double least = INFINITY;
  for (const auto& d : canvas.drawn_disks)
    if (d.group == "disks") least = std::min(least, norm(d.mark.center - at) - d.mark.radius);
  return least;
}

double drawn_depth(const RecordingCanvas& canvas, const Vec2& at, const Color& color) {
  double least = INFINITY;
  for (const auto& s : canvas.drawn_segments)
    if (s.group == "links" && s.color == color)
      least = std::min(least, distance_to_segment(at, s.mark.from, s.mark.to) - s.mark.width / 2);
  return least;
}

double largest_diameter(const Packing<2>& p) {
  return 2 * *std::max_element(p.bodies.radius.begin(), p.bodies.radius.end());
}

// Wherever one looks in the cell, the picture shows what the tiled plane has there: same disks, same links, same widths
// and colours, on both sides of every edge.
TEST(PackingPicture, ShowsTheTiledPlane) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Packing<2> p = oracle::random_packing(seed, 25, 40, true);
    for (const bool thresholded : {false, true}) {
      ForceOptions options;
      options.scale = 2.0;
      if (thresholded) options.convention = {ForceMeasure::total, 0.7};
      const Drawn d = draw(p, forces_content(options));
      const double unit = kWidthAtF0 * largest_diameter(p) / options.scale;
      std::mt19937_64 random(seed);
      std::uniform_real_distribution<double> x(0, p.cell->length[0]), y(0, p.cell->length[1]);
      for (int k = 0; k < 400; ++k) {
        const Vec2 at{{x(random), y(random)}}, page = to_page(d, at);
        const double disks = depth_in_disks(p, at);
        if (disks < 0)
          EXPECT_NEAR(drawn_depth(d.canvas, page), d.scale * disks, 1e-6 * d.scale);
        else
          EXPECT_GT(drawn_depth(d.canvas, page), 0);
        for (const auto& [color, paint] :
             {std::pair{LinkColor::compressive, kCompressive}, {LinkColor::tensile, kTensile}}) {
          const double links = depth_in_links(p, at, color, options.convention, unit);
          if (links < 0)
            EXPECT_NEAR(drawn_depth(d.canvas, page, paint), d.scale * links, 1e-6 * d.scale);
          else
            EXPECT_GT(drawn_depth(d.canvas, page, paint), 0);
        }
      }
    }
  }
}

TEST(PackingPicture, DrawsNothingTwiceAndNothingOutside) {
  const Packing<2> p = oracle::random_packing(7, 30, 40, true);
  ForceOptions options;
  const Drawn d = draw(p, forces_content(options));
  std::vector<const RecordingCanvas::Disk*> disks;
  for (const auto& disk : d.canvas.drawn_disks)
    if (disk.group == "disks") disks.push_back(&disk);
  for (std::size_t a = 0; a < disks.size(); ++a) {
    ASSERT_TRUE(disks[a]->clip);
    EXPECT_EQ(disks[a]->clip->width, d.window.width);
    const DiskMark& m = disks[a]->mark;
    EXPECT_TRUE(m.center[0] + m.radius > d.window.x && m.center[0] - m.radius < d.window.right());
    EXPECT_TRUE(m.center[1] + m.radius > d.window.y && m.center[1] - m.radius < d.window.bottom());
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_FALSE(m.center == disks[b]->mark.center && m.radius == disks[b]->mark.radius);
  }
  for (const auto& s : d.canvas.drawn_segments) EXPECT_TRUE(s.group != "links" || s.clip);
}

// Four disks, five links: what the paper's figure of it must show.
TEST(PackingPicture, DoubleTriangle) {
  Packing<2> p = read_network<2>(ISOSTAT_DATA "/clusters/double_triangle.net").packing;
  for (Link<2>& link : p.links) link.normal_force = -0.1, link.tangential_force = 0.2;
  p.links[0].normal_force = 0.4, p.links[0].tangential_force = 0;
  p.links[1].kind = LinkKind::distant;
  ForceOptions options;
  options.scale_label = rich("`F`_{0}");
  const PackingPicture picture(p, forces_content(options));
  RecordingCanvas canvas;
  picture.draw(canvas);
  canvas.finish();
  int disks = 0, red = 0, green = 0, blue = 0;
  for (const auto& d : canvas.drawn_disks) {
    disks += d.group == "disks";
    EXPECT_FALSE(d.clip);  // isolated: nothing to cut off
    EXPECT_GE(d.mark.center[0] - d.mark.radius, 0);
    EXPECT_LE(d.mark.center[0] + d.mark.radius, picture.size()[0]);
    EXPECT_LE(d.mark.center[1] + d.mark.radius, picture.size()[1]);
  }
  double width_red = 0, width_green = 0;
  for (const auto& s : canvas.drawn_segments) {
    if (s.group != "links") continue;
    if (s.color == kCompressive) ++red, width_red = s.mark.width;
    if (s.color == kTensile) ++green, width_green = s.mark.width;
    blue += s.color == kDistant;
  }
  EXPECT_EQ(disks, 4);
  EXPECT_EQ(red, 1);
  EXPECT_EQ(green, 3);
  EXPECT_EQ(blue, 1);
  EXPECT_NEAR(width_red / width_green, 4, 1e-12);  // |N|, not |F|
  EXPECT_TRUE(std::none_of(canvas.boxes.begin(), canvas.boxes.end(), [](const auto& b) { return b.group == "cell"; }));
}

TEST(PackingPicture, VelocityArrowsAndSpinColours) {
  Packing<2> p = oracle::random_packing(3, 40, 10, true);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < p.bodies.size(); ++i) {
    p.bodies.velocity[i] = {{0.01 * normal(random), 0.01 * normal(random)}};
    p.bodies.spin[i] = i == 0 ? 1e3 : i == 1 ? -1e3 : 0.0;
  }
  const Drawn d = draw(p, motion_content({p.bodies.velocity, p.bodies.spin, rich("`v`"), plain("spin"), {}, {}, {}}));
  double rms = 0, diameter = 0;
  for (std::size_t i = 0; i < p.bodies.size(); ++i) {
    rms += dot(p.bodies.velocity[i], p.bodies.velocity[i]);
    diameter += 2 * p.bodies.radius[i] / static_cast<double>(p.bodies.size());
  }
  rms = std::sqrt(rms / static_cast<double>(p.bodies.size()));
  for (std::size_t i = 0; i < p.bodies.size(); ++i) {
    const Vec2 center = to_page(d, p.cell->wrap(p.bodies.position[i]));
    const Vec2 v = p.bodies.velocity[i];
    const Vec2 tip = center + (diameter * d.scale / rms) * Vec2{{v[0], -v[1]}};
    bool found = false;
    for (const auto& a : d.canvas.areas)  // the tip is the middle one of seven corners
      found = found || (a.group == "velocities" && norm(a.corners[3] - tip) < 1e-6);
    EXPECT_TRUE(found || norm(tip - center) < 0.3) << i;
    for (const auto& disk : d.canvas.drawn_disks)
      if (disk.group == "disks" && norm(disk.mark.center - center) < 1e-9) {
        const Color expected = i == 0 ? diverging(1) : i == 1 ? diverging(-1) : diverging(0);
        EXPECT_EQ(*disk.paint.fill, expected) << i;
      }
  }
}

TEST(PackingPicture, AtRestNothingMoves) {
  Packing<2> p = oracle::random_packing(3, 12, 4, true);
  for (auto& v : p.bodies.velocity) v = {};
  for (auto& w : p.bodies.spin) w = 0;
  const Drawn d = draw(p, motion_content({p.bodies.velocity, p.bodies.spin, rich("`v`"), plain("spin"), {}, {}, {}}));
  EXPECT_TRUE(std::none_of(d.canvas.areas.begin(), d.canvas.areas.end(),
                           [](const auto& a) { return a.group == "velocities"; }));
  EXPECT_TRUE(
      std::any_of(d.canvas.texts.begin(), d.canvas.texts.end(), [](const auto& t) { return t.plain() == "at rest"; }));
}

// Legend and scale bars agree with the picture, and stay on the page without overlapping.
TEST(PackingPicture, LegendIsTrueAndOnThePage) {
  const Packing<2> p = oracle::random_packing(11, 30, 50, true);
  ForceOptions options;
  options.scale = 3;
  options.scale_label = rich("`F`_{0}");
  const PackingPicture picture(p, forces_content(options));
  const Drawn d = draw(p, forces_content(options));
  const double unit = d.scale * kWidthAtF0 * largest_diameter(p);  // [pt per F1]
  bool force_bar = false, length_bar = false;
  struct Span {
    double left, right, y;
  };
  std::vector<Span> spans;
  for (const auto& t : d.canvas.texts) {
    const double width = text_width(t.text, t.style.size);
    EXPECT_LE(t.at[0] + width, picture.size()[0]);
    EXPECT_LE(t.at[1], picture.size()[1]);
    for (const Span& s : spans)
      EXPECT_TRUE(s.y != t.at[1] || t.at[0] > s.right || t.at[0] + width < s.left) << t.plain();
    spans.push_back({t.at[0], t.at[0] + width, t.at[1]});
    const std::string text = t.plain();
    if (const auto at = text.find("= "); text.find("|N|") == 0 && at != std::string::npos) {
      const double fraction =
          std::isdigit(static_cast<unsigned char>(text[at + 2])) ? std::stod(text.substr(at + 2)) : 1;
      for (const auto& b : d.canvas.boxes)
        if (b.group == "legend" && b.paint.fill)
          force_bar = force_bar || std::abs(b.rect.height - fraction * unit) < 1e-9;
    } else if (std::isdigit(static_cast<unsigned char>(text[0]))) {
      for (const auto& l : d.canvas.lines)
        if (l.points[0][1] == l.points[1][1])
          length_bar = length_bar || std::abs(norm(l.points[1] - l.points[0]) - d.scale * std::stod(text)) < 1e-9;
    }
  }
  EXPECT_TRUE(force_bar);
  EXPECT_TRUE(length_bar);
}

// A pore inside an island of a larger one is filled after it; the disks come last.
TEST(PackingPicture, PoresFillOutsideIn) {
  const Packing<2> p = oracle::random_packing(5, 12, 0, true);
  const Polygon large{{{0, 0}}, {{0, 2}}, {{2, 2}}, {{2, 0}}}, small{{{.5, .5}}, {{.5, 1}}, {{1, 1}}, {{1, .5}}};
  const Drawn d = draw(p, pores_content({{{small, 0.25, 0.3}, {large, 4, 1.2}}, true, {}}));
  std::vector<std::pair<double, Color>> filled;  // width on the page, in order of drawing
  for (const auto& a : d.canvas.areas)
    if (a.group == "pores") filled.emplace_back(a.corners[2][0] - a.corners[0][0], *a.paint.fill);
  ASSERT_GE(filled.size(), 2u);
  EXPECT_NEAR(filled.front().first, 2 * d.scale, 1e-9);
  EXPECT_NEAR(filled.back().first, 0.5 * d.scale, 1e-9);
  EXPECT_EQ(filled.front().second, sequential(1));
  EXPECT_EQ(filled.back().second, sequential(0));
  EXPECT_TRUE(std::any_of(d.canvas.texts.begin(), d.canvas.texts.end(),
                          [](const auto& t) { return t.plain() == "white: percolating"; }));
}

// Two hyperstatic triangles that touch, an isostatic pair, a single grain.
TEST(PackingPicture, ClustersThatMeetDifferInColour) {
  Packing<2> p;
  p.bodies.resize(9);
  for (std::size_t i = 0; i < 9; ++i) {
    p.bodies.position[i] = {{static_cast<double>(i), 0}};
    p.bodies.radius[i] = 0.5;
  }
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {6, 7}}) {
    p.links.emplace_back();
    p.links.back().i = i, p.links.back().j = j;
  }
  const Drawn d = draw(p, clusters_content({{0, 0, 0, 1, 1, 1, 2, 2, -1}, {0, 0, -1, 1, 1, 2}, {true, true, false}}));
  std::vector<Color> fill(9);
  double left = 1e9;
  for (const auto& disk : d.canvas.drawn_disks)
    if (disk.group == "disks") left = std::min(left, disk.mark.center[0]);
  for (const auto& disk : d.canvas.drawn_disks)
    if (disk.group == "disks")
      fill[static_cast<std::size_t>(std::lround((disk.mark.center[0] - left) / (2 * disk.mark.radius)))] =
          *disk.paint.fill;
  EXPECT_TRUE(fill[0] == fill[1] && fill[1] == fill[2] && fill[3] == fill[5]);
  EXPECT_FALSE(fill[2] == fill[3]);
  EXPECT_EQ(fill[0], blend(kCurves[0], kWhite, 0.35));
  EXPECT_EQ(fill[6], blend(kCurves[0], kWhite, 0.75));  // meets nobody: the first colour again, pale
  EXPECT_EQ(fill[8], kDisk);
  int grey = 0;
  for (const auto& s : d.canvas.drawn_segments) grey += s.group == "links" && s.color == kFaint;
  EXPECT_EQ(grey, 1);
}

TEST(PackingPicture, RefusesAnEmptyPacking) {
  EXPECT_THROW(PackingPicture(Packing<2>{}, grains_content()), std::invalid_argument);
}

TEST(ForceConvention, ColoursOfFigure2) {
  Link<2> link;
  link.normal_force = 0.5, link.tangential_force = -0.3;
  EXPECT_EQ(link_color(link, {}), LinkColor::compressive);
  EXPECT_DOUBLE_EQ(drawn_force(link, {}), 0.5);
  link.normal_force = -0.4;
  EXPECT_EQ(link_color(link, {}), LinkColor::tensile);
  EXPECT_DOUBLE_EQ(drawn_force(link, {ForceMeasure::total, {}}), 0.5);
  link.kind = LinkKind::distant;
  EXPECT_EQ(link_color(link, {}), LinkColor::distant);
}

// With a threshold blue means small, distant or not; the total force decides.
TEST(ForceConvention, ColoursOfFigure11) {
  Link<2> link;
  link.normal_force = 0, link.tangential_force = 1e-3;
  EXPECT_EQ(link_color(link, {ForceMeasure::total, 1e-2}), LinkColor::distant);
  EXPECT_EQ(link_color(link, {ForceMeasure::total, 1e-4}), LinkColor::compressive);
  link.kind = LinkKind::distant, link.normal_force = -0.9;
  EXPECT_EQ(link_color(link, {ForceMeasure::total, 1e-4}), LinkColor::tensile);
}

TEST(ForceConvention, DisksTouchedOnlyByUnstressedLinksAreGrey) {
  Packing<2> p;
  p.bodies.resize(4);
  p.links.resize(2);
  p.links[0].i = 0, p.links[0].j = 1, p.links[0].normal_force = 1;
  p.links[1].i = 1, p.links[1].j = 2, p.links[1].tangential_force = 1e-3;
  const std::vector<bool> loose{false, false, false, true};
  using enum DiskShade;
  EXPECT_EQ(disk_shades(p, {ForceMeasure::total, 1e-2}, loose), (std::vector{plain, plain, unstressed, unstressed}));
  EXPECT_EQ(disk_shades(p, {ForceMeasure::total, 1e-4}, loose), (std::vector{plain, plain, plain, unstressed}));
  EXPECT_EQ(disk_shades(p, {}, loose), (std::vector{plain, plain, plain, DiskShade::rattler}));
  EXPECT_EQ(disk_shades(p, {}, {}), std::vector(4, plain));
}

// Scales and shades are those of the grains, whatever the size of wall disks; the window holds both.
TEST(PictureOfAContainer, IsMeasuredByItsGrains) {
  Packing<2> p;
  p.bodies.resize(3);
  p.bodies.id = {0, 1, 2};
  p.bodies.position = {{{0, 0}}, {{5, 0}}, {{-1, 0}}};
  p.bodies.radius = {0.5, 2, 0.25};
  p.part = {GrainPart::free, GrainPart::wall, GrainPart::lid};
  const Extent extent = extent_of(p);
  EXPECT_EQ(extent.diameter, 1);
  EXPECT_GE(extent.high[0], 7);
  EXPECT_EQ(PicturePen(p, PictureFrame(extent, extent)).largest_diameter(), 1);
  ForceConvention convention;
  convention.threshold = 1;
  EXPECT_EQ(disk_shades(p, convention, {}), (std::vector{DiskShade::unstressed, DiskShade::plain, DiskShade::plain}));
  p.part.assign(3, GrainPart::wall);  // an emptied hopper
  EXPECT_GT(extent_of(p).diameter, 1);
}

// Smooth walls are lines around the grains; upright ones are cut where they lead away.
TEST(PictureOfAContainer, HasLinesForSmoothWalls) {
  Packing<2> p;
  p.bodies.resize(2);
  p.bodies.id = {0, 1};
  p.bodies.position = {{{0, 0.5}}, {{0, 0}}};
  p.bodies.radius = {0.5, 0};
  p.part = {GrainPart::free, GrainPart::wall};
  p.feet.resize(1);
  ContainerScene box;
  box.shape = ContainerShape::box, box.walls = ContainerWalls::smooth, box.width = 6, box.height = 50;
  const std::vector<SmoothWall> walls = smooth_walls(box, 0);
  ASSERT_EQ(walls.size(), 3u);
  const Extent extent = with_walls(extent_of(p), walls);
  EXPECT_LT(extent.low[0], -3);
  EXPECT_GT(extent.high[0], 3);
  EXPECT_LT(extent.low[1], 0);
  EXPECT_LT(extent.high[1], 3);
  EXPECT_TRUE(extent.cut);
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  subjects.push_back(std::make_unique<DiskSubject>(p, grains_content(), walls));
  const PictureSeries series(std::move(subjects), {});
  const auto canvas = make_svg_canvas(series.page());
  series.draw_packing(*canvas, 0);
  const std::string svg = canvas->finish();
  EXPECT_NE(svg.find("id=\"walls\""), std::string::npos);
  EXPECT_FALSE(with_walls(extent_of(p), {}).cut);
}

}  // namespace
}  // namespace isostat
