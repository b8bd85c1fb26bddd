// Pictures of several packings: equal pages, one scale; films and stroboscopic pictures.
#include "analysis/figure/picture_series.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <stdexcept>

#include "analysis/figure/film_canvas.hpp"
#include "tests/support/recording_canvas.hpp"

namespace isostat {
namespace {

using oracle::RecordingCanvas;

Packing<2> disk_at(const Vec2& place, std::optional<PeriodicCell<2>> cell = std::nullopt) {
  Packing<2> p;
  p.cell = cell;
  p.bodies.resize(2);
  p.bodies.position = {{{0, 0}}, place};
  p.bodies.radius = {0.5, 0.5};
  return p;
}

PictureSeries series_of(const std::vector<Packing<2>>& packings, bool captions = true) {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  std::vector<RichText> texts;
  for (const Packing<2>& p : packings) {
    subjects.push_back(std::make_unique<DiskSubject>(p, grains_content()));
    if (captions) texts.push_back(plain("frame " + std::to_string(texts.size())));
  }
  return PictureSeries(std::move(subjects), {}, std::move(texts));
}

RecordingCanvas page(const PictureSeries& series, std::size_t k) {
  RecordingCanvas canvas;
  series.draw_packing(canvas, k);
  series.draw_legend(canvas);
  canvas.finish();
  return canvas;
}

TEST(PictureSeries, OneWindowAroundAll) {
  const std::vector<Packing<2>> packings{disk_at({{3, 0}}), disk_at({{0, 5}}), disk_at({{-2, 1}})};
  const PictureSeries series = series_of(packings);
  std::vector<RecordingCanvas> pages;
  for (std::size_t k = 0; k < 3; ++k) pages.push_back(page(series, k));
  const double scale = 2 * pages[0].drawn_disks[0].mark.radius;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& disks = pages[k].drawn_disks;
    EXPECT_EQ(disks[0].mark.center, pages[0].drawn_disks[0].mark.center);  // the disk that rests
    const Vec2 r = packings[k].bodies.position[1], d = disks[1].mark.center - disks[0].mark.center;
    EXPECT_NEAR(d[0], scale * r[0], 1e-9);
    EXPECT_NEAR(d[1], -scale * r[1], 1e-9);
    for (const auto& disk : disks) {
      EXPECT_GE(disk.mark.center[0] - disk.mark.radius, 0);
      EXPECT_LE(disk.mark.center[0] + disk.mark.radius, series.page()[0]);
      EXPECT_GE(disk.mark.center[1] - disk.mark.radius, 0);
      EXPECT_LE(disk.mark.center[1] + disk.mark.radius, series.page()[1]);
    }
    int captions = 0;
    for (const auto& t : pages[k].texts) captions += t.plain() == "frame " + std::to_string(k);
    EXPECT_EQ(captions, 1);
  }
}

// A cell that shrinks keeps its centre and the scale.
TEST(PictureSeries, CellsAreConcentric) {
  const std::vector<Packing<2>> packings{disk_at({{3, 3}}, PeriodicCell<2>{{{8, 6}}}),
                                         disk_at({{3, 3}}, PeriodicCell<2>{{{6, 5}}})};
  const PictureSeries series = series_of(packings);
  std::vector<Rect> cells;
  for (std::size_t k = 0; k < 2; ++k)
    for (const auto& box : page(series, k).boxes)
      if (box.group == "cell") cells.push_back(box.rect);
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_NEAR(cells[1].width / cells[0].width, 6.0 / 8, 1e-12);
  EXPECT_NEAR(cells[1].height / cells[0].height, 5.0 / 6, 1e-12);
  EXPECT_NEAR(cells[0].x + cells[0].right(), cells[1].x + cells[1].right(), 1e-9);
  EXPECT_NEAR(cells[0].y + cells[0].bottom(), cells[1].y + cells[1].bottom(), 1e-9);
}

TEST(PictureSeries, StroboscopicFadesThePast) {
  const std::vector<Packing<2>> packings{disk_at({{3, 0}}), disk_at({{4, 0}}), disk_at({{5, 0}})};
  RecordingCanvas canvas;
  series_of(packings, false).draw_stroboscopic(canvas);
  canvas.finish();
  ASSERT_EQ(canvas.drawn_disks.size(), 6u);
  const auto fill = [&](std::size_t k) { return *canvas.drawn_disks[2 * k].paint.fill; };
  EXPECT_EQ(fill(2), kGrain);  // last, on top, in full strength
  EXPECT_GT(fill(0).blue, fill(1).blue);
  EXPECT_GT(fill(1).blue, fill(2).blue);
  EXPECT_LT(fill(0).blue, 1);
  EXPECT_LT(canvas.drawn_disks[1].mark.center[0], canvas.drawn_disks[5].mark.center[0]);
}

std::string film(FilmKind kind, const PictureSeries& series) {
  FilmCanvas canvas(kind, series.page(), series.size(), 5);
  series.draw_legend(canvas);
  for (std::size_t k = 0; k < series.size(); ++k) {
    canvas.begin_frame();
    series.draw_packing(canvas, k);
    canvas.end_frame();
  }
  return canvas.finish();
}

std::size_t count(const std::string& text, const std::string& pattern) {
  const std::regex r(pattern);
  return static_cast<std::size_t>(std::distance(std::sregex_iterator(text.begin(), text.end(), r), {}));
}

TEST(FilmCanvas, OneFrameShowsAtATime) {
  const PeriodicCell<2> cell{{{8, 8}}};
  const std::vector<Packing<2>> packings{disk_at({{3, 3}}, cell), disk_at({{4, 4}}, cell), disk_at({{5, 5}}, cell)};
  const PictureSeries series = series_of(packings);
  for (const FilmKind kind : {FilmKind::svg, FilmKind::html}) {
    const std::string text = film(kind, series);
    EXPECT_EQ(count(text, "<g class=\"frame\""), 3u);
    EXPECT_EQ(count(text, "<g class=\"frame\" display=\"none\""), 2u);
    EXPECT_EQ(count(text, "<g[ >]"), count(text, "</g>"));
    EXPECT_EQ(count(text, "frame [012]<"), 3u);
    EXPECT_EQ(count(text, "https?://"), 1u);  // the name of SVG's elements; nothing is fetched
    EXPECT_EQ(count(text, "(src|href)="), 0u);
    std::set<std::string> ids;
    const std::regex id(" id=\"([^\"]*)\"");
    for (std::sregex_iterator m(text.begin(), text.end(), id), end; m != end; ++m)
      EXPECT_TRUE(ids.insert((*m)[1]).second) << (*m)[1];
  }
}

// Each frame is visible for its third of 0.6 s.
TEST(FilmCanvas, SvgMovesByItself) {
  const std::vector<Packing<2>> packings{disk_at({{3, 0}}), disk_at({{4, 0}}), disk_at({{5, 0}})};
  const std::string text = film(FilmKind::svg, series_of(packings));
  EXPECT_EQ(
      count(text, "<animate attributeName=\"display\" calcMode=\"discrete\" repeatCount=\"indefinite\" dur=\"0.6s\""),
      3u);
  EXPECT_EQ(count(text, "values=\"inline;none\" keyTimes=\"0;0.333333\""), 1u);
  EXPECT_EQ(count(text, "values=\"none;inline;none\" keyTimes=\"0;0.333333;0.666667\""), 1u);
  EXPECT_EQ(count(text, "values=\"none;inline\" keyTimes=\"0;0.666667\""), 1u);
  EXPECT_EQ(count(text, "<script"), 0u);
  EXPECT_TRUE(text.ends_with("</svg>\n"));
}

// What rests is written once.
TEST(FilmCanvas, UsesAGroupAgain) {
  FilmCanvas canvas(FilmKind::svg, {{100, 100}}, 3, 5);
  for (int k = 0; k < 3; ++k) {
    canvas.begin_frame();
    canvas.begin_group("walls");
    for (int n = 0; n < 4; ++n) canvas.rectangle({10.0 * n + (k == 2 ? 1 : 0), 0, 5, 5}, {kWall, std::nullopt});
    canvas.end_group();
    canvas.end_frame();
  }
  const std::string text = canvas.finish();
  EXPECT_EQ(count(text, "<g id=\"walls"), 2u);
  EXPECT_EQ(count(text, "<use href=\"#walls\"/>"), 1u);
  EXPECT_LT(text.find("<use"), text.find("x=\"11\""));
}

// A page that was asked for: that size to the point, whatever the packing, and everything on it.
TEST(PictureSeries, PagesOfAGivenSize) {
  for (const Vec2& wanted : {Vec2{{500, 400}}, Vec2{{300, 900}}})
    for (const Packing<2>& packing :
         {disk_at({{30, 0}}), disk_at({{0, 5}}), disk_at({{1, 1}}, PeriodicCell<2>{{{4, 9}}})}) {
      std::vector<std::unique_ptr<PictureSubject>> subjects;
      subjects.push_back(std::make_unique<DiskSubject>(packing, grains_content()));
      const PictureSeries series(std::move(subjects), {}, {}, wanted);
      EXPECT_EQ(series.page(), wanted);
      const RecordingCanvas canvas = page(series, 0);
      ASSERT_GE(canvas.drawn_disks.size(), 2u);
      if (packing.cell) continue;  // images are cut off
      for (const auto& disk : canvas.drawn_disks)
        for (int k = 0; k < 2; ++k) {
          EXPECT_GE(disk.mark.center[k] - disk.mark.radius, 0);
          EXPECT_LE(disk.mark.center[k] + disk.mark.radius, wanted[k]);
        }
    }
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  subjects.push_back(std::make_unique<DiskSubject>(disk_at({{1, 0}}), grains_content()));
  EXPECT_THROW(PictureSeries(std::move(subjects), {}, {}, Vec2{{300, 20}}), std::invalid_argument);
}

}  // namespace
}  // namespace isostat
