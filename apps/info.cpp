// isostat info STATE: what a state file is, as one JSON object on stdout.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "dem/disks/scales.hpp"
#include "dem/files/state_file.hpp"
#include "dem/files/state_seal.hpp"
#include "dem/scene/keys.hpp"
#include "dem/scene/text.hpp"
#include "dem/triangles/time_step.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Undefined numbers are null.
Json number(const std::optional<double>& x) { return x && std::isfinite(*x) ? Json(*x) : Json(nullptr); }

Json key_value(const SceneKey& key, Scene& scene, std::size_t stage) {
  return std::visit(
      [&](const auto* value) -> Json {
        using Type = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<Type, std::optional<double>>)
          return number(*value);
        else if constexpr (std::is_enum_v<Type>)
          return key.choices.at(static_cast<std::size_t>(*value));
        else
          return *value;
      },
      key.field(scene, stage));
}

// Nested as in the scene file; keys that do not apply are left out, optional ones without a value are null.
Json scene_json(Scene scene) {
  Json json = Json::object();
  json["stage"] = Json::array();
  for (std::size_t k = 0; k < scene.stages.size(); ++k) json["stage"].push_back(Json::object());
  for (const SceneKey& key : scene_keys(scene.system)) {
    const std::string table = table_of(key), leaf(leaf_of(key));
    if (belongs_to_stage(key)) {
      for (std::size_t k = 0; k < scene.stages.size(); ++k)
        if (echoed(key, scene, k)) json["stage"][k][leaf] = key_value(key, scene, k);
    } else if (echoed(key, scene, 0))
      (table.empty() ? json : json[table])[leaf] = key_value(key, scene, 0);
  }
  return json;
}

Json scales_json(const Scales& s) {
  return {{"kappa", number(s.kappa)},
          {"P*", number(s.reduced_pressure)},
          {"h0_over_D0", number(s.overlap_over_range)},
          {"e_N", number(s.restitution)},
          {"V*", number(s.velocity)},
          {"T0", number(s.time)},
          {"dt", number(s.time_step)},
          {"dt_critical", number(s.critical_time_step)}};
}

// The law as it acts, every default filled in; docs/formats.md has the units.
Json law_json(const DiskLaw& law) {
  const auto& [kn, kt, zeta, mu, mu_r, kr, f0, d0] = law;
  return {{"normal_stiffness", kn},   {"tangential_stiffness", kt}, {"damping", zeta},  {"friction", mu},
          {"rolling_friction", mu_r}, {"rolling_stiffness", kr},    {"attraction", f0}, {"attraction_range", d0}};
}

// The same quantities, and the units, in SI: m, kg, N, s; stress and stiffness in the plane in N/m.
Json si_json(const State<Disks>& state, const Scales& s) {
  const SiScales si = si_scales(*state.scene.units);
  const auto times = [](const std::optional<double>& x, double unit) { return x ? number(*x * unit) : Json(nullptr); };
  return {{"a", number(si.length)},
          {"m", number(si.mass)},
          {"F0", number(si.force)},
          {"T0", times(s.time, si.time)},
          {"V*", times(s.velocity, si.velocity())},
          {"P", times(largest_stress(state.imposed_stress), si.pressure())},
          {"K_N", number(state.law.normal_stiffness * si.pressure())},
          {"dt", number(s.time_step * si.time)},
          {"dt_critical", number(s.critical_time_step * si.time)},
          {"time", number(state.time * si.time)}};
}

// The same for triangles, in cm, g, s. A limit that no beam reaches is null.
Json law_json(const TriangleLaw& law) {
  const auto& [contact, modulus, overlap_length, friction, tangential_stiffness, damping, failure, tension, shear,
               bending, stretch, angle] = law;
  return {{"contact", kContactLawNames[static_cast<std::size_t>(contact)]},
          {"modulus", modulus},
          {"overlap_length", overlap_length},
          {"friction", friction},
          {"tangential_stiffness", tangential_stiffness},
          {"damping", damping},
          {"failure", kBeamFailureNames[static_cast<std::size_t>(failure)]},
          {"limit_tension", number(tension)},
          {"limit_shear", number(shear)},
          {"limit_bending", number(bending)},
          {"limit_stretch", number(stretch)},
          {"limit_angle", number(angle)}};
}

Json law_json(const SoftParticleLaw& law) {
  const auto& [force, exponent, offset, tangential, tangential_exponent, friction] = law;
  return {{"force", force},           {"exponent", exponent}, {"offset", offset},
          {"tangential", tangential}, {"friction", friction}, {"tangential_exponent", tangential_exponent}};
}

