// Beams that break or yield. Only scenes whose law has a failure come here.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/grain_split.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Store = GrainStore;

// How far a beam is beyond each threshold (1: at it), and what it is beyond most.
struct Strain {
  double tension, shear, bending, stretch, angle;
  double tensile() const { return std::max(tension, stretch); }
  double bent() const { return std::max(bending, angle); }
  double most() const { return std::max({tensile(), shear, bent()}); }
  BeamMode mode() const {
    return most() == tensile() ? BeamMode::tension : most() == shear ? BeamMode::shear : BeamMode::bending;
  }
};

// Bounds of all strains without an arc tangent: |T| is at most 1.05 |sin T| below half a radian.
bool is_far_from_failure(const TriangleLaw& law, const Beam& beam, const Vec2& chord, const Vec2& end_i,
                         const Vec2& end_j) {
  const double length = norm(chord), bend = beam.bending / beam.rest_length;
  const auto sine = [&](const Vec2& end) {
    return dot(end, chord) > 0 ? std::abs(chord[0] * end[1] - chord[1] * end[0]) / length : 1.0;
  };
  const double largest = std::max(sine(end_i), sine(end_j)), turn = 1.05 * largest;
  return largest < 0.45 && beam.stiffness * (length - beam.rest_length) < law.limit_tension &&
         std::abs(length / beam.rest_length - 1) < law.limit_stretch && 12 * bend * turn < law.limit_shear * length &&
         6 * bend * turn < law.limit_bending && turn < law.limit_angle;
}

}  // namespace

bool TriangleEngine::strain_beams() {
  bool broken = false;
  for (std::size_t g = 0; g < store_.grains(); ++g)
    for (std::size_t b = 0; b < store_.beams(g) && !store_.driven(g); ++b) {
      const std::size_t i = store_.slot(g, store_.joined(g, b)[0]), j = store_.slot(g, store_.joined(g, b)[1]);
      const std::size_t place = store_.beam_place(g, b);
      Beam beam = store_.beam_at(place);
      if (!(beam.stiffness > 0)) continue;  // broken in this very step
      const Vec2 chord{{store_[Store::x][j] - store_[Store::x][i], store_[Store::y][j] - store_[Store::y][i]}};
      const auto carried = [&](std::size_t s, Store::BeamColumn dx, Store::BeamColumn dy) {
        const double c = store_[Store::cosine][s], t = store_[Store::sine][s];
        const double x = store_.beam(dx)[place], y = store_.beam(dy)[place];
        return Vec2{{c * x - t * y, t * x + c * y}};
      };
      const Vec2 end_i = carried(i, Store::xi, Store::yi), end_j = carried(j, Store::xj, Store::yj);
      if (is_far_from_failure(law_, beam, chord, end_i, end_j)) continue;
      const double length = norm(chord), turn_i = end_rotation(end_i, chord), turn_j = end_rotation(end_j, chord);
      const BeamForce f = beam_force(beam, length, turn_i, turn_j);
      const double lever = 0.5 * f.tangential * length;
      const double moment = std::max(std::abs(lever + f.moment), std::abs(lever - f.moment));
      const double stretched = std::abs(length / beam.rest_length - 1);
      const double turned = std::max(std::abs(turn_i), std::abs(turn_j));
      const Strain strain{-f.normal / law_.limit_tension, std::abs(f.tangential) / law_.limit_shear,
                          moment / law_.limit_bending, stretched / law_.limit_stretch, turned / law_.limit_angle};
      if (!(strain.most() > 1)) continue;
      const BeamMode mode = strain.mode();
      const std::int64_t id_i = store_.body_id[i], id_j = store_.body_id[j];
      if (law_.failure == BeamFailure::break_) {
        events_.push_back({time_, id_i, id_j, mode, true});
        beam.stiffness = beam.bending = 0;
        for (const auto c :
             {Store::stretching, Store::bending, Store::damping, Store::bending_damping, Store::bending_stiffness})
          store_.beam(c)[place] = 0;
        broken = true;
        continue;
      }
      // It yields: rest values follow until the beam is at its threshold.
      if (strain.tensile() > 1) {
        const double elongation = (length - beam.rest_length) / strain.tensile();
        beam.rest_length = strain.stretch >= strain.tension
                               ? length / (1 + std::copysign(law_.limit_stretch, elongation))
                               : length - elongation;
      }
      const double over = std::max(strain.shear, strain.bent());
      if (over > 1) {
        beam.rest_angle_i += turn_i * (1 - 1 / over), beam.rest_angle_j += turn_j * (1 - 1 / over);
      }
      if (std::none_of(events_.begin(), events_.end(),
                       [&](const BeamEvent& e) { return e.body_i == id_i && e.body_j == id_j; }))
        events_.push_back({time_, id_i, id_j, mode, false});
      store_.set_beam(place, beam, law_.damping);
    }
  return broken;
}

// Beams without stiffness go, and a grain that hangs together no more becomes several, from this step on.
void TriangleEngine::split_grains() {
  State<TriangleGrains> s;
  s.law = law_;
  s.scene.step.integrator = integrator_;
  snapshot_bodies(s);
  snapshot_memory(s);
  s.packing.events = events_;
  drop_broken_beams(s);
  s.memory.lists = {};
  load(s);
}

}  // namespace isostat
