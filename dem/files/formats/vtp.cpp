#include "dem/files/formats/vtp.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "dem/files/formats/vtk_arrays.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

Vec3 spatial(double spin) { return {{0, 0, spin}}; }
Vec3 spatial(const Vec2& v) { return {{v[0], v[1], 0}}; }
Vec3 spatial(const Vec3& v) { return v; }
double squared(double t) { return t * t; }
double squared(const Vec3& t) { return dot(t, t); }

void push(std::vector<double>& a, const Vec3& v) { a.insert(a.end(), v.c.begin(), v.c.end()); }
void push_value(std::vector<double>& a, double v) { a.push_back(v); }
void push_value(std::vector<double>& a, const Vec3& v) { push(a, v); }

template <int D>
struct Points {
  std::vector<double> position, radius, mass, velocity, spin;
  std::vector<std::int64_t> id;
  std::vector<std::int8_t> image;
  std::vector<std::int32_t> group;
  void add(const Bodies<D>& b, std::size_t k, const Vec<D>& place, std::int8_t is_image,
           const std::vector<std::int32_t>& groups) {
    if (!groups.empty()) group.push_back(groups[k]);
    push(position, spatial(place)), push(velocity, spatial(b.velocity[k])), push(spin, spatial(b.spin[k]));
    radius.push_back(b.radius[k]), mass.push_back(b.mass[k]), id.push_back(b.id[k]);
    image.push_back(is_image);
  }
};

template <int D>
struct Cells {
  std::vector<std::int8_t> kind;
  std::vector<double> gap, normal, tangential, moment, total;
  void add(std::int8_t code, const Link<D>& l) {
    kind.push_back(code);
    gap.push_back(l.gap), normal.push_back(l.normal_force);
    push_value(tangential, l.tangential_force), push_value(moment, l.moment);
    total.push_back(std::sqrt(l.normal_force * l.normal_force + squared(l.tangential_force)));
  }
};

}  // namespace

template <int D>
std::string vtk_polydata(const Packing<D>& packing, double time, const VtkExtras<D>& extras) {
  const Bodies<D>& b = packing.bodies;
  Points<D> points;
  Cells<D> cells;
  std::vector<Vec<D>> place(b.size());
  std::vector<std::int64_t> vertices, vertex_ends, lines, line_ends;
  for (std::size_t k = 0; k < b.size(); ++k) {
    place[k] = packing.cell ? packing.cell->wrap(b.position[k]) : b.position[k];
    points.add(b, k, place[k], 0, extras.group);
    cells.add(-1, Link<D>{});
    vertices.push_back(static_cast<std::int64_t>(k));
    vertex_ends.push_back(static_cast<std::int64_t>(k) + 1);
  }
  for (const Link<D>& l : packing.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    const Vec<D> end = branch(packing, i, j, l.shift) + place[i];
    // Wrapping i and j apart may differ from the branch vector by whole cells, or by rounding alone.
    bool inside = true;
    for (int k = 0; k < D; ++k)
      inside = inside && (!packing.cell || std::abs(end[k] - place[j][k]) < 0.5 * packing.cell->length[k]);
    lines.push_back(static_cast<std::int64_t>(i));
    lines.push_back(static_cast<std::int64_t>(inside ? j : points.id.size()));
    line_ends.push_back(static_cast<std::int64_t>(lines.size()));
    if (!inside) points.add(b, j, end, 1, extras.group);
    cells.add(static_cast<std::int8_t>(l.kind), l);
  }
  for (const auto& [link, reach] : extras.feet) {
    const auto i = static_cast<std::size_t>(link.i);
    lines.push_back(static_cast<std::int64_t>(i));
    lines.push_back(static_cast<std::int64_t>(points.id.size()));
    line_ends.push_back(static_cast<std::int64_t>(lines.size()));
    points.add(b, i, place[i] + reach, 2, extras.group);
    cells.add(static_cast<std::int8_t>(link.kind), link);
  }

  const std::string head = vtk_polydata_head(time);
  const std::string counts = "<Piece NumberOfPoints=\"" + std::to_string(points.id.size()) + "\" NumberOfVerts=\"" +
                             std::to_string(b.size()) + "\" NumberOfLines=\"" + std::to_string(line_ends.size()) +
                             "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  constexpr int vector_size = D == 2 ? 1 : 3;
  std::string xml =
      head + counts + "<PointData Scalars=\"radius\" Vectors=\"velocity\">\n" + vtk_array("id", points.id) +
      vtk_array("radius", points.radius) + vtk_array("mass", points.mass) + vtk_array("velocity", points.velocity, 3) +
      vtk_array("spin", points.spin, 3) + vtk_array("image", points.image) +
      (extras.group.empty() ? std::string() : vtk_array("group", points.group)) +
      "</PointData>\n<CellData Scalars=\"N\">\n" + vtk_array("kind", cells.kind) + vtk_array("gap", cells.gap) +
      vtk_array("N", cells.normal) + vtk_array("T", cells.tangential, vector_size) +
      vtk_array("M", cells.moment, vector_size) + vtk_array("F", cells.total) + "</CellData>\n<Points>\n" +
      vtk_array("Points", points.position, 3) + "</Points>\n<Verts>\n" + vtk_array("connectivity", vertices) +
      vtk_array("offsets", vertex_ends) + "</Verts>\n<Lines>\n" + vtk_array("connectivity", lines) +
      vtk_array("offsets", line_ends) + "</Lines>\n";
  return xml.append(kVtkPolydataTail);
}

template std::string vtk_polydata(const Packing<2>&, double, const VtkExtras<2>&);
template std::string vtk_polydata(const Packing<3>&, double, const VtkExtras<3>&);

}  // namespace isostat
