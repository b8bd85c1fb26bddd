// Pictures of spheres, mark by mark, against the geometry of projection and section: ray casting, closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "analysis/figure/picture_series.hpp"
#include "analysis/figure/slice_subject.hpp"
#include "analysis/figure/sphere_outlines.hpp"
#include "analysis/figure/sphere_subject.hpp"
#include "tests/support/picture_difference.hpp"
#include "tests/support/recording_canvas.hpp"

namespace isostat {
namespace {

using oracle::RecordingCanvas;

std::size_t add(SpherePacking& p, const Vec3& at, double radius, const Vec3& velocity = {}) {
  const std::size_t n = p.bodies.size();
  p.bodies.resize(n + 1);
  p.bodies.id[n] = static_cast<std::int64_t>(n) + 10;
  p.bodies.position[n] = at, p.bodies.radius[n] = radius, p.bodies.velocity[n] = velocity;
  p.bodies.mass[n] = p.bodies.inertia[n] = 1;
  return n;
}

Link<3> link_of(std::size_t i, std::size_t j, double normal, const Vec3& tangential = {},
                const ImageShift<3>& shift = {}) {
  Link<3> link;
  link.i = static_cast<std::int32_t>(i), link.j = static_cast<std::int32_t>(j), link.shift = shift;
  link.normal_force = normal, link.tangential_force = tangential;
  return link;
}

// Disjoint spheres of many sizes, by random trials; some lie outside the cell.
SpherePacking disjoint_spheres(std::uint64_t seed, int trials = 300, const Vec3& edges = {{5, 4, 3}}) {
  SpherePacking p;
  p.cell = PeriodicCell<3>{edges};
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < trials; ++k) {
    const Vec3 at{{edges[0] * (2 * uniform(random) - 0.5), edges[1] * uniform(random), edges[2] * uniform(random)}};
    const double radius = 0.08 + 0.5 * uniform(random) * uniform(random);
    bool free = true;
    for (std::size_t i = 0; i < p.bodies.size(); ++i)
      free = free && norm(p.cell->wrap(at) - p.cell->wrap(p.bodies.position[i])) > radius + p.bodies.radius[i];
    if (free) add(p, at, radius, {{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5}});
  }
  return p;
}

std::unique_ptr<SphereContent> plain_balls(const SpherePacking& p) {
  return balls_content(std::vector<std::size_t>(p.bodies.size(), 0), {{kGrain, {}}});
}

PictureSeries picture(const SpherePacking& p, const View& view, std::unique_ptr<SphereContent> content) {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  subjects.push_back(std::make_unique<SphereSubject>(p, SphereView{view, depth_range(p, view)}, std::move(content)));
  return PictureSeries(std::move(subjects), rich("`a`"));
}

PictureSeries picture(const SpherePacking& p, const Slice& slice, std::unique_ptr<PictureContent> content) {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  subjects.push_back(std::make_unique<SliceSubject>(p, slice, cut(p, slice), std::move(content), rich("`z`")));
  return PictureSeries(std::move(subjects), rich("`a`"));
}

void draw(const PictureSeries& series, Canvas& canvas) {
  series.draw_packing(canvas, 0);
  series.draw_legend(canvas);
}

RecordingCanvas recorded(const PictureSeries& series) {
  RecordingCanvas canvas;
  draw(series, canvas);
  canvas.finish();
  return canvas;
}

std::string svg(const PictureSeries& series) {
  const auto canvas = make_svg_canvas(series.page());
  draw(series, *canvas);
  return canvas->finish();
}

std::vector<RecordingCanvas::Ball> balls(const RecordingCanvas& canvas) {
  std::vector<RecordingCanvas::Ball> found;
  for (const auto& b : canvas.drawn_balls)
    if (b.group == "spheres") found.push_back(b);
  return found;
}

TEST(View, IsARightHandedFrame) {
  for (const auto& [azimuth, elevation] : {std::pair{-60.0, 20.0}, {0.0, 0.0}, {213.0, -77.0}, {45.0, 90.0}}) {
    const View v = view_from(azimuth, elevation);
    for (const Vec3& e : {v.right, v.up, v.toward}) EXPECT_NEAR(norm(e), 1, 1e-15);
    EXPECT_NEAR(norm(cross(v.right, v.up) - v.toward), 0, 1e-15);
    EXPECT_EQ(v.right[2], 0);  // z leads straight up
    EXPECT_GE(v.up[2], 0);
    EXPECT_NEAR(v.toward[2], std::sin(elevation * std::numbers::pi / 180), 1e-15);
  }
}

TEST(View, AlongAnAxisIsOneOfTheDirections) {
  const std::array<std::array<double, 2>, 3> angles{{{0, 0}, {-90, 0}, {-90, 90}}};
  for (int axis = 0; axis < 3; ++axis) {
    const View a = view_along(axis),
               b = view_from(angles[static_cast<std::size_t>(axis)][0], angles[static_cast<std::size_t>(axis)][1]);
    EXPECT_NEAR(norm(a.right - b.right) + norm(a.up - b.up) + norm(a.toward - b.toward), 0, 1e-15) << axis;
  }
}

// Wherever one looks, the ball painted last is the one that a ray from the viewer meets first.
TEST(SpherePicture, ShowsWhatARayMeetsFirst) {
  for (const View& view : {view_from(-60, 20), view_from(130, -35), view_along(0), view_along(2)}) {
    const SpherePacking p = disjoint_spheres(3);
    ASSERT_GT(p.bodies.size(), 60u);
    const auto drawn = balls(recorded(picture(p, view, plain_balls(p))));
    ASSERT_EQ(drawn.size(), p.bodies.size());
    double scale = 0;  // of the picture: the largest ball is the largest sphere
    for (const auto& b : drawn) scale = std::max(scale, b.mark.radius);
    scale /= *std::max_element(p.bodies.radius.begin(), p.bodies.radius.end());
    const Vec3 middle = 0.5 * p.cell->length;
    std::vector<Vec3> place;
    Vec2 origin{};  // of the picture on the page
    for (std::size_t k = 0; k < p.bodies.size(); ++k) place.push_back(p.cell->wrap(p.bodies.position[k]) - middle);
    const auto flat = [&](const Vec3& r) { return scale * Vec2{{view.flat(r)[0], -view.flat(r)[1]}}; };
    for (const auto& b : drawn) origin += b.mark.center / static_cast<double>(drawn.size());
    for (const Vec3& r : place) origin -= flat(r) / static_cast<double>(drawn.size());
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> u(-1, 1);
    int hits = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vec3 at{{middle[0] * u(random), middle[1] * u(random), middle[2] * u(random)}};
      const Vec2 seen = origin + flat(at);
      std::size_t first = place.size();
      double nearest = -INFINITY;
      for (std::size_t k = 0; k < place.size(); ++k) {
        const double d = norm(seen - origin - flat(place[k])) / scale, r = p.bodies.radius[k];
        if (d < r && view.depth(place[k]) + std::sqrt(r * r - d * d) > nearest)
          nearest = view.depth(place[k]) + std::sqrt(r * r - d * d), first = k;
      }
      const auto last = std::find_if(drawn.rbegin(), drawn.rend(),
                                     [&](const auto& b) { return norm(b.mark.center - seen) < b.mark.radius; });
      ASSERT_EQ(last == drawn.rend(), first == place.size());
      if (first == place.size()) continue;
      ++hits;
      EXPECT_NEAR(norm(last->mark.center - origin - flat(place[first])), 0, 1e-9 * scale);
      EXPECT_NEAR(last->mark.radius, scale * p.bodies.radius[first], 1e-9 * scale);
    }
    EXPECT_GT(hits, 500);
  }
}

