// The only file that sees CGAL's triangulations. CGAL 5.5 has no periodic regular triangulation in the plane, so the
// sites of the cell are padded by their images and the stars of the originals are read off.
#include "geometry/power_triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<SiteImage, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using FaceBase = CGAL::Regular_triangulation_face_base_2<Kernel>;
using Triangulation = CGAL::Regular_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using WeightedPoint = Triangulation::Weighted_point;

struct Candidate {
  WeightedPoint point;
  SiteImage image;
};

struct SortTraits {  // what spatial_sort asks of points
  using Point_2 = const Candidate*;
  struct Less_x_2 {
    bool operator()(Point_2 a, Point_2 b) const { return a->point.x() < b->point.x(); }
  };
  struct Less_y_2 {
    bool operator()(Point_2 a, Point_2 b) const { return a->point.y() < b->point.y(); }
  };
  Less_x_2 less_x_2_object() const { return {}; }
  Less_y_2 less_y_2_object() const { return {}; }
};

std::vector<Candidate> padded(const PeriodicSites& sites) {
  std::vector<Candidate> all;
  const Vec2 length = sites.length;
  const double pad = sites.padding, slant = sites.tilt / length[1], pad_x = pad * std::sqrt(1 + slant * slant);
  const int reach_x = static_cast<int>(std::ceil(pad_x / length[0])),
            reach_y = static_cast<int>(std::ceil(pad / length[1]));
  for (std::size_t i = 0; i < sites.position.size(); ++i)
    for (int sx = -reach_x; sx <= reach_x; ++sx) {
      const double along = sites.position[i][0] + sx * length[0], from_edge = along - slant * sites.position[i][1];
      if (from_edge < -pad_x || from_edge > length[0] + pad_x) continue;
      for (int sy = -reach_y; sy <= reach_y; ++sy) {
        const double x = along + sy * sites.tilt, y = sites.position[i][1] + sy * length[1];
        if (y < -pad || y > length[1] + pad) continue;
        all.push_back({WeightedPoint({x, y}, sites.weight[i]), {static_cast<std::int32_t>(i), {sx, sy}}});
      }
    }
  return all;
}

Triangulation triangulate(const std::vector<Candidate>& candidates) {
  std::vector<const Candidate*> order;
  order.reserve(candidates.size());
  for (const auto& c : candidates) order.push_back(&c);
  CGAL::spatial_sort(order.begin(), order.end(), SortTraits());
  Triangulation t;
  Triangulation::Face_handle hint;
  for (const auto* c : order) {
    const auto v = t.insert(c->point, hint);
    v->info() = c->image;
    hint = v->face();
  }
  return t;
}

SiteImage moved(const SiteImage& v, const ImageShift<2>& by) {
  return {v.site, {v.shift[0] - by[0], v.shift[1] - by[1]}};
}

bool before(const SiteImage& a, const SiteImage& b) {  // the same for all images of a pair
  return std::tie(a.site, a.shift[0], a.shift[1]) < std::tie(b.site, b.shift[0], b.shift[1]);
}

// The corners of a sector turned so that the smallest comes first: the listed face and its shift.
std::array<SiteImage, 3> smallest_first(std::array<SiteImage, 3> corner) {
  std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end(), before), corner.end());
  return corner;
}

void read_stars(const Triangulation& t, std::size_t sites, PowerTriangulation& out) {
  std::vector<Triangulation::Vertex_handle> original(sites);
  std::size_t slots = 0;
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v)
    if (v->info().shift == ImageShift<2>{}) original[idx(v->info().site)] = v;
  slots = 6 * sites + 16;
  out.neighbour.reserve(slots);
  out.first.reserve(sites + 1);
  for (const auto& v : original) {
    out.first.push_back(static_cast<std::int32_t>(out.neighbour.size()));
    if (v == Triangulation::Vertex_handle()) continue;  // hidden
    auto w = t.incident_vertices(v);
    const auto start = w;
    do {
      if (t.is_infinite(w)) throw std::logic_error("power_triangulation: padding too small (unbounded star)");
      out.neighbour.push_back(w->info());
    } while (++w != start);
  }
  out.first.push_back(static_cast<std::int32_t>(out.neighbour.size()));
}

void name_faces(PowerTriangulation& out) {
  out.face.assign(out.neighbour.size(), -1);
  out.face_shift.assign(out.neighbour.size(), {});
  const auto sites = static_cast<std::int32_t>(out.first.size()) - 1;
  const auto sector = [&](std::int32_t i, std::int32_t slot) {
    const auto k = idx(slot), n = idx(out.next(i, slot));
    return smallest_first({SiteImage{i, {}}, out.neighbour[k], out.neighbour[n]});
  };
  for (std::int32_t i = 0; i < sites; ++i)
    for (auto slot = out.first[idx(i)]; slot < out.first[idx(i) + 1]; ++slot) {
      const auto corner = sector(i, slot);
      if (corner[0] == SiteImage{i, {}}) {
        out.face[idx(slot)] = static_cast<std::int32_t>(out.faces.size());
        out.faces.push_back(corner);
      }
    }
  for (std::int32_t i = 0; i < sites; ++i)
    for (auto slot = out.first[idx(i)]; slot < out.first[idx(i) + 1]; ++slot) {
      const auto k = idx(slot);
      if (out.face[k] >= 0) continue;
      const auto corner = sector(i, slot);
      const auto shift = corner[0].shift;
      const auto owner = out.slot_of(corner[0].site, moved(corner[1], shift));
      const auto after = idx(out.next(corner[0].site, owner));
      if (out.neighbour[after] != moved(corner[2], shift))
        throw std::logic_error("power_triangulation: stars do not match");
      out.face[k] = out.face[idx(owner)];
      out.face_shift[k] = shift;
    }
}

}  // namespace

std::int32_t PowerTriangulation::slot_of(std::int32_t site, const SiteImage& image) const {
  for (auto k = first[idx(site)]; k < first[idx(site) + 1]; ++k)
    if (neighbour[idx(k)] == image) return k;
  throw std::logic_error("power_triangulation: edge without its reverse");
}

PowerTriangulation power_triangulation(const PeriodicSites& sites) {
  PowerTriangulation out;
  const auto t = triangulate(padded(sites));
  read_stars(t, sites.position.size(), out);
  name_faces(out);
  return out;
}

}  // namespace isostat