// The same of spheres: E and nu with Hertz's law, stiffnesses with the linear one.
Json law_json(const SphereLaw& law) {
  const auto& [normal, grain, wall, second, soft_solid, soft_soft, curvature, kn, kt, zeta, zeta_t, mu, mu_w, mu_r, kr,
               f0, d0] = law;
  Json json{{"normal", kNormalForceNames[static_cast<std::size_t>(normal)]},
            {"modulus", grain.modulus},
            {"poisson", grain.poisson},
            {"wall_modulus", wall.modulus},
            {"wall_poisson", wall.poisson},
            {"normal_stiffness", kn},
            {"tangential_stiffness", kt},
            {"damping", zeta},
            {"tangential_damping", zeta_t},
            {"friction", mu},
            {"wall_friction", mu_w},
            {"rolling_friction", mu_r},
            {"rolling_stiffness", kr},
            {"attraction", f0},
            {"attraction_range", d0}};
  if (second != SphereMaterial{}) json["second_modulus"] = second.modulus, json["second_poisson"] = second.poisson;
  if (soft_solid == SoftParticleLaw{}) return json;
  json["soft_solid"] = law_json(soft_solid), json["soft_soft"] = law_json(soft_soft);
  json["soft_curvature"] = curvature;
  return json;
}

// What only one system has: numbers of bodies, and what ends the report.
void add_size(Json& json, const State<Spheres>& state) {
  json["grains"] = state.packing.bodies.size();
  json["walls"] = state.packing.walls.size();
}
void add_size(Json& json, const State<Disks>& state) {
  if (state.scene.container.shape == ContainerShape::none) return;
  const Packing<2>& p = state.packing;
  json["grains"] = count_free(p);
  json["wall_grains"] = p.grains() - count_free(p);
  json["feet"] = p.feet.size();
  json["grains_left"] = state.surroundings.grains_left;
}
void add_size(Json& json, const State<TriangleGrains>& state) {
  const TrianglePacking& p = state.packing;
  const auto free = std::count(p.grains.part.begin(), p.grains.part.end(), GrainPart::free);
  json["grains"] = free;
  json["wall_grains"] = static_cast<std::int64_t>(p.grains.size()) - free;
  json["triangles"] = p.bodies.size();
  json["beams"] = p.beams.size();
  json["overlaps"] = p.overlaps.size();
  json["events"] = p.events.size();
  json["grains_left"] = state.surroundings.grains_left;
}
void add_scales(Json& json, const State<Disks>& state) {
  const Scales s = scales(state);
  json["scales"] = scales_json(s);
  if (state.scene.units) json["si"] = si_json(state, s);
}
void add_scales(Json& json, const State<Spheres>& state) {
  const double dt = state.time_step;
  json["scales"] = {{"dt", dt > 0 ? Json(dt) : Json()}};
}
void add_scales(Json& json, const State<TriangleGrains>& state) {
  const double dt = state.time_step;
  json["scales"] = {{"dt", dt > 0 ? Json(dt) : Json()},
                    {"omega_max", dt > 0 ? Json(triangle_step_fraction(state.scene) / dt) : Json()}};
}

// A packing that no run has made: converted from a file that knows no scene (and a law only of triangles).
bool foreign(const State<Disks>& state) { return !(state.law.normal_stiffness > 0); }
bool foreign(const State<Spheres>& state) { return state.law == SphereLaw{}; }
bool foreign(const State<TriangleGrains>& state) { return state.scene.stages.empty(); }

// The keys of the contract stay; what they would tell is not known.
void remove_what_is_not_known(Json& json) {
  json["seed"] = nullptr;
  json["scene"] = Json::object();
  if (json["system"] != TriangleGrains::name) json["law"] = Json::object();
  for (auto& value : json["scales"]) value = nullptr;
}

template <class System>
Json info_json(const State<System>& state, const StateFile& file) {
  Json json;
  json["format_version"] = kStateFormatVersion;
  json["hash"] = file.hash;
  json["system"] = System::name;
  json["cell"] = nullptr;
  if (state.packing.cell) json["cell"] = state.packing.cell->length.c;
  if (state.packing.cell && state.packing.cell->tilt != 0) json["tilt"] = state.packing.cell->tilt;
  json["time"] = state.time;
  json["seed"] = state.seed;
  add_size(json, state);
  json["scene"] = scene_json(state.scene);
  json["law"] = law_json(state.law);
  add_scales(json, state);
  if (foreign(state)) remove_what_is_not_known(json);
  json["provenance"] = {{"version", file.provenance.version},
                        {"compiler", file.provenance.compiler},
                        {"command", file.provenance.command}};
  return json;
}

}  // namespace

int info_command(int argc, char** argv) {
  const Arguments arguments(argc, argv, {},
                            {"STATE",
                             "Prints what a state file is as JSON: hash of the physical state, system, cell, scene, "
                             "dimensionless numbers (in SI too if the scene has [units]), provenance."});
  arguments.require_inputs(1, 1, "one state file");
  const StateFile file = read_state_file(arguments.inputs()[0]);
  const Json json = std::visit([&file](const auto& state) { return info_json(state, file); }, file.state);
  std::cout << json_text(json, 2);
  return exit_done;
}

}  // namespace isostat