// The farther the paler; all on the page.
TEST(SpherePicture, FadesWithDepth) {
  const SpherePacking p = disjoint_spheres(5);
  const PictureSeries series = picture(p, view_from(-60, 20), plain_balls(p));
  const auto drawn = balls(recorded(series));
  for (std::size_t k = 1; k < drawn.size(); ++k) EXPECT_LE(drawn[k].color.blue, drawn[k - 1].color.blue);
  EXPECT_GT(drawn.front().color.blue, drawn.back().color.blue + 0.02);
  for (const auto& b : drawn) {
    EXPECT_GE(b.mark.center[0] - b.mark.radius, 0);
    EXPECT_GE(b.mark.center[1] - b.mark.radius, 0);
    EXPECT_LE(b.mark.center[0] + b.mark.radius, series.page()[0]);
    EXPECT_LE(b.mark.center[1] + b.mark.radius, series.page()[1]);
  }
}

// The picture is of the packing, not of the order in which it is stored.
TEST(SpherePicture, DoesNotDependOnStorage) {
  const SpherePacking p = disjoint_spheres(6, 60);
  SpherePacking q = p;
  std::vector<std::size_t> order(p.bodies.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::mt19937_64 random(1);
  std::shuffle(order.begin(), order.end(), random);
  for (std::size_t k = 0; k < order.size(); ++k) {
    q.bodies.id[k] = p.bodies.id[order[k]], q.bodies.position[k] = p.bodies.position[order[k]];
    q.bodies.radius[k] = p.bodies.radius[order[k]];
  }
  const View view = view_from(20, 30);
  EXPECT_EQ(svg(picture(p, view, plain_balls(p))), svg(picture(q, view, plain_balls(q))));
}

TEST(SpherePicture, EdgesOfTheCell) {
  const SpherePacking p = disjoint_spheres(7, 20);
  const auto edges = [&](const View& view) {
    std::array<int, 2> count{};  // behind, in front
    for (const auto& l : recorded(picture(p, view, plain_balls(p))).lines)
      if (l.group == "cell") ++count[l.stroke.color == kFaint ? 0 : 1];
    return count;
  };
  EXPECT_EQ(edges(view_from(-60, 20)), (std::array{3, 9}));
  EXPECT_EQ(edges(view_along(2)), (std::array{4, 4}));  // the far face and the near one
  // the edges along x are 5 long, the farthest sphere is the first ball
  const RecordingCanvas canvas = recorded(picture(p, view_along(2), plain_balls(p)));
  std::size_t far = 0;
  for (std::size_t k = 0; k < p.bodies.size(); ++k)
    if (p.cell->wrap(p.bodies.position[k])[2] < p.cell->wrap(p.bodies.position[far])[2]) far = k;
  const double scale = balls(canvas)[0].mark.radius / p.bodies.radius[far];
  for (const auto& l : canvas.lines) {
    if (l.group != "cell" || l.points[0][1] != l.points[1][1]) continue;
    EXPECT_NEAR(std::abs(l.points[1][0] - l.points[0][0]), 5 * scale, 1e-9);
  }
}

SpherePacking leaning(SpherePacking p, double tilt) {
  p.cell->tilt = tilt;
  for (std::size_t i = 0; i < p.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < p.bodies.size(); ++j) {
      const Vec3 d = p.bodies.position[j] - p.bodies.position[i];
      const ImageShift<3> shift = p.cell->nearest_image(d);
      if (norm(d + p.cell->offset(shift)) < 1.5 * (p.bodies.radius[i] + p.bodies.radius[j]))
        p.links.push_back(link_of(i, j, 1, {}, shift));
    }
  return p;
}

// The twelve edges of a leaning cell join its corners; faces look where their normals do.
TEST(SpherePicture, EdgesOfALeaningCell) {
  for (const double tilt : {1.5, -2.0}) {
    const SpherePacking p = leaning(disjoint_spheres(7, 200), tilt);
    const View view = view_from(-60, 20);
    const SpherePen pen(p, PictureFrame(extent_of(p, view)), {view, depth_range(p, view)});
    std::array<int, 2> count{};
    for (const auto& l : recorded(picture(p, view, plain_balls(p))).lines)
      if (l.group == "cell") ++count[l.stroke.color == kFaint ? 0 : 1];
    EXPECT_EQ(count, (std::array{3, 9}));
    const RecordingCanvas top = recorded(picture(p, view_along(2), plain_balls(p)));
    double along = 0, up = 0, scale = 0;
    for (const auto& l : top.lines) {
      if (l.group != "cell") continue;
      const Vec2 edge = l.points[1] - l.points[0];
      if (std::abs(edge[1]) < 1e-9)
        scale = std::abs(edge[0]) / 5;
      else
        along = edge[0] * (edge[1] < 0 ? 1 : -1), up = std::abs(edge[1]);
    }
    EXPECT_NEAR(along, tilt * scale, 1e-9);
    EXPECT_NEAR(up, 4 * scale, 1e-9);
    // Spheres are inside it, and pieces of links as long as their branch vectors.
    const DepthRange range = depth_range(p, view);
    for (std::size_t k = 0; k < p.bodies.size(); ++k) {
      const Vec3 f = p.cell->fractions(pen.place(k) + middle_of(p));
      for (int a = 0; a < 3; ++a) EXPECT_TRUE(f[a] > -1e-12 && f[a] < 1 + 1e-12);
      EXPECT_TRUE(view.depth(pen.place(k)) <= range.near && view.depth(pen.place(k)) >= range.far);
    }
    ASSERT_GT(p.links.size(), 5u);
    for (const Link<3>& link : p.links) {
      double length = 0;
      for (const auto& [from, to] : pen.pieces(link)) length += norm(to - from);
      const Vec3 branch = p.bodies.position[static_cast<std::size_t>(link.j)] + p.cell->offset(link.shift) -
                          p.bodies.position[static_cast<std::size_t>(link.i)];
      EXPECT_NEAR(length, norm(branch), 1e-12);
    }
  }
}

// A link that leaves the cell is drawn at both of its ends, up to where the spheres touch.
TEST(SpherePen, CutsLinksAtTheCell) {
  SpherePacking p;
  p.cell = PeriodicCell<3>{{{4, 4, 4}}};
  add(p, {{0.3, 1, 1}}, 0.5), add(p, {{3.5, 1, 1.2}}, 0.25), add(p, {{1, 1, 1}}, 0.2);
  const View view = view_along(2);
  const SpherePen pen(p, PictureFrame(extent_of(p, view)), {view, depth_range(p, view)});
  const auto whole = pen.pieces(link_of(0, 2, 1));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].first, pen.place(0));
  EXPECT_EQ(whole[0].second, pen.place(2));
  const auto parts = pen.pieces(link_of(0, 1, 1, {}, {-1, 0, 0}));
  ASSERT_EQ(parts.size(), 2u);
  const Vec3 branch{{-0.8, 0, 0.2}};
  EXPECT_NEAR(norm(parts[0].second - pen.place(0) - 2.0 / 3 * branch), 0, 1e-12);
  EXPECT_NEAR(norm(parts[1].second - pen.place(1) + 1.0 / 3 * branch), 0, 1e-12);
}

