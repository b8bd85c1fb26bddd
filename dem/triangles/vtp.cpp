#include "dem/triangles/vtp.hpp"

#include <cstdint>

#include "dem/files/formats/vtk_arrays.hpp"
#include "dem/triangles/at_rest.hpp"

namespace isostat {
namespace {

std::size_t begin_of(const Grains& g, std::size_t k) { return static_cast<std::size_t>(g.begin[k]); }

Vec2 centre_of_mass(const TrianglePacking& p, std::size_t grain) {
  Vec2 sum{};
  double mass = 0;
  for (std::size_t k = begin_of(p.grains, grain); k < begin_of(p.grains, grain + 1); ++k)
    sum += p.bodies.mass[k] * p.bodies.position[k], mass += p.bodies.mass[k];
  return (1 / mass) * sum;
}

}  // namespace

std::vector<double> overlap_pressures(const TrianglePacking& p) {
  std::vector<double> pressure(p.grains.size(), 0.0);  // first -sum of force times arm
  for (const Overlap& o : p.overlaps) {
    const auto i = static_cast<std::size_t>(o.grain_i), j = static_cast<std::size_t>(o.grain_j);
    const Vec2 tangent{{-o.normal[1], o.normal[0]}};
    const Vec2 on_j = o.normal_force * o.normal + o.tangential_force * tangent;
    Vec2 centre_j = centre_of_mass(p, j);
    if (p.cell) centre_j += p.cell->offset(o.shift);
    pressure[i] += dot(on_j, o.point - centre_of_mass(p, i));
    pressure[j] -= dot(on_j, o.point - centre_j);
  }
  for (std::size_t g = 0; g < pressure.size(); ++g) pressure[g] /= 2 * grain_area(p, g);
  return pressure;
}

std::string vtk_polydata(const TrianglePacking& p, double time) {
  const std::size_t n = p.bodies.size();
  const std::vector<double> pressures = overlap_pressures(p);
  std::vector<double> points, pressure, velocity, spin;
  std::vector<std::int64_t> id, grain, connectivity, ends;
  std::vector<std::int8_t> part;
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    const Vec2 centre = centre_of_mass(p, g), move = p.cell ? p.cell->wrap(centre) - centre : Vec2{};
    for (std::size_t k = begin_of(p.grains, g); k < begin_of(p.grains, g + 1); ++k) {
      for (const Vec2& corner : corners_of(p, k)) {
        connectivity.push_back(static_cast<std::int64_t>(connectivity.size()));
        points.insert(points.end(), {corner[0] + move[0], corner[1] + move[1], 0.0});
      }
      ends.push_back(static_cast<std::int64_t>(connectivity.size()));
      id.push_back(p.bodies.id[k]), grain.push_back(p.grains.id[g]);
      part.push_back(static_cast<std::int8_t>(p.grains.part[g])), pressure.push_back(pressures[g]);
      velocity.insert(velocity.end(), {p.bodies.velocity[k][0], p.bodies.velocity[k][1], 0.0});
      spin.push_back(p.bodies.spin[k]);
    }
  }
  const std::string head = vtk_polydata_head(time);
  std::string xml = head + "<Piece NumberOfPoints=\"" + std::to_string(3 * n) +
                    "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
                    std::to_string(n) + "\">\n<CellData Scalars=\"pressure\" Vectors=\"velocity\">\n" +
                    vtk_array("id", id) + vtk_array("grain", grain) + vtk_array("part", part) +
                    vtk_array("pressure", pressure) + vtk_array("velocity", velocity, 3) + vtk_array("spin", spin) +
                    "</CellData>\n<Points>\n" + vtk_array("Points", points, 3) + "</Points>\n<Polys>\n" +
                    vtk_array("connectivity", connectivity) + vtk_array("offsets", ends) + "</Polys>\n";
  return xml.append(kVtkPolydataTail);
}

}  // namespace isostat
