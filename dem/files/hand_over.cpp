#include "dem/files/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "dem/disks/certificate.hpp"
#include "dem/disks/engine.hpp"
#include "dem/input_error.hpp"
#include "dem/run_error.hpp"
#include "dem/solver/solver.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/state/touching.hpp"

namespace isostat {
namespace {

constexpr double kSameRadius = 1e-5;  // [radius] engines write six digits

template <int D>
std::unordered_map<std::int64_t, std::size_t> places(const Bodies<D>& bodies, std::size_t count) {
  std::unordered_map<std::int64_t, std::size_t> place;
  for (std::size_t k = 0; k < count; ++k) place.emplace(bodies.id[k], k);
  return place;
}

std::string text(std::int64_t id) { return std::to_string(id); }

template <int D>
std::int64_t first_id(const Bodies<D>& bodies, std::size_t count) {
  return count == 0 ? 0 : *std::min_element(bodies.id.begin(), bodies.id.begin() + static_cast<std::ptrdiff_t>(count));
}

// By how much the ids of the packing are larger: 0 unless they fit the state's only with another first number.
template <int D>
std::int64_t id_shift(const Packing<D>& state, const Packing<D>& moved) {
  const std::size_t count = moved.bodies.size();
  if (count != state.grains()) return 0;
  const auto there = places(moved.bodies, count);
  const std::int64_t shift = first_id(moved.bodies, count) - first_id(state.bodies, count);
  for (std::size_t k = 0; k < count; ++k)
    if (!there.contains(state.bodies.id[k] + shift)) return 0;
  return shift;
}

// Of each grain of the state its place in the packing.
template <int D>
std::vector<std::size_t> matched(const Packing<D>& state, const Packing<D>& moved, bool sizes,
                                 const std::string& path) {
  const auto there = places(moved.bodies, moved.bodies.size());
  const std::int64_t shift = id_shift(state, moved);
  std::vector<std::size_t> place;
  for (std::size_t k = 0; k < state.grains(); ++k) {
    const auto found = there.find(state.bodies.id[k] + shift);
    if (found == there.end())
      throw InputError(path, 0, "id", text(state.bodies.id[k]), "a grain of the state is missing here (--from)");
    const double wanted = state.bodies.radius[k], is = moved.bodies.radius[found->second];
    if (sizes && !(std::abs(is - wanted) <= kSameRadius * wanted))
      throw InputError(
          path, 0, "radius", std::to_string(is),
          "grain " + text(state.bodies.id[k]) + " has the radius " + std::to_string(wanted) + " in the state (--from)");
    place.push_back(found->second);
  }
  if (moved.bodies.size() == place.size()) return place;
  const auto known = places(state.bodies, state.grains());
  for (const std::int64_t id : moved.bodies.id)
    if (!known.contains(id)) throw InputError(path, 0, "id", text(id), "the state has no such grain (--from)");
  throw InputError(path, 0, "id", "", "there are more grains here than in the state (--from)");
}

bool has_walls(const State<Disks>& s) { return !s.packing.feet.empty() || !s.packing.part.empty(); }
bool has_walls(const State<Spheres>& s) { return !s.packing.walls.empty(); }

// Another engine may have put grains back into the cell: the images of links go with them.
template <int D>
void follow_images(std::vector<Link<D>>& links, const std::vector<Vec<D>>& before, const Packing<D>& now) {
  if (!now.cell) return;
  for (Link<D>& l : links)
    for (int k = 0; k < D; ++k) {
      const auto cells = [&](std::int32_t body) {
        const auto b = static_cast<std::size_t>(body);
        return static_cast<int>(std::lround(now.cell->fractions(now.bodies.position[b] - before[b])[k]));
      };
      if (static_cast<std::size_t>(std::max(l.i, l.j)) < before.size())
        l.shift[static_cast<std::size_t>(k)] += cells(l.i) - cells(l.j);
    }
}

// The links, and what stands at walls, as a run finds them at its first look.
template <class System>
void find_links(State<System>& state, const std::string& path) {
  const Bodies<System::dimension> as_given = state.packing.bodies;
  const std::size_t grains = state.packing.grains();
  const auto stress = state.imposed_stress;
  const auto motion = state.cell_motion;
  try {
    Solver<System>(state, {}).snapshot(state);
  } catch (const RunError& error) {
    throw InputError(path, 0, "--from", "", error.what());
  }
  const auto place = places(as_given, grains);
  Bodies<System::dimension>& b = state.packing.bodies;
  for (std::size_t k = 0; k < state.packing.grains(); ++k) {
    const std::size_t was = place.at(b.id[k]);
    b.velocity[k] = as_given.velocity[was], b.spin[k] = as_given.spin[was];
  }
  state.imposed_stress = stress, state.cell_motion = motion;
  state.memory = {};
}

}  // namespace

template <class System>
State<System> hand_over(const State<System>& base, const Packing<System::dimension>& moved, const MovedGrains& brings,
                        const std::string& path) {
  constexpr int D = System::dimension;
  if (base.packing.cell.has_value() != moved.cell.has_value())
    throw InputError(path, 0, "cell", "", moved.cell ? "the state has no cell (--from)" : "the state has one (--from)");
  const std::vector<std::size_t> place = matched<D>(base.packing, moved, brings.sizes, path);
  State<System> state = base;
  Packing<D>& packing = state.packing;
  packing.cell = moved.cell;
  for (std::size_t k = 0; k < place.size(); ++k) {
    packing.bodies.position[k] = moved.bodies.position[place[k]];
    if (brings.velocities) packing.bodies.velocity[k] = moved.bodies.velocity[place[k]];
    if (brings.spins) packing.bodies.spin[k] = moved.bodies.spin[place[k]];
  }
  state.memory = {};
  if (brings.links) {
    if (has_walls(base))
      throw InputError(
          path, 0, "--from", "",
          "the state has walls, and contacts with walls are in no list of contacts; leave the contacts out");
    std::vector<std::int32_t> own(place.size());
    for (std::size_t k = 0; k < place.size(); ++k) own[place[k]] = static_cast<std::int32_t>(k);
    packing.links = moved.links;
    for (Link<D>& l : packing.links)
      for (std::int32_t* end : {&l.i, &l.j}) *end = own[static_cast<std::size_t>(*end)];
    for (Link<D>& l : packing.links)
      if (!brings.sizes) {
        const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
        l.gap = norm(branch(packing, i, j, l.shift)) - packing.bodies.radius[i] - packing.bodies.radius[j];
      }
  } else if (!(state.time_step > 0)) {  // it was never in a run
    find_contacts<D>(packing, default_gap_tolerance(packing.bodies));
  } else {
    follow_images<D>(packing.links, base.packing.bodies.position, packing);
    find_links(state, path);
  }
  state.certificate = evaluate_certificate(state);
  return state;
}

template State<Disks> hand_over(const State<Disks>&, const Packing<2>&, const MovedGrains&, const std::string&);
template State<Spheres> hand_over(const State<Spheres>&, const Packing<3>&, const MovedGrains&, const std::string&);

}  // namespace isostat