SpherePacking on_a_floor() {
  SpherePacking p;
  add(p, {{0, 0, 0.45}}, 0.5, {{1, 0, 0}}), add(p, {{0.9, 0, 0.5}}, 0.5, {{0, 0, -1}}), add(p, {{0, 2, 1}}, 0.3);
  p.links = {link_of(0, 1, 2, {{0, 1.5, 0}}), link_of(1, 2, -1)};
  p.links[1].kind = LinkKind::distant;
  p.walls = {{WallShape::plane, {}, {{0, 0, 1}}, 0, {}, SphereWall::kEveryGroup}};
  p.wall_links = {{0, 0, LinkKind::closed, -0.05, 4, {}}};
  return p;
}

TEST(SpherePicture, ForcesByColourAndWidth) {
  const SpherePacking p = on_a_floor();
  ForceOptions options;
  options.scale = 2, options.width_at_scale = 0.1;
  const auto widths = [&](const ForceOptions& of, const Color& color) {
    const RecordingCanvas canvas = recorded(picture(p, view_along(1), sphere_forces_content(of)));
    double most = 0;
    for (const auto& b : balls(canvas)) most = std::max(most, b.mark.radius);
    std::vector<double> found;  // [largest diameter]
    for (const auto& s : canvas.drawn_segments)
      for (int level = 0; level < SpherePen::kLevels; ++level)
        if (s.group == "links" && s.color == SpherePen::faded(color, level, 0.55)) {
          found.push_back(s.mark.width / (2 * most));
          break;
        }
    std::sort(found.begin(), found.end());
    return found;
  };
  const auto red = widths(options, kCompressive);
  ASSERT_EQ(red.size(), 2u);  // a contact, and one with the floor
  EXPECT_NEAR(red[0], 0.1, 1e-12);
  EXPECT_NEAR(red[1], 0.2, 1e-12);
  EXPECT_EQ(widths(options, kDistant).size(), 1u);
  options.convention = {ForceMeasure::total, 0.5};
  EXPECT_NEAR(widths(options, kCompressive)[0], 0.1 * 2.5 / 2, 1e-12);  // |F| of N = 2, T = 1.5
  ASSERT_EQ(widths(options, kTensile).size(), 1u);                      // with a threshold blue means small
  EXPECT_NEAR(widths(options, kTensile)[0], 0.05, 1e-12);
}

