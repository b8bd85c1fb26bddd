// The files themselves: SVG by its text, PDF and PNG by what they begin with and what their pixels show.
#include "analysis/figure/canvas.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>

#include "analysis/figure/figure_file.hpp"
#include "dem/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(SvgCanvas, DisksAreCirclesAndLinksAreSubPaths) {
  const auto canvas = make_svg_canvas({{200, 100}});
  canvas->begin_group("a & b");
  const std::array disks{DiskMark{{{10.256, 20}}, 3.14159}, DiskMark{{{-1, 50.5}}, 2}};
  canvas->disks(disks, {kUnstressed, Stroke{kInk, 0.5, {}}});
  const std::array links{SegmentMark{{{1, 2}}, {{4, 6}}, 1.5}, SegmentMark{{{0, 0}}, {{1, 1}}, 1.5},
                         SegmentMark{{{0, 0}}, {{-1, 1}}, 0.25}};
  canvas->segments(links, kCompressive);
  canvas->end_group();
  const std::string svg = canvas->finish();
  EXPECT_NE(svg.find("viewBox=\"0 0 200 100\""), std::string::npos);
  EXPECT_NE(svg.find("<g id=\"a &amp; b\">"), std::string::npos);
  EXPECT_NE(svg.find("<circle cx=\"10.26\" cy=\"20\" r=\"3.142\"/>"), std::string::npos);
  EXPECT_NE(svg.find("<path stroke-width=\"1.5\" d=\"M1,2l3,4M0,0l1,1\"/>"), std::string::npos);
  EXPECT_NE(svg.find("<path stroke-width=\"0.25\" d=\"M0,0l-1,1\"/>"), std::string::npos);
  EXPECT_EQ(count(svg, "<g"), count(svg, "</g>"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(SvgCanvas, TextKeepsItsScripts) {
  const auto canvas = make_svg_canvas({{200, 100}});
  canvas->text({{5, 7}}, rich("`F`_{0} < 10^{-4} & more"), {10, Anchor::middle, kInk, false});
  const std::string svg = canvas->finish();
  EXPECT_NE(svg.find("text-anchor=\"middle\""), std::string::npos);
  EXPECT_NE(svg.find("<tspan font-style=\"italic\">F</tspan><tspan dy=\"1.8\" font-size=\"7.2\">0</tspan>"
                     "<tspan dy=\"-1.8\"> &lt; 10</tspan>"),
            std::string::npos)
      << svg;
}

// Parsers of XML refuse attributes of 10 MB.
TEST(SvgCanvas, SplitsLongPaths) {
  const auto canvas = make_svg_canvas({{200, 100}});
  const std::vector<SegmentMark> links(100000, {{{1.25, 2.5}}, {{4.75, 6}}, 1});
  canvas->segments(links, kInk);
  const std::vector<Polygon> triangles(30000, {{{1.25, 2.5}}, {{4.75, 6}}, {{4.75, 7}}});
  canvas->polygons(triangles, {kInk, std::nullopt});
  const std::string svg = canvas->finish();
  EXPECT_EQ(count(svg, "M1.25,2.5l"), links.size());
  EXPECT_EQ(count(svg, "Z"), triangles.size());
  std::size_t longest = 0;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t end = svg.find('"', at);
    longest = std::max(longest, std::min(end, svg.size()) - at);
    at = end == std::string::npos ? svg.size() : end + 1;
  }
  EXPECT_LT(longest, 300000u);
}

struct Image {
  int width, height;
  std::vector<std::uint32_t> pixels;
};

cairo_status_t take(void* source, unsigned char* data, unsigned length) {
  auto& rest = *static_cast<std::string_view*>(source);
  if (rest.size() < length) return CAIRO_STATUS_READ_ERROR;
  std::copy_n(rest.data(), length, data);
  rest.remove_prefix(length);
  return CAIRO_STATUS_SUCCESS;
}

Image read_png(const std::string& bytes) {
  std::string_view rest = bytes;
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(take, &rest);
  Image image{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.pixels.push_back(*reinterpret_cast<const std::uint32_t*>(data + y * stride + 4 * x) & 0xffffff);
  cairo_surface_destroy(surface);
  return image;
}

// Two pixels a point; y downwards; later marks over earlier ones; a clip cuts.
TEST(PngCanvas, PixelsAreWhereTheMarksAre) {
  const auto canvas = make_png_canvas({{60, 40}});
  canvas->clip({0, 0, 30, 40});
  canvas->disks(std::array{DiskMark{{{30, 10}}, 8}}, {kCompressive, std::nullopt});
  canvas->unclip();
  canvas->segments(std::array{SegmentMark{{{5, 30}}, {{55, 30}}, 4}}, kDistant);
  canvas->text({{2, 20}}, plain("text leaves no point behind"), {4, Anchor::start, kInk, false});
  canvas->polyline(std::array{Vec2{{50, 5}}, Vec2{{50, 15}}}, {kTensile, 2, {}});
  const Image image = read_png(canvas->finish());
  ASSERT_EQ(image.width, 120);
  ASSERT_EQ(image.height, 80);
  const auto at = [&](double x, double y) {
    return image.pixels[static_cast<std::size_t>(2 * y) * 120 + static_cast<std::size_t>(2 * x)];
  };
  EXPECT_EQ(at(26, 10), 0xd7191cu);
  EXPECT_EQ(at(34, 10), 0xffffffu);  // cut off
  EXPECT_EQ(at(30, 30), 0x2b6fdbu);
  EXPECT_EQ(at(30, 33), 0xffffffu);
  EXPECT_EQ(at(50, 10), 0x12964au);
  EXPECT_EQ(at(45, 12), 0xffffffu);
}

class FigureFiles : public ::testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return folder_ / name; }
  std::size_t files() const { return folder_.entries(); }
  TemporaryFolder folder_;
};

TEST_F(FigureFiles, FormatByExtension) {
  for (const auto& [name, head] : {std::pair{"a.svg", "<?xml"}, {"a.pdf", "%PDF-"}, {"a.png", "\x89PNG"}}) {
    const FigureFile file(in_folder(name));
    const auto canvas = file.canvas({{50, 50}});
    canvas->rectangle({1, 1, 5, 5}, {kInk, std::nullopt});
    file.write(*canvas);
    std::ifstream in(in_folder(name), std::ios::binary);
    std::string begin(std::string(head).size(), ' ');
    in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    EXPECT_EQ(begin, head);
  }
  EXPECT_EQ(files(), 3u);
}

TEST_F(FigureFiles, RefusesBeforeAnythingIsDrawn) {
  EXPECT_THROW(FigureFile(in_folder("a.gif")), InputError);
  EXPECT_THROW(FigureFile(in_folder("svg")), InputError);
  EXPECT_THROW(FigureFile(in_folder("nowhere/a.svg")), InputError);
  std::filesystem::create_directory(in_folder("b.svg"));
  EXPECT_THROW(FigureFile(in_folder("b.svg")), InputError);
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace isostat
