// Pictures of triangles for ParaView.
#include "dem/triangles/vtp.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dem/triangles/at_rest.hpp"
#include "tests/support/triangle_state.hpp"
#include "tests/support/vtk_array.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

TEST(TriangleVtp, PolygonsAreTheTrianglesWithTheirGrainsInTheCell) {
  const TrianglePacking p = random_triangle_state(3).packing;
  const std::string vtp = vtk_polydata(p, 0.25);
  const auto points = oracle::vtk_array<double>(vtp, "Points"), pressure = oracle::vtk_array<double>(vtp, "pressure");
  const auto corner = oracle::vtk_array<std::int64_t>(vtp, "connectivity", "<Polys>");
  EXPECT_EQ(oracle::vtk_array<double>(vtp, "TimeValue", "<FieldData>"), (std::vector<double>{0.25}));
  EXPECT_EQ(oracle::vtk_array<std::int64_t>(vtp, "id"), p.bodies.id);
  EXPECT_EQ(oracle::vtk_array<double>(vtp, "spin"), p.bodies.spin);
  EXPECT_EQ(oracle::vtk_array<std::int8_t>(vtp, "part"), (std::vector<std::int8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 2}));
  EXPECT_THAT(vtp, HasSubstr("NumberOfPoints=\"30\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                             "NumberOfPolys=\"10\""));
  ASSERT_EQ(corner.size(), 30u);
  const std::vector<std::int32_t> of = grain_of(p.grains);
  const auto grain = oracle::vtk_array<std::int64_t>(vtp, "grain");
  const auto ends = oracle::vtk_array<std::int64_t>(vtp, "offsets", "<Polys>");
  for (std::size_t k = 0; k < 10; ++k) {
    const auto g = static_cast<std::size_t>(of[k]);
    EXPECT_EQ(grain[k], p.grains.id[g]);
    EXPECT_EQ(ends[k], static_cast<std::int64_t>(3 * k + 3));
    EXPECT_EQ(pressure[k], overlap_pressures(p)[g]);
    Vec2 now{}, placed{};  // sums of corners: the grain is moved by whole cells
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(corner[3 * k + c]);
      placed += Vec2{{points[3 * at], points[3 * at + 1]}}, now += corners_of(p, k)[c];
    }
    for (int a = 0; a < 2; ++a) {
      const double cells = (placed[a] - now[a]) / (3 * p.cell->length[a]);
      EXPECT_NEAR(cells, std::round(cells), 1e-12);
    }
  }
}

// A square between two forces F on opposite sides, a distance d apart: p = F d / (2 A).
TEST(TriangleVtp, PressureIsThatOfTheOverlaps) {
  TrianglePacking p = random_triangle_state(4).packing;
  const auto [length_1, length_2] = p.cell->length.c;
  p.overlaps.resize(2);
  const std::size_t begin = 5, end = 9;  // of grain 2
  Vec2 centre{};
  for (std::size_t k = begin; k < end; ++k) centre += 0.25 * p.bodies.position[k];
  const double area = grain_area(p, 2), force = 7, half = 0.06;
  p.overlaps[0] = {0, 2, {}, 1e-4, force, {{1, 0}}, centre - Vec2{{half, 0}}, 0};  // pushes along x from the left
  p.overlaps[1] = {2, 3, {1, -1}, 1e-4, force, {{1, 0}}, centre + Vec2{{half, 0}}, 0};
  EXPECT_NEAR(overlap_pressures(p)[2], force * 2 * half / (2 * area), 1e-9);
  const Vec2 far = p.bodies.position[9] + Vec2{{length_1, -length_2}};  // the image of grain 3
  EXPECT_NEAR(overlap_pressures(p)[3], -force * (p.overlaps[1].point[0] - far[0]) / (2 * grain_area(p, 3)), 1e-9);
  p.overlaps[0].tangential_force = 2, p.overlaps[1].tangential_force = -2;  // turns, and presses nothing
  EXPECT_NEAR(overlap_pressures(p)[2], force * 2 * half / (2 * area), 1e-9);
}

}  // namespace
}  // namespace isostat
