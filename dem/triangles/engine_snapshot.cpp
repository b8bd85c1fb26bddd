// The traffic of the triangle engine with a state.
#include "dem/solver/neighbours_impl.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/overlap_search.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

using Store = GrainStore;

void TriangleEngine::snapshot(State<TriangleGrains>& s) const {
  s.ledger = ledger_;
  s.law = law_;
  snapshot_bodies(s);
  snapshot_memory(s);
  TrianglePacking& p = s.packing;
  p.events = events_;
  p.overlaps.clear();
  for (const PairMemory<GrainHistory>& spring : s.memory.pairs) {
    Overlap o;
    o.grain_i = spring.i, o.grain_j = spring.j, o.shift = spring.shift;
    o.tangential_force = spring.history.tangential_force;
    p.overlaps.push_back(o);
  }
  p.overlaps = overlaps_of(p, law_, overlapping_triangles(p));
}

void TriangleEngine::snapshot_bodies(State<TriangleGrains>& s) const {
  TrianglePacking& p = s.packing;
  const std::size_t n = triangles(), grains = store_.grains();
  p.cell = cell_;
  p.bodies.resize(n), p.corner.resize(n), p.angle.resize(n);
  p.grains.id = store_.id;
  p.grains.begin.assign(1, 0), p.grains.part.resize(grains), p.grains.radius.resize(grains);
  p.links.clear(), p.beams.clear();
  const double half = integrator_ == Integrator::gear ? 0 : 0.5 * dt_;
  std::size_t k = 0;
  for (std::size_t g = 0; g < grains; ++g) {
    p.grains.part[g] = store_.part(g), p.grains.radius[g] = store_.radius(g);
    const auto first = static_cast<std::int32_t>(k);
    for (std::size_t t = 0; t < store_.triangles(g); ++t, ++k) {
      const std::size_t at = store_.slot(g, t);
      const auto value = [&](Store::Column c) { return store_[c][at]; };
      Bodies<2>& b = p.bodies;
      b.id[k] = store_.body_id[at];
      b.position[k] = {{value(Store::x), value(Store::y)}};
      const double im = value(Store::inverse_mass), ij = value(Store::inverse_inertia);
      b.velocity[k] = {{value(Store::ux) + half * value(Store::fx) * im,
                        value(Store::uy) + half * (value(Store::fy) * im - gravity_ * value(Store::heavy))}};
      b.spin[k] = value(Store::uw) + half * value(Store::torque) * ij;
      b.radius[k] = value(Store::reach), b.mass[k] = value(Store::mass), b.inertia[k] = value(Store::inertia);
      p.angle[k] = value(Store::angle);
      for (std::size_t c = 0; c < 3; ++c)
        p.corner[k][c] = {{store_[static_cast<Store::Column>(Store::corner0 + 2 * c)][at],
                           store_[static_cast<Store::Column>(Store::corner0 + 2 * c + 1)][at]}};
    }
    p.grains.begin.push_back(static_cast<std::int32_t>(k));
    for (std::size_t b = 0; b < store_.beams(g); ++b) {
      Link<2> link;
      link.kind = LinkKind::beam, link.beam = static_cast<std::int32_t>(p.beams.size());
      link.i = first + store_.joined(g, b)[0], link.j = first + store_.joined(g, b)[1];
      p.beams.push_back(store_.beam_at(store_.beam_place(g, b)));
      set_beam_force(p, link);
      p.links.push_back(link);
    }
  }
}

void TriangleEngine::snapshot_memory(State<TriangleGrains>& s) const {
  TriangleMemory& m = s.memory;
  const std::size_t n = triangles();
  m.half_velocity.resize(n), m.half_spin.resize(n), m.force.resize(n), m.torque.resize(n);
  m.candidate_position.resize(n), m.candidate_angle.resize(n);
  const bool gear = integrator_ == Integrator::gear;
  m.derivatives.resize(gear ? n : 0), m.spin_derivatives.resize(gear ? n : 0);
  m.wall_position.clear(), m.wall_angle.clear();
  std::size_t k = 0;
  for (std::size_t g = 0; g < store_.grains(); ++g)
    for (std::size_t t = 0; t < store_.triangles(g); ++t, ++k) {
      const std::size_t at = store_.slot(g, t);
      const auto value = [&](Store::Column c) { return store_[c][at]; };
      m.half_velocity[k] = {{value(Store::ux), value(Store::uy)}}, m.half_spin[k] = value(Store::uw);
      m.force[k] = {{value(Store::fx), value(Store::fy)}}, m.torque[k] = value(Store::torque);
      m.candidate_position[k] = {{value(Store::built_x), value(Store::built_y)}};
      m.candidate_angle[k] = value(Store::built_angle);
      if (gear) {
        m.derivatives[k] = {Vec2{{value(Store::bx), value(Store::by)}}, Vec2{{value(Store::cx), value(Store::cy)}}};
        m.spin_derivatives[k] = {{value(Store::bw), value(Store::cw)}};
      }
      if (store_.driven(g)) {
        m.wall_position.push_back({{value(Store::wall_x), value(Store::wall_y)}});
        m.wall_angle.push_back(value(Store::wall_angle));
      }
    }
  lists_->remember(m.lists, m.pairs);
  m.pairs = candidates_.springs();
}

}  // namespace isostat
