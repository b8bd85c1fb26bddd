// Pictures of grains of triangles, mark by mark, and two approved ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/figure/picture_series.hpp"
#include "analysis/figure/triangle_content.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/picture_difference.hpp"
#include "tests/support/recording_canvas.hpp"
#include "tests/support/triangle_states.hpp"

namespace isostat {
namespace {

using oracle::RecordingCanvas;
using Content = std::unique_ptr<TriangleContent>;

PictureSeries picture(const TrianglePacking& p, Content content, std::optional<Room> room = std::nullopt) {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  subjects.push_back(std::make_unique<TriangleSubject>(p, std::move(content), room));
  return PictureSeries(std::move(subjects), plain("cm"));
}

void draw(const PictureSeries& series, Canvas& canvas) {
  series.draw_packing(canvas, 0);
  series.draw_legend(canvas);
}

RecordingCanvas drawn(const TrianglePacking& p, Content content) {
  RecordingCanvas canvas;
  draw(picture(p, std::move(content)), canvas);
  canvas.finish();
  return canvas;
}

std::size_t areas_of(const RecordingCanvas& canvas, const Color& fill) {
  return static_cast<std::size_t>(std::count_if(canvas.areas.begin(), canvas.areas.end(), [&](const auto& a) {
    return (a.group == "grains" || a.group == "walls") && *a.paint.fill == fill;
  }));
}
std::size_t segments_in(const RecordingCanvas& canvas, const std::string& group) {
  return static_cast<std::size_t>(std::count_if(canvas.drawn_segments.begin(), canvas.drawn_segments.end(),
                                                [&](const auto& s) { return s.group == group; }));
}

TEST(TrianglePicture, GrainsAreFilledAndOutlined) {
  TrianglePacking p;
  add_grain(p, "square", 0.2, {{0, 0}}, 0.3);
  add_grain(p, "square", 0.2, {{1, 0}}, 0, GrainPart::wall);
  add_grain(p, "square", 0.2, {{0, 1}}, 0, GrainPart::lid);
  RecordingCanvas canvas = drawn(p, triangle_grains_content());
  EXPECT_EQ(areas_of(canvas, kGrain), 4u);
  EXPECT_EQ(areas_of(canvas, kWall), 4u);
  EXPECT_EQ(segments_in(canvas, "grains"), 4u);  // the sides; the seams are inside
  EXPECT_EQ(segments_in(canvas, "walls"), 4u);
  std::size_t dashed = 0;
  for (const auto& line : canvas.lines) dashed += line.group == "walls" && !line.stroke.dash.empty();
  EXPECT_EQ(dashed, 4u);
  double sides = 0, area = 0;
  for (const auto& s : canvas.drawn_segments) sides += norm(s.mark.to - s.mark.from);
  for (const auto& a : canvas.areas) {
    const Vec2 u = a.corners[1] - a.corners[0], v = a.corners[2] - a.corners[0];
    area += std::abs(u[0] * v[1] - u[1] * v[0]) / 2;
  }
  EXPECT_NEAR(2 * (sides / 8) * (sides / 8), area, 1e-9 * area);
}

// A beam that has broken leaves a crack: the seam becomes an outline on both of its sides.
TEST(TrianglePicture, ABrokenBeamIsACrack) {
  TrianglePacking p;
  add_grain(p, "L", 0.24, {{0, 0}});
  const std::size_t whole = segments_in(drawn(p, triangle_grains_content()), "grains");
  p.links.erase(p.links.begin() + 4);
  EXPECT_EQ(segments_in(drawn(p, triangle_grains_content()), "grains"), whole + 2);
}

TEST(TrianglePicture, GrainsAcrossAnEdgeOfTheCellShowOnBothSides) {
  TrianglePacking p;
  p.cell = PeriodicCell<2>{{{1, 2}}};
  add_grain(p, "square", 0.2, {{0, 1}});
  add_grain(p, "square", 0.2, {{3.5, 1}});  // listed far outside
  const RecordingCanvas canvas = drawn(p, triangle_grains_content());
  Rect cell;
  for (const auto& box : canvas.boxes)
    if (box.group == "cell") cell = box.rect;
  // of the square at the edge one triangle is on the left, one on the right, and two are cut in halves
  EXPECT_EQ(areas_of(canvas, kGrain), 6u + 4u);
  for (const auto& a : canvas.areas) {
    ASSERT_TRUE(a.clip);
    bool inside = false;
    for (const Vec2& q : a.corners) inside = inside || (q[0] > cell.x - 1e-9 && q[0] < cell.right() + 1e-9);
    EXPECT_TRUE(inside);
  }
  EXPECT_NEAR(cell.height, 2 * cell.width, 1e-9);
}

TEST(TrianglePicture, BarsOfOverlapsFollowTheirForces) {
  TrianglePacking p;
  const auto a = add_grain(p, "square", 0.2, {{0, 0}}), b = add_grain(p, "square", 0.2, {{0.2, 0}}),
             c = add_grain(p, "square", 0.2, {{0.2, 0.2}});
  add_overlap(p, a, b, {{0.1, 0}}, {{3, 0}});
  add_overlap(p, b, c, {{0.2, 0.1}}, {{0, 1}});
  p.overlaps[1].tangential_force = 0.5;
  p.links[0].normal_force = 2, p.links[1].normal_force = -1;
  TriangleForceOptions options;
  options.scale = mean_overlap_force(p);
  EXPECT_DOUBLE_EQ(options.scale, 2);
  const RecordingCanvas canvas = drawn(p, triangle_forces_content(options));
  std::vector<SegmentMark> bars, beams;
  for (const auto& s : canvas.drawn_segments) {
    if (s.group == "overlaps") bars.push_back(s.mark);
    if (s.group == "beams") beams.push_back(s.mark);
  }
  ASSERT_EQ(bars.size(), 2u);
  ASSERT_EQ(beams.size(), 2u);
  EXPECT_NEAR(bars[1].width / bars[0].width, 3, 1e-12);  // thin before thick
  EXPECT_NEAR(beams[0].width / bars[0].width, 2, 1e-12);
  EXPECT_NEAR(beams[1].width / bars[0].width, 1, 1e-12);
  const Vec2 upward = bars[0].to - bars[0].from, right = bars[1].to - bars[1].from;
  EXPECT_NEAR(upward[0], 0, 1e-9);
  EXPECT_LT(upward[1], 0);  // the page's y points down
  EXPECT_NEAR(right[1], 0, 1e-9);
  EXPECT_NEAR(norm(right), norm(upward), 1e-9);
  const Vec2 apart = 0.5 * (bars[0].from + bars[0].to) - 0.5 * (bars[1].from + bars[1].to);
  EXPECT_NEAR(apart[0], -apart[1], 1e-9);  // 0.1 right and 0.1 up
  EXPECT_GT(apart[0], 0);

  options.convention = {ForceMeasure::total, 2};
  const RecordingCanvas light = drawn(p, triangle_forces_content(options));
  int blue = 0, red = 0;
  for (const auto& s : light.drawn_segments)
    if (s.group == "overlaps") blue += s.color == kDistant, red += s.color == kCompressive;
  EXPECT_EQ(blue, 1);
  EXPECT_EQ(red, 1);
  EXPECT_EQ(areas_of(light, kUnstressed), 4u);  // the third grain
}

// Translation and rotation of a rigid grain are found from its triangles, in whatever images they are listed.
TEST(TrianglePicture, MotionOfAGrain) {
  TrianglePacking p;
  p.cell = PeriodicCell<2>{{{1, 1}}};
  add_grain(p, "L", 0.3, {{0.9, 0.5}}, 0.4);
  add_grain(p, "square", 0.3, {{0.3, 0.5}}, 0, GrainPart::wall);
  const Vec2 v{{-2, -1}};
  const double spin = 5;
  for (std::size_t k = 0; k < p.bodies.size(); ++k) {
    const Vec2 r = p.bodies.position[k] - Vec2{{0.9, 0.5}};
    p.bodies.velocity[k] = v + Vec2{{-spin * r[1], spin * r[0]}};
    p.bodies.spin[k] = spin;
    p.bodies.position[k] = p.cell->wrap(p.bodies.position[k]);
  }
  const GrainMotion m = grain_motion(p, p.bodies.velocity, p.bodies.spin);
  ASSERT_EQ(m.velocity.size(), 1u);  // of a wall none
  EXPECT_NEAR(norm(m.velocity[0] - v), 0, 1e-12);
  EXPECT_NEAR(m.spin[0], spin, 1e-11);
  EXPECT_NEAR(norm(p.cell->wrap(m.centre[0]) - Vec2{{0.9, 0.5}}), 0, 1e-12);
  const RecordingCanvas canvas = drawn(p, triangle_motion_content(m, {{}, {}, rich("`v`"), plain("spin"), {}, {}, {}}));
  std::size_t arrows = 0;
  for (const auto& a : canvas.areas) arrows += a.group == "velocities";
  EXPECT_EQ(arrows, 1u);
  EXPECT_GE(areas_of(canvas, diverging(1)), 12u);
}

TEST(TrianglePicture, WindowIsTheContainer) {
  const State<TriangleGrains> bed = small_bed();
  const Extent cut = extent_of(bed.packing);
  EXPECT_TRUE(cut.cut);  // smooth walls lead out of it
  EXPECT_GT(cut.low[0], -1);
  EXPECT_LT(cut.low[0], -0.7);
  EXPECT_LT(cut.high[1], 1.3);
  ContainerScene box;
  box.shape = ContainerShape::box, box.width = 1.4, box.height = 2;
  const Extent room = extent_of(bed.packing, room_of(box));
  EXPECT_GE(room.high[1], 2);
  EXPECT_LT(room.high[1], 2.3);
  EXPECT_FALSE(room_of(ContainerScene{}));
  EXPECT_THROW(extent_of(TrianglePacking{}), std::invalid_argument);
}

std::string svg(const PictureSeries& series) {
  const auto canvas = make_svg_canvas(series.page());
  draw(series, *canvas);
  return canvas->finish();
}

// With ISOSTAT_REGENERATE=1 the approved pictures are written anew: look at them before they are committed.
void expect_approved(const std::string& picture, const std::string& name) {
  const auto path = std::filesystem::path(ISOSTAT_DATA).parent_path() / "tests/golden/pictures" / name;
  if (std::getenv("ISOSTAT_REGENERATE")) std::ofstream(path, std::ios::binary) << picture;
  std::ostringstream approved;
  approved << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_EQ(picture_difference(approved.str(), picture), "") << name;
}

TEST(TrianglePicture, Approved) {
  const State<TriangleGrains> bed = small_bed();
  const TrianglePacking& p = bed.packing;
  expect_approved(svg(picture(p, triangle_grains_content())), "triangles-grains.svg");
  TriangleForceOptions options;
  options.scale = mean_overlap_force(p);
  expect_approved(svg(picture(p, triangle_forces_content(options))), "triangles-forces.svg");
  expect_approved(
      svg(picture(p, triangle_motion_content(grain_motion(p, p.bodies.velocity, p.bodies.spin),
                                             {{}, {}, rich("`v`"), plain("spin"), plain("cm/s"), plain("/s"), {}}))),
      "triangles-velocity.svg");
}

}  // namespace
}  // namespace isostat