// Seen from the side of its grains a floor is behind them, from below in front of them.
TEST(SpherePicture, AFloorIsOnItsSide) {
  const SpherePacking p = on_a_floor();
  const auto filled = [&](const View& view) {
    for (const auto& a : recorded(picture(p, view, plain_balls(p))).areas)
      if (a.group == "walls") return a.paint.fill.has_value();
    ADD_FAILURE();
    return false;
  };
  EXPECT_TRUE(filled(view_from(-60, 20)));
  EXPECT_FALSE(filled(view_from(-60, -20)));
  for (const Vec3& corner : patch_of(p, p.walls[0])) {
    EXPECT_EQ(corner[2], 0);
    EXPECT_TRUE(corner[0] < -0.5 || corner[0] > 1.4);
    EXPECT_TRUE(corner[1] < -0.5 || corner[1] > 2.3);
  }
}

TEST(SpherePicture, ArrowsAcrossAndColoursAlong) {
  const SpherePacking p = on_a_floor();
  const View view = view_along(2);
  const SphereMotion motion{p.bodies.velocity, {}};
  const MotionScale scale = motion_scale(motion, view);
  EXPECT_EQ(scale.largest, 1);
  EXPECT_NEAR(scale.unit, std::sqrt(2.0 / 3), 1e-15);  // rms speed
  EXPECT_EQ(scale.spin_limit, 1);
  const RecordingCanvas canvas = recorded(picture(p, view, sphere_motion_content(motion, view, scale)));
  std::vector<Polygon> arrows;
  for (const auto& a : canvas.areas)
    if (a.group == "spheres") arrows.push_back(a.corners);
  ASSERT_EQ(arrows.size(), 1u);  // one moves away from the viewer, one rests
  EXPECT_GT(arrows[0][3][0], arrows[0][0][0]);
  int away = 0;
  for (const auto& b : balls(canvas))
    for (int level = 0; level < SpherePen::kLevels; ++level)
      away += b.color == SpherePen::faded(diverging(-1), level, 0.62);
  EXPECT_EQ(away, 1);
}

