#include "dem/disks/outflow.hpp"

#include <algorithm>

#include "dem/disks/energy.hpp"
#include "dem/state/container_motion.hpp"

namespace isostat {
namespace {

template <class T>
void thin(std::vector<T>& values, const std::vector<char>& goes) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < goes.size(); ++k)
    if (!goes[k]) values[kept++] = values[k];
  values.resize(kept);
}

// Links or pairs: those of bodies that go, go with them.
template <class Pair>
void thin_pairs(std::vector<Pair>& pairs, const std::vector<char>& goes, const std::vector<std::int32_t>& to) {
  const auto at = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  std::erase_if(pairs, [&](const Pair& p) { return goes[at(p.i)] || goes[at(p.j)]; });
  for (Pair& p : pairs) p.i = to[at(p.i)], p.j = to[at(p.j)];
}

}  // namespace

void remove_bodies(State<Disks>& s, std::vector<char> goes) {
  const bool books = s.scene.output.energies;
  const double before = books ? energies(s).stored() : 0;
  const std::size_t grains = s.packing.grains();
  for (const Link<2>& l : s.packing.links) {  // feet go with the disks that stood on them
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    if (goes[i] && j >= grains) goes[j] = 1;
    if (goes[j] && i >= grains) goes[i] = 1;
  }
  std::vector<std::int32_t> to(goes.size());
  std::int32_t kept = 0;
  for (std::size_t k = 0; k < goes.size(); ++k) to[k] = goes[k] ? -1 : kept++;
  thin_pairs(s.packing.links, goes, to);
  thin_pairs(s.memory.pairs, goes, to);

  DiskMemory& m = s.memory;
  if (!m.wall_position.empty()) {
    std::vector<char> walls_go;
    for (std::size_t k = 0; k < grains; ++k)
      if (!is_free(s.packing.part, k)) walls_go.push_back(goes[k]);
    thin(m.wall_position, walls_go);
  }
  const std::vector<char> feet_go(goes.begin() + static_cast<std::ptrdiff_t>(grains), goes.end());
  thin(s.packing.feet, feet_go);
  thin(s.packing.part, goes);
  Bodies<2>& b = s.packing.bodies;
  thin(b.id, goes), thin(b.position, goes), thin(b.velocity, goes), thin(b.spin, goes);
  thin(b.radius, goes), thin(b.mass, goes), thin(b.inertia, goes);
  thin(m.half_velocity, goes), thin(m.half_spin, goes), thin(m.force, goes), thin(m.torque, goes);
  goes.resize(grains);
  thin(m.lists.outer_position, goes), thin(m.lists.inner_position, goes);
  if (books) s.ledger.injected += energies(s).stored() - before;
}

void open_outlet(State<Disks>& s) {
  s.surroundings.open = true;
  const std::vector<GrainPart>& part = s.packing.part;
  std::vector<char> lids(s.packing.bodies.size(), 0);
  for (std::size_t k = 0; k < part.size(); ++k) lids[k] = part[k] == GrainPart::lid;
  if (std::find(lids.begin(), lids.end(), 1) != lids.end()) remove_bodies(s, lids);
}

std::int64_t grains_above_outlet(const State<Disks>& s) {
  const double outlet = outlet_height(s);
  std::int64_t count = 0;
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k)
    count += is_free(s.packing.part, k) && s.packing.bodies.position[k][1] > outlet;
  return count;
}

bool take_away(State<Disks>& s) {
  const double lowest = outlet_height(s) - s.scene.container.drop;
  std::vector<char> fallen(s.packing.bodies.size(), 0);
  bool any = false;
  // Masses are summed in the order of the ids: storage order is the solver's business.
  std::vector<std::pair<std::int64_t, double>> gone;
  for (std::size_t k = 0; k < fallen.size(); ++k) {
    if (!is_free(s.packing.part, k) || !(s.packing.bodies.position[k][1] < lowest)) continue;
    fallen[k] = 1, any = true;
    gone.push_back({s.packing.bodies.id[k], s.packing.bodies.mass[k]});
  }
  if (!any) return false;
  std::sort(gone.begin(), gone.end());
  for (const auto& [id, mass] : gone) s.surroundings.mass_left += mass;
  s.surroundings.grains_left += static_cast<std::int64_t>(gone.size());
  s.surroundings.last_left = s.time;
  remove_bodies(s, fallen);
  return true;
}

}  // namespace isostat
