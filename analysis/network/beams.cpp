// Section `beams`: what the beams inside the grains of triangles carry, and which of them have failed.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/network/triangle_sections.hpp"
#include "dem/triangles/at_rest.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

using Json = nlohmann::ordered_json;

Json beams_section(const AnalysisInput& input, const AnalysisOptions&) {
  const TrianglePacking& p = input.triangles->packing;
  double energy = 0, tension = 0, compression = 0, shear = 0, bending = 0, stretch = 0, angle = 0;
  for (const Link<2>& link : p.links) {
    const Beam& beam = p.beams[idx(link.beam)];
    const BeamTurns t = beam_turns(p, link);
    const BeamForce f = beam_force(beam, t.length, t.turn_i, t.turn_j);
    const double lever = 0.5 * f.tangential * t.length;
    energy += beam_energy(beam, t.length, t.turn_i, t.turn_j);
    tension = std::max(tension, -f.normal), compression = std::max(compression, f.normal);
    shear = std::max(shear, std::abs(f.tangential));
    bending = std::max({bending, std::abs(lever + f.moment), std::abs(lever - f.moment)});
    stretch = std::max(stretch, std::abs(t.length / beam.rest_length - 1));
    angle = std::max({angle, std::abs(t.turn_i), std::abs(t.turn_j)});
  }
  std::int64_t broken = 0, by_mode[kBeamModeNames.size()] = {};
  for (const BeamEvent& e : p.events) broken += e.broken, ++by_mode[static_cast<std::size_t>(e.mode)];
  Json modes;
  for (std::size_t m = 0; m < kBeamModeNames.size(); ++m) modes[std::string(kBeamModeNames[m])] = by_mode[m];
  Json json;
  json["count"] = p.links.size();
  json["energy"] = energy;
  json["largest"] = {{"tension", tension}, {"compression", compression}, {"shear", shear},
                     {"moment", bending},  {"stretch", stretch},         {"angle", angle}};
  json["broken"] = broken;
  json["yielded"] = static_cast<std::int64_t>(p.events.size()) - broken;
  json["failed_by"] = modes;
  return json;
}

std::vector<Table> beams_tables(const AnalysisInput& input, const AnalysisOptions&) {
  const TrianglePacking& p = input.triangles->packing;
  Table beams{"links", {"triangle_i", "triangle_j", "elongation", "N", "T", "M"}, {}};
  for (Link<2> link : p.links) {
    set_beam_force(p, link);
    beams.rows.push_back({static_cast<double>(p.bodies.id[idx(link.i)]), static_cast<double>(p.bodies.id[idx(link.j)]),
                          link.gap, link.normal_force, link.tangential_force, link.moment});
  }
  Table events{"events", {"t", "triangle_i", "triangle_j", "mode", "broken"}, {}};
  for (const BeamEvent& e : p.events)
    events.rows.push_back({e.time, static_cast<double>(e.body_i), static_cast<double>(e.body_j),
                           static_cast<double>(e.mode), e.broken ? 1.0 : 0.0});
  return {beams, events};
}

}  // namespace isostat
