#include "apps/pack/lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "analysis/report.hpp"
#include "dem/disks/scales.hpp"
#include "dem/scene/text.hpp"
#include "dem/triangles/time_step.hpp"
#include "dem/triangles/touching_triangles.hpp"

namespace isostat {
namespace {

Bulk bulk_of(const State<Disks>& state) { return {static_cast<std::int64_t>(state.packing.bodies.size()), 0}; }
Bulk bulk_of(const State<Spheres>& state) { return {static_cast<std::int64_t>(state.packing.bodies.size()), 0}; }
Bulk bulk_of(const State<TriangleGrains>& state) {
  const Grains& g = state.packing.grains;
  Bulk b;
  for (std::size_t k = 0; k < g.size(); ++k)
    if (g.part[k] == GrainPart::free) ++b.grains, b.triangles += g.begin[k + 1] - g.begin[k];
  return b;
}

std::string text(std::optional<double> x) {
  char buffer[32];
  if (!x) return "-";
  std::snprintf(buffer, sizeof buffer, "%.4g", *x);
  return buffer;
}

void scales_of(const Scene& scene, const State<TriangleGrains>& state, std::ostream& out) {
  const Bulk b = bulk_of(state);
  const std::size_t walls = state.packing.grains.size() - static_cast<std::size_t>(b.grains);
  out << b.grains << " grains of " << b.triangles << " triangles";
  if (walls > 0) out << ", " << walls << " grains of walls";
  out << "  omega_max " << text(triangle_step_fraction(scene) / state.time_step) << " 1/s  dt " << text(state.time_step)
      << " s; units cm, g, s\n";
}

void scales_of(const Scene&, const State<Spheres>& state, std::ostream& out) {
  const auto [smallest, largest] =
      std::minmax_element(state.packing.bodies.radius.begin(), state.packing.bodies.radius.end());
  out << state.packing.bodies.size() << " spheres  d " << text(2 * *smallest) << " to " << text(2 * *largest)
      << " a  dt " << text(state.time_step) << " T0\n";
}

void scales_of(const Scene& scene, const State<Disks>& state, std::ostream& out) {
  State<Disks> first = state;
  first.imposed_stress = scene.stages.empty() ? ImposedStress<2>{} : imposed_stress<2>(scene.stages.front());
  const Scales s = scales(first);
  out << "kappa " << text(s.kappa) << "  P* " << text(s.reduced_pressure) << "  h0/D0 " << text(s.overlap_over_range)
      << "  e_N " << text(s.restitution) << "  V* " << text(s.velocity) << "  T0 " << text(s.time) << "  dt "
      << text(s.time_step) << " T0  dt/dt_critical " << text(s.time_step / s.critical_time_step) << '\n';
  if (scene.units) {
    const SiScales si = si_scales(*scene.units);
    out << "SI: a " << text(si.length) << " m  F0 " << text(si.force) << " N  T0 " << text(si.time) << " s  V* "
        << text(s.velocity ? std::optional(*s.velocity * si.velocity()) : std::nullopt) << " m/s  F0/a "
        << text(si.pressure()) << " N/m\n";
  }
}

// What the analysis counts in a state; its solver's memory is of no use there.
AnalysisInput input_of(State<Disks> state) {
  AnalysisInput input;
  state.memory = {};
  put_free_first(state.packing);
  input.state = std::move(state);
  return input;
}
AnalysisInput input_of(State<Spheres> state) {
  AnalysisInput input;
  input.packing_3d = std::move(state.packing);
  put_free_first(*input.packing_3d);
  static_cast<Packing<3>&>(state.packing) = {};
  state.memory = {};
  input.spheres_state = std::move(state);
  return input;
}
AnalysisInput input_of(State<TriangleGrains> state) {
  AnalysisInput input;
  state.memory = {};
  const std::vector<Triangle> corners = placed_triangles(state.packing);
  input.set_triangles(std::move(state), corners);
  return input;
}

std::string number_text(const nlohmann::ordered_json& counts, const char* key) {
  const auto found = counts.find(key);
  return text(found != counts.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt);
}

}  // namespace

Bulk bulk(const AnyState& any) {
  return std::visit([](const auto& state) { return bulk_of(state); }, any);
}

std::string first_lines(const Scene& scene, const AnyState& any) {
  std::ostringstream out;
  std::visit([&](const auto& state) { scales_of(scene, state, out); }, any);
  return out.str();
}

std::string last_line(const std::string& path, const AnyState& any, const SampleOutcome& outcome) {
  return std::visit(
      [&](const auto& state) {
        AnalysisInput input = input_of(state);
        input.links_given = true;
        const auto counts = analyze(input, {}, {"counts"}).at("counts");
        const char* const rest = outcome.code == exit_interrupted  ? "interrupted"
                                 : outcome.code == exit_unfinished ? "unfinished"
                                 : state.certificate.equilibrated  ? "in equilibrium"
                                                                   : "not in equilibrium";
        char numbers[96];
        std::snprintf(numbers, sizeof numbers, "  t %.6g %s  %.3g s", state.time,
                      std::string(time_unit(state.scene.system)).c_str(), outcome.run.wall_seconds);
        return path + ": Phi " + number_text(counts, "solid_fraction") + "  z " + number_text(counts, "z") + "  " +
               rest + numbers + "\n";
      },
      any);
}

}  // namespace isostat
