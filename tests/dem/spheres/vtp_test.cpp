// ParaView files of spheres: every field that a state has of a sphere, a link and a contact with a wall.
#include "dem/spheres/vtp.hpp"

#include <gtest/gtest.h>

#include "tests/support/sphere_states.hpp"
#include "tests/support/vtk_array.hpp"

namespace isostat {
namespace {

TEST(SphereVtp, HasWhatTheStateHas) {
  SpherePacking p;
  p.cell = PeriodicCell<3>{{{4, 5, 6}}};
  oracle::add_sphere(p, 0.5, {{0.3, 1, 0.4}}, {{1, 2, 3}}, {{4, 5, 6}});
  oracle::add_sphere(p, 0.25, {{3.6, 1, 0.4}});
  oracle::add_sphere(p, 0.5, {{1, 1, -0.5}});  // 5.5 in the cell
  p.group = {0, 2, 1};
  p.links.resize(1);
  p.links[0].i = 0, p.links[0].j = 1, p.links[0].shift = {-1, 0, 0};
  p.links[0].gap = -0.05, p.links[0].normal_force = 2;
  p.links[0].tangential_force = {{0, 1, -2}}, p.links[0].moment = {{7, 8, 9}};
  p.walls = {{WallShape::plane, {}, {{0, 0, 1}}, 0, {}, SphereWall::kEveryGroup},
             {WallShape::shell, {{1, 1, 0}}, {}, 0.9, {}, 1}};
  p.wall_links = {{0, 0, LinkKind::sliding, -0.1, 3, {{0.5, 0, 0}}}, {2, 1, LinkKind::closed, -0.1, 5, {}}};

  const std::string vtp = vtk_polydata(p, 1.5);
  const auto of = [&](const char* name) { return oracle::vtk_array<double>(vtp, name); };
  EXPECT_EQ(oracle::vtk_array<std::int64_t>(vtp, "id"),
            (std::vector<std::int64_t>{p.bodies.id[0], p.bodies.id[1], p.bodies.id[2], p.bodies.id[1], p.bodies.id[0],
                                       p.bodies.id[2]}));
  EXPECT_EQ(oracle::vtk_array<std::int32_t>(vtp, "group"), (std::vector<std::int32_t>{0, 2, 1, 2, 0, 1}));
  EXPECT_EQ(oracle::vtk_array<std::int8_t>(vtp, "image"), (std::vector<std::int8_t>{0, 0, 0, 1, 2, 2}));
  EXPECT_EQ(of("radius")[1], 0.25);
  EXPECT_EQ(of("mass")[2], p.bodies.mass[2]);
  const auto velocity = of("velocity"), spin = of("spin");
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(velocity[k], static_cast<double>(k + 1));
    EXPECT_EQ(spin[k], static_cast<double>(k + 4));
  }
  // cells: three spheres, a link, two contacts with walls
  EXPECT_EQ(oracle::vtk_array<std::int8_t>(vtp, "kind"), (std::vector<std::int8_t>{-1, -1, -1, 0, 1, 0}));
  EXPECT_EQ(of("N"), (std::vector<double>{0, 0, 0, 2, 3, 5}));
  const auto tangential = of("T"), moment = of("M");
  EXPECT_EQ(std::vector<double>(tangential.begin() + 9, tangential.begin() + 15),
            (std::vector<double>{0, 1, -2, .5, 0, 0}));
  EXPECT_EQ(std::vector<double>(moment.begin() + 9, moment.begin() + 12), (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(of("F")[3], 3);
  EXPECT_EQ(oracle::vtk_array<double>(vtp, "TimeValue", "<FieldData>"), (std::vector<double>{1.5}));

  const auto place = of("Points");
  const auto line = oracle::vtk_array<std::int64_t>(vtp, "connectivity", "<Lines>");
  ASSERT_EQ(line.size(), 6u);
  const auto at = [&](std::size_t end) {
    const std::size_t n = 3 * static_cast<std::size_t>(line[end]);
    return Vec3{{place[n], place[n + 1], place[n + 2]}};
  };
  EXPECT_NEAR(norm(at(1) - at(0) - Vec3{{-0.7, 0, 0}}), 0, 1e-14);
  EXPECT_NEAR(norm(at(3) - Vec3{{0.3, 1, 0}}), 0, 1e-14);           // under the sphere
  EXPECT_NEAR(norm(at(5) - at(4) - Vec3{{0, 0, -0.4}}), 0, 1e-14);  // out to the shell
}

TEST(SphereVtp, WithoutGroupsAllAreInOne) {
  SpherePacking p;
  oracle::add_sphere(p, 0.5, {{0, 0, 0}}), oracle::add_sphere(p, 0.5, {{2, 0, 0}});
  EXPECT_EQ(oracle::vtk_array<std::int32_t>(vtk_polydata(p, 0), "group"), (std::vector<std::int32_t>{0, 0}));
}

}  // namespace
}  // namespace isostat