TEST(SpherePicture, CellsOfASeriesAreConcentric) {
  SpherePacking large = disjoint_spheres(9, 30), small = disjoint_spheres(9, 30, {{4, 3, 2.5}});
  const View view = view_from(-60, 20);
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  for (const SpherePacking& p : {large, small})
    subjects.push_back(std::make_unique<SphereSubject>(p, SphereView{view, depth_range(p, view)}, plain_balls(p)));
  const PictureSeries series(std::move(subjects), {}, {plain("a"), plain("b")});
  std::array<Vec2, 2> centre{};
  for (std::size_t k = 0; k < 2; ++k) {
    RecordingCanvas canvas;
    series.draw_packing(canvas, k);
    canvas.finish();
    for (const auto& l : canvas.lines)
      if (l.group == "cell") centre[k] += (l.points[0] + l.points[1]) / 24.0;
  }
  EXPECT_NEAR(norm(centre[0] - centre[1]), 0, 1e-9);
}

TEST(SphereSlice, CutsExactCircles) {
  SpherePacking p;
  add(p, {{1, 2, 3}}, 1, {{4, 5, 6}}), add(p, {{5, 5, 4}}, 1), add(p, {{0, 0, 3.6}}, 1.5);
  const SlicedSpheres s = cut(p, {2, 3.6});
  ASSERT_EQ(s.sphere, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_NEAR(s.packing.bodies.radius[0], 0.8, 1e-15);
  EXPECT_NEAR(s.packing.bodies.radius[1], std::sqrt(0.84), 1e-15);
  EXPECT_EQ(s.packing.bodies.radius[2], 1.5);
  EXPECT_EQ(s.packing.bodies.position[0], (Vec2{{1, 2}}));
  EXPECT_EQ(s.packing.bodies.velocity[0], (Vec2{{4, 5}}));
  EXPECT_EQ(cut(p, {0, 1}).packing.bodies.position[0], (Vec2{{2, 3}}));
  EXPECT_EQ(cut(p, {1, 2}).packing.bodies.position[0], (Vec2{{1, 3}}));
  EXPECT_EQ(cut(p, {2, 5}).sphere, (std::vector<std::size_t>{2}));  // the second is touched in a point
  EXPECT_TRUE(cut(p, {2, 9}).sphere.empty());
}

TEST(SphereSlice, SeesEveryImage) {
  SpherePacking p;
  p.cell = PeriodicCell<3>{{{6, 6, 1.6}}};
  add(p, {{1, 2, 0.1}}, 1), add(p, {{3, 2, 9.8}}, 0.5);
  p.links = {link_of(0, 1, -2, {{3, 4, 0}}, {0, 0, -6})};
  for (const double at : {1.5, 1.5 - 1.6, 1.5 + 16, 1.5 + 1.6e9}) {
    const SlicedSpheres s = cut(p, {2, at});
    // the first from below (1.4 away from 0.1: no) and above (at 1.7, 0.2 away); the second at 0.2, 1.3 and 0.3 away
    ASSERT_EQ(s.sphere, (std::vector<std::size_t>{0, 1})) << at;
    EXPECT_NEAR(s.packing.bodies.radius[0], std::sqrt(1 - 0.04), 1e-6);
    EXPECT_NEAR(s.packing.bodies.radius[1], 0.4, 1e-6);
    ASSERT_EQ(s.packing.links.size(), 1u);
    EXPECT_EQ(s.packing.links[0].normal_force, -2);
    EXPECT_EQ(s.packing.links[0].tangential_force, 5);
  }
  EXPECT_EQ(cut(p, {2, 0.9}).sphere, (std::vector<std::size_t>{0, 0}));  // larger than the cell is high
}

// Slices all through a packing add up to its volume (Delesse).
TEST(SphereSlice, AddsUpToTheVolume) {
  const SpherePacking p = disjoint_spheres(4);
  double volume = 0;
  for (const double r : p.bodies.radius) volume += 4.0 / 3 * std::numbers::pi * r * r * r;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr int kSlices = 400;
    double sum = 0;
    for (int n = 0; n < kSlices; ++n)
      for (const double r : cut(p, {axis, (n + 0.5) * p.cell->length[axis] / kSlices}).packing.bodies.radius)
        sum += std::numbers::pi * r * r * p.cell->length[axis] / kSlices;
    EXPECT_NEAR(sum, volume, 1e-4 * volume);
  }
}

