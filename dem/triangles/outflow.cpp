#include "dem/triangles/outflow.hpp"

#include <algorithm>

#include "dem/state/container_motion.hpp"
#include "dem/triangles/energy.hpp"
#include "dem/triangles/grain_split.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

struct GrainSum {
  double mass = 0, height = 0;  // of the centre of mass
};
GrainSum sum_of(const TrianglePacking& p, std::size_t g) {
  GrainSum sum;
  for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k)
    sum.mass += p.bodies.mass[k], sum.height += p.bodies.mass[k] * p.bodies.position[k][1];
  sum.height /= sum.mass;
  return sum;
}

// What they hold goes with them.
void take_out(State<TriangleGrains>& s, const std::vector<bool>& gone) {
  const bool books = s.scene.output.energies;
  const double before = books ? energies(s).stored() : 0;
  remove_grains(s, gone);
  if (books) s.ledger.injected += energies(s).stored() - before;
}

}  // namespace

void open_outlet(State<TriangleGrains>& s) {
  s.surroundings.open = true;
  std::vector<bool> gone(s.packing.grains.size());
  for (std::size_t g = 0; g < gone.size(); ++g) gone[g] = s.packing.grains.part[g] == GrainPart::lid;
  if (std::find(gone.begin(), gone.end(), true) != gone.end()) take_out(s, gone);
}

bool take_away(State<TriangleGrains>& s) {
  const double lowest = outlet_height(s) - s.scene.container.drop;
  std::vector<bool> gone(s.packing.grains.size());
  bool any = false;
  for (std::size_t g = 0; g < gone.size(); ++g) {
    if (s.packing.grains.part[g] != GrainPart::free) continue;
    const GrainSum sum = sum_of(s.packing, g);
    if (!(sum.height < lowest)) continue;
    gone[g] = any = true;
    ++s.surroundings.grains_left, s.surroundings.mass_left += sum.mass;
  }
  if (!any) return false;
  s.surroundings.last_left = s.time;
  take_out(s, gone);
  return true;
}

std::size_t grains_above_outlet(const State<TriangleGrains>& s) {
  const double outlet = outlet_height(s);
  std::size_t count = 0;
  for (std::size_t g = 0; g < s.packing.grains.size(); ++g)
    count += s.packing.grains.part[g] == GrainPart::free && sum_of(s.packing, g).height >= outlet;
  return count;
}

}  // namespace isostat
