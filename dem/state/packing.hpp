// A packing is bodies and links: passive data, exchanged between solver, state file and analysis.
//
// Reduced units: length a (largest diameter), mass m (disk of diameter a), force F0 (or a P without cohesion);
// T0 = sqrt(m a / F0). Gilabert 2007, Sec. II.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dem/state/grain_part.hpp"
#include "geometry/periodic_cell.hpp"
#include "geometry/vec.hpp"

namespace isostat {

template <int D>
using Spin = std::conditional_t<D == 2, double, Vec3>;  // angular velocity or moment: a number in the plane

template <int D>
using Tangential = std::conditional_t<D == 2, double, Vec3>;  // component along t = z x n in 2D, vector in 3D

// Arrays over bodies, all of one length, in storage order (the solver may permute bodies; `id` names them).
template <int D>
struct Bodies {
  std::vector<std::int64_t> id;  // distinct, any integers
  std::vector<Vec<D>> position;  // [a] may lie outside the cell
  std::vector<Vec<D>> velocity;  // [a/T0] peculiar: relative to the affine flow of the cell
  std::vector<Spin<D>> spin;     // [1/T0] angular velocity
  std::vector<double> radius;    // [a]
  std::vector<double> mass;      // [m]
  std::vector<double> inertia;   // [m a^2]
  std::size_t size() const { return id.size(); }
  void resize(std::size_t n) {
    id.resize(n), position.resize(n), velocity.resize(n), spin.resize(n);
    radius.resize(n), mass.resize(n), inertia.resize(n);
  }
};

// What a link can transmit. Letters as in `.net` files.
enum class LinkKind : std::uint8_t {
  closed,           // c  contact: normal, tangential (friction), moment (rolling)
  sliding,          // s  at the Coulomb limit: no tangential row
  rolling_yielded,  // r  at the rolling limit: no moment row
  both_yielded,     // sr
  distant,          // d  attraction across a gap: normal row only
  beam,             // b  elastic beam: normal, tangential, moment, never at a limit
};
constexpr std::string_view letters(LinkKind kind) {
  constexpr std::string_view names[] = {"c", "s", "r", "sr", "d", "b"};
  return names[static_cast<int>(kind)];
}
// Two surfaces touch: what coordination numbers, rattlers and the contact set count.
constexpr bool is_contact(LinkKind kind) { return kind != LinkKind::distant && kind != LinkKind::beam; }
std::optional<LinkKind> link_kind_from_letters(std::string_view letters);

// One interacting pair. i and j are indices into Bodies (not ids); branch vector r_ij = r_j + shift * L - r_i,
// n = r_ij / |r_ij|, t = z x n. Force on j is N n + T t, on i its opposite; moment on j is -T l_j + M, on i
// -T l_i - M, with the proportional lever arms of dem/state/link.hpp. Static forces only, no viscous part.
template <int D>
struct Link {
  std::int32_t i = 0, j = 0;
  ImageShift<D> shift{};
  LinkKind kind = LinkKind::closed;
  std::int32_t beam = -1;            // of kind beam: its place in Packing::beams
  double gap = 0;                    // [a] h; h < 0 is overlap (a beam: its elongation)
  double normal_force = 0;           // [F0] N > 0 repulsive
  Tangential<D> tangential_force{};  // [F0]
  Spin<D> moment{};                  // [F0 a] rolling moment M on j
};

// An elastic beam of the plane between the centres of two bodies: what its link does not say. As a link it has
// R_i = R_j = L0/2 (dem/state/link_ends.hpp), so that gap and lever arms are L - L0 and L/2, and its forces are those
// of Poeschel and Buchholtz 1995, Sec. 2: N = -E h, end moments from the rotations of the ends against the chord.
struct Beam {
  double rest_length = 0;                     // L0 [a]
  double rest_angle_i = 0, rest_angle_j = 0;  // of the ends against the chord, without load
  double stiffness = 0;                       // E [F0/a]: force per elongation
  double bending = 0;                         // E I [F0 a^2]
  friend bool operator==(const Beam&, const Beam&) = default;
};

// A body of radius and mass 0 where a grain touches a smooth wall (dem/state/smooth_walls.hpp): what its body does not
// say.
struct Foot {
  std::int32_t wall = 0;  // its number
  double turning = 0;     // [1/a] of the normal, FootPoint::turning
  friend bool operator==(const Foot&, const Foot&) = default;
};

template <int D>
struct Packing {
  std::optional<PeriodicCell<D>> cell;  // none: isolated
  Bodies<D> bodies;
  std::vector<Link<D>> links;
  std::vector<Beam> beams;      // of the links of kind beam; in the plane only
  std::vector<GrainPart> part;  // of the bodies; empty: all are free
  std::vector<Foot> feet;       // of the last bodies
  // Bodies before the first foot.
  std::size_t grains() const { return bodies.size() - feet.size(); }
};

template <int D>
std::size_t count_free(const Packing<D>& packing) {
  if (packing.part.empty()) return packing.bodies.size();
  return static_cast<std::size_t>(std::count(packing.part.begin(), packing.part.end(), GrainPart::free));
}

}  // namespace isostat