// Sections of a leaning cell across z lean with it, across y they do not: branch vectors of the circles are those of
// the spheres, seen along the axis; and slices add up to the volume.
TEST(SphereSlice, OfALeaningCell) {
  const SpherePacking p = leaning(disjoint_spheres(4), 1.75);
  double volume = 0;
  for (const double r : p.bodies.radius) volume += 4.0 / 3 * std::numbers::pi * r * r * r;
  for (const int axis : {1, 2}) {
    const View view = view_along(axis);
    const double edge = p.cell->length[axis];
    constexpr int kSlices = 400;
    double sum = 0;
    std::size_t links = 0;
    for (int n = 0; n < kSlices; ++n) {
      const double at = (n + 0.5) * edge / kSlices;
      const SlicedSpheres s = cut(p, {axis, at});
      const Packing<2>& flat = s.packing;
      EXPECT_EQ(flat.cell->tilt, axis == 2 ? 1.75 : 0);
      for (const double r : flat.bodies.radius) sum += std::numbers::pi * r * r * edge / kSlices;
      // Any plane that is whole cells away shows the same, shifted as its images are.
      const SlicedSpheres up = cut(p, {axis, at + 3 * edge});
      ASSERT_EQ(up.sphere, s.sphere);
      for (std::size_t k = 0; k < s.sphere.size(); ++k)
        EXPECT_NEAR(up.packing.bodies.position[k][0] - flat.bodies.position[k][0], axis == 1 ? 3 * 1.75 : 0, 1e-9);
      for (const Link<2>& l : flat.links) {
        const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
        const Vec2 branch = flat.bodies.position[j] + flat.cell->offset(l.shift) - flat.bodies.position[i];
        bool found = false;
        for (const Link<3>& whole : p.links) {
          const auto a = static_cast<std::size_t>(whole.i), b = static_cast<std::size_t>(whole.j);
          if (a != s.sphere[i] || b != s.sphere[j]) continue;
          const Vec3 r = p.bodies.position[b] + p.cell->offset(whole.shift) - p.bodies.position[a];
          found = found || norm(view.flat(r) - branch) < 1e-9;
        }
        EXPECT_TRUE(found);
        ++links;
      }
    }
    EXPECT_NEAR(sum, volume, 1e-4 * volume);
    EXPECT_GT(links, 100u);
  }
  EXPECT_THROW(cut(p, {0, 1}), std::invalid_argument);
  recorded(picture(p, Slice{2, 1}, grains_content())), recorded(picture(p, Slice{1, 1}, grains_content()));
}

TEST(SlicePicture, WallsAreLinesAndCircles) {
  SpherePacking p = on_a_floor();
  p.walls.push_back({WallShape::shell, {{0, 0, 1}}, {}, 3, {}, 0});
  const RecordingCanvas canvas = recorded(picture(p, Slice{1, 0.25}, grains_content()));
  double scale = 0, floor = 0;
  for (const auto& d : canvas.drawn_disks)
    if (d.group == "disks" && d.mark.radius > scale) scale = d.mark.radius, floor = d.mark.center[1];
  scale /= std::sqrt(0.25 - 0.0625);
  std::vector<std::vector<Vec2>> walls;
  for (const auto& l : canvas.lines)
    if (l.group == "walls") walls.push_back(l.points);
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_NEAR(walls[0][0][1], walls[0][1][1], 1e-9);
  EXPECT_LT(std::min(std::abs(walls[0][0][1] - floor - 0.45 * scale), std::abs(walls[0][0][1] - floor - 0.5 * scale)),
            1e-9);
  double left = INFINITY, right = -INFINITY;
  for (const Vec2& at : walls[1]) left = std::min(left, at[0]), right = std::max(right, at[0]);
  EXPECT_NEAR(right - left, 2 * std::sqrt(9 - 0.0625) * scale, 1e-9);
}

// An empty slice is a frame of a film like the others.
TEST(SlicePicture, MayBeEmpty) {
  const SpherePacking p = on_a_floor();
  const PictureSeries full = picture(p, Slice{2, 0.5}, grains_content()),
                      empty = picture(p, Slice{2, 7}, grains_content());
  EXPECT_EQ(full.page(), empty.page());
  EXPECT_TRUE(std::none_of(recorded(empty).drawn_disks.begin(), recorded(empty).drawn_disks.end(),
                           [](const auto& d) { return d.group == "disks"; }));
}

TEST(SvgCanvas, OneGradientAColour) {
  const auto canvas = make_svg_canvas({{100, 100}});
  const std::array mark{DiskMark{{{10, 20}}, 5}};
  canvas->balls(mark, kGrain), canvas->balls(mark, kRattler), canvas->balls(mark, kGrain);
  const std::string text = canvas->finish();
  std::size_t gradients = 0, circles = 0;
  for (std::size_t at = 0; (at = text.find("<radialGradient id=", at)) != std::string::npos; ++at) ++gradients;
  for (std::size_t at = 0; (at = text.find("<circle cx=\"10\" cy=\"20\" r=\"5\"/>", at)) != std::string::npos; ++at)
    ++circles;
  EXPECT_EQ(gradients, 2u);
  EXPECT_EQ(circles, 3u);
  EXPECT_NE(text.find("<g fill=\"url(#ball1)\">"), text.rfind("<g fill=\"url(#ball1)\">"));
}

// With ISOSTAT_REGENERATE=1 the approved pictures are written anew: look at them before they are committed.
void expect_approved(const std::string& picture, const std::string& name) {
  const auto path = std::filesystem::path(ISOSTAT_DATA).parent_path() / "tests/golden/pictures" / name;
  if (std::getenv("ISOSTAT_REGENERATE")) std::ofstream(path, std::ios::binary) << picture;
  std::ostringstream approved;
  approved << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_EQ(picture_difference(approved.str(), picture), "") << name;
}

TEST(SpherePicture, Approved) {
  SpherePacking p = disjoint_spheres(2, 60, {{3, 2.5, 2}});
  const View view = view_from(-60, 20);
  expect_approved(svg(picture(p, view, plain_balls(p))), "spheres-grains.svg");
  const SphereMotion motion{p.bodies.velocity, rich("`a`/`T`_{0}")};
  expect_approved(svg(picture(p, view, sphere_motion_content(motion, view, motion_scale(motion, view)))),
                  "spheres-velocity.svg");
  expect_approved(svg(picture(p, Slice{2, 1}, grains_content())), "spheres-slice.svg");
  const SpherePacking floor = on_a_floor();
  ForceOptions options;
  options.scale = 2, options.width_at_scale = 0.1, options.rattler = {false, false, true};
  expect_approved(svg(picture(floor, view, sphere_forces_content(options))), "spheres-forces.svg");
}

}  // namespace
}  // namespace isostat
