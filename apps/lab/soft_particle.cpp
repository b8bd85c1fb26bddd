// isostat lab soft-particle: the constitutive laws of soft-particles in space (seed 000), measured and fitted.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/constitutive/soft_law_fit.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "apps/lab/soft_measurement.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/sample/insertion_scene.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/lab/soft_particle.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using Samples = std::vector<std::vector<double>>;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& rule) {
  throw InputError("command line", 0, option, value, rule);
}

std::vector<double> list_of(const std::string& option, const std::string& text) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    double x = 0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, x);
    if (error != std::errc{} || stop != text.data() + end || !std::isfinite(x))
      refuse(option, text, "numbers with commas between, as in 0.1,0.2");
    values.push_back(x);
    at = end + 1;
  }
  return values;
}

template <class Enum, std::size_t N>
Enum choice(const Arguments& args, const std::string& option, const std::array<std::string_view, N>& names,
            Enum fallback) {
  const auto text = args.value(option);
  if (!text) return fallback;
  const auto found = std::find(names.begin(), names.end(), *text);
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + std::string(name);
  if (found == names.end()) refuse(option, *text, "one of " + all);
  return static_cast<Enum>(found - names.begin());
}

// The option behind a key of the insertion.
std::string option_of(const std::string& key) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> options{
      {{"insertion.shell_radius", "--radius"},
       {"insertion.exponent", "--exponent"},
       {"insertion.volume_factor", "--volume-factor"},
       {"insertion.trials", "--trials"},
       {"insertion.solid_fraction", "--solid-fraction"}}};
  const auto found = std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.first == key; });
  return found == options.end() ? key : std::string(found->second);
}

SoftParticleTest test_of(const Arguments& args) {
  const auto partner = choice(args, "--partner", kSoftPartnerNames, SoftPartner::wall);
  const auto protocol = choice(args, "--protocol", kSoftProtocolNames, SoftProtocol::paper);
  SoftParticleTest t = soft_particle_defaults(partner, protocol);
  t.delta = list_of("--delta", args.required("--delta"));
  for (std::size_t k = 0; k < t.delta.size(); ++k)
    if (!(t.delta[k] > (k > 0 ? t.delta[k - 1] : 0.0)) || t.delta[k] > 0.5)
      refuse("--delta", *args.value("--delta"),
             "ascending, above 0 and at most 0.5, beyond which shells have no contact");
  if (const auto alpha = args.value("--alpha")) t.alpha = list_of("--alpha", *alpha);
  for (const double a : t.alpha)
    if (!(std::abs(a) <= 45) || a == 0)
      refuse("--alpha", *args.value("--alpha"), "angles within 45 degrees, none of them 0");
  if (partner == SoftPartner::cage && !t.alpha.empty())
    refuse("--alpha", *args.value("--alpha"), "nothing turns in a cage; --partner wall or soft");
  if (partner == SoftPartner::none && !t.alpha.empty())
    refuse("--alpha", *args.value("--alpha"), "a solid sphere is not turned; --partner wall or soft");
  InsertionScene& g = t.insertion;
  const double rs = args.number("--radius").value_or(g.shell_radius);
  if (!(rs > 0)) refuse("--radius", *args.value("--radius"), "greater than 0");
  const double largest = args.number("--largest").value_or(0.5), ratio = args.number("--ratio").value_or(10);
  if (!(largest > 0 && largest <= 1)) refuse("--largest", *args.value("--largest"), "above 0 and at most 1, the shell");
  if (!(ratio >= 1)) refuse("--ratio", *args.value("--ratio"), "at least 1");
  g.shell_radius = rs, g.radius_max = largest * rs, g.radius_min = g.radius_max / ratio;
  g.exponent = args.number("--exponent").value_or(g.exponent);
  g.volume_factor = args.number("--volume-factor").value_or(g.volume_factor);
  g.trials = args.number("--trials").value_or(g.trials);
  g.solid_fraction = args.number("--solid-fraction");
  std::vector<Fault> faults;
  for (const SceneConflict& c : insertion_conflicts(g, 3))
    faults.push_back({"command line", 0, option_of(c.key), c.value, c.rule});
  if (!faults.empty()) throw InputError(std::move(faults));
  const auto not_negative = [&](const char* option, double fallback) {
    const double x = args.number(option).value_or(fallback);
    if (!(x >= 0)) refuse(option, *args.value(option), "not negative");
    return x;
  };
  t.law.friction = not_negative("--friction", t.law.friction);
  t.law.wall_friction = args.has("--shell-friction") ? not_negative("--shell-friction", 0) : t.law.friction;
  t.law.damping = not_negative("--damping", t.law.damping);
  t.density = not_negative("--density", t.density);
  t.law.grain.modulus = t.law.wall.modulus = not_negative("--modulus", t.law.grain.modulus);
  if (partner == SoftPartner::ball) {
    t.partner_radius = args.number("--partner-radius").value_or(rs);
    if (!(t.partner_radius > 0)) refuse("--partner-radius", *args.value("--partner-radius"), "greater than 0");
  } else if (const auto radius = args.value("--partner-radius")) {
    refuse("--partner-radius", *radius, "of --partner ball alone");
  }
  if (!(t.law.grain.modulus > 0))
    refuse("--modulus", "0", "greater than 0: a material without stiffness has no contacts");
  if (!(t.density > 0)) refuse("--density", "0", "greater than 0");
  if (t.law.friction == 0) t.law.tangential_damping = 0;
  Relaxation& r = t.relaxation;
  r.step = not_negative("--step", r.step);
  r.speed = not_negative("--speed", r.speed);
  r.wait = not_negative("--wait", r.wait);
  r.waits = static_cast<int>(args.integer("--stops", 0, 1000).value_or(r.waits - 1)) + 1;
  if (!(r.step > 0) || r.step > 8)
    refuse("--step", *args.value("--step"), "above 0 and at most 8: no step beyond is stable");
  if (!(r.speed > 0)) refuse("--speed", *args.value("--speed"), "greater than 0");
  return t;
}

Json fit_json(const SoftLaw& law, const SoftLawErrors& e) {
  return {
      {"a", number(law.a)},     {"b", number(law.b)},     {"c", number(law.c)},     {"delta", number(law.delta)},
      {"a_error", number(e.a)}, {"b_error", number(e.b)}, {"c_error", number(e.c)}, {"delta_error", number(e.delta)},
      {"rms", number(law.rms)}};
}

// Forces on the partner by deformation and angle, alpha = 0 first.
Json turned_json(const SoftParticleTest& test, const std::vector<SoftMeasurement>& all) {
  Json list = Json::array();
  for (std::size_t k = 0; k < all.front().tangential.size(); ++k) {
    Samples forces;
    for (const SoftMeasurement& m : all) {
      const TangentialPoint& p = m.tangential[k];
      forces.push_back({p.along, p.perpendicular, p.normal});
    }
    const std::vector<double> mean = mean_of(forces), error = standard_error_of(forces);
    const TangentialPoint& p = all.front().tangential[k];
    list.push_back({{"delta", p.delta},
                    {"alpha", p.alpha},
                    {"h_t", p.alpha * std::numbers::pi / 180 * test.insertion.shell_radius},
                    {"along", mean[0]},
                    {"along_error", number(error[0])},
                    {"perpendicular", mean[1]},
                    {"perpendicular_error", number(error[1])},
                    {"normal", mean[2]},
                    {"normal_error", number(error[2])}});
  }
  return list;
}

// Of solid spheres of radius R_s in place of the soft ones.
double solid_force(const SoftParticleTest& test, double delta) {
  const double rs = test.insertion.shell_radius;
  const double other = test.partner == SoftPartner::ball ? test.partner_radius : rs;
  const bool at_wall = test.partner != SoftPartner::soft && test.partner != SoftPartner::ball;
  const ContactStiffness k = at_wall ? wall_stiffness(test.law, rs) : pair_stiffness(test.law, rs, other);
  return repulsion(test.law, k, -delta * rs);
}

template <class Get>
Json mean_json(const std::vector<SoftMeasurement>& all, Get get) {
  double sum = 0;
  for (const SoftMeasurement& m : all) sum += get(m);
  return sum / static_cast<double>(all.size());
}

Json report(const SoftParticleTest& test, const std::vector<SoftMeasurement>& all) {
  Json json;
  const bool packed = test.partner != SoftPartner::none;
  json["packings"] = all.size();
  json["density"] = packed ? mean_json(all, [](const SoftMeasurement& m) { return m.solid_fraction; }) : Json();
  json["grains"] = packed ? mean_json(all, [](const SoftMeasurement& m) { return m.grains; }) : Json(1);
  json["exponent"] = packed ? mean_json(all, [](const SoftMeasurement& m) { return m.exponent; }) : Json();
  json["with_smaller_steps"] =
      std::count_if(all.begin(), all.end(), [&](const SoftMeasurement& m) { return m.step < test.relaxation.step; });
  Samples forces, overlaps, residuals;
  for (const SoftMeasurement& m : all) {
    forces.emplace_back(), overlaps.emplace_back(), residuals.emplace_back();
    for (const NormalPoint& p : m.normal)
      forces.back().push_back(p.force), overlaps.back().push_back(p.largest_overlap),
          residuals.back().push_back(p.residual);
  }
  const std::vector<double> mean = mean_of(forces), error = standard_error_of(forces), overlap = mean_of(overlaps),
                            residual = mean_of(residuals);
  const SoftLaw law = fit_soft_law(test.delta, mean);
  for (std::size_t k = 0; k < test.delta.size(); ++k)
    json["normal"].push_back({{"delta", test.delta[k]},
                              {"F", mean[k]},
                              {"F_error", number(error[k])},
                              {"solid", solid_force(test, test.delta[k])},
                              {"largest_overlap", overlap[k]},
                              {"residual", residual[k]}});
  if (!test.alpha.empty()) {
    Samples along, across, prestrain;
    for (const SoftMeasurement& m : all) {
      SoftSlopes s = slopes_of(m, test.delta);
      along.push_back(s.along), across.push_back(s.across), prestrain.push_back(s.prestrain);
    }
    const auto k_t = mean_of(along), k_error = standard_error_of(along), side = mean_of(across),
               before = mean_of(prestrain);
    for (std::size_t k = 0; k < test.delta.size(); ++k)
      json["tangential"].push_back({{"delta", test.delta[k]},
                                    {"k_t", k_t[k]},
                                    {"k_t_error", number(k_error[k])},
                                    {"perpendicular", side[k]},
                                    {"prestrain", before[k]}});
    json["tangential_fit"] =
        fit_json(fit_soft_law_from(law.delta, test.delta, k_t), bootstrap_errors(test.delta, forces, along));
    json["turned"] = turned_json(test, all);
  }
  json["fit"] = fit_json(law, bootstrap_errors(test.delta, forces));
  return json;
}

// Every force that was taken.
std::string raw_csv(const std::vector<SoftMeasurement>& all) {
  std::string text = "seed,delta,alpha,normal,along,perpendicular\n";
  const auto add = [&text](double x, char end) {
    std::array<char, 32> buffer{};
    text.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr) += end;
  };
  for (const SoftMeasurement& m : all) {
    const auto seed = static_cast<double>(m.seed);
    if (m.tangential.empty())
      for (const NormalPoint& p : m.normal) {
        add(seed, ','), add(p.delta, ','), add(0, ',');
        add(p.force, ',');
        text += ",\n";
      }
    for (const TangentialPoint& p : m.tangential) {
      add(seed, ','), add(p.delta, ','), add(p.alpha, ',');
      add(p.normal, ','), add(p.along, ','), add(p.perpendicular, '\n');
    }
  }
  return text;
}

}  // namespace

int lab_soft_particle(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"--partner", "P",
        "wall (default), soft: another soft-particle, ball: a solid sphere, cage: six walls that close in together, "
        "none: "
        "one solid sphere against the wall"},
       {"--partner-radius", "R", "[m] of the ball (default RS)"},
       {"--protocol", "P", "paper (default), quasistatic, fire"},
       {"--delta", "LIST", "normal deformations h_n / R_s, ascending, as in 0.1,0.2,0.3"},
       {"--alpha", "LIST", "[degrees] rotations at each of them: tangential forces, too"},
       {"--packings", "N", "average over N packings (default 7)"},
       {"--seed", "S", "of the first packing (default 1)"},
       {"--threads", "N", "packings side by side (default: all cores)"},
       {"--radius", "RS", "[m] of the shell (default 0.016)"},
       {"--largest", "X", "[R_s] largest radius of the law of sizes (default 0.5)"},
       {"--ratio", "PI", "largest over smallest radius (default 10)"},
       {"--exponent", "B", "of the law of sizes (default 3.5)"},
       {"--volume-factor", "BETA", "volume of the listed grains over that of the shell (default 3)"},
       {"--trials", "I", "random points tried for each grain (default 30000)"},
       {"--solid-fraction", "PHI", "reach it by the choice of I"},
       {"--friction", "MU", "of grains (default 0.3)"},
       {"--shell-friction", "MU", "of shells and wall (default that of grains)"},
       {"--damping", "ZETA", "(default 0.3)"},
       {"--density", "RHO", "[kg/m^3] of the grains (default 2500)"},
       {"--modulus", "E", "[N/m^2] (default 5e5)"},
       {"--step", "C", "time step in units of the stable one of the smallest grain (default 2; quasistatic 3)"},
       {"--speed", "V", "[m/s] of the approach (default 0.05; quasistatic 0.003125)"},
       {"--stops", "N", "times at which all velocities are set to zero (default 6; quasistatic 1)"},
       {"--wait", "T", "[s] before each stop and after the last (default 0.3; quasistatic 0.02)"},
       {"--raw", "FILE.csv", "every force of every packing"},
       kJsonOption},
      {"--delta LIST", "Measures and fits the constitutive laws of soft-particles."});
  args.require_inputs(0, 0, "no operand");
  const SoftParticleTest test = test_of(args);
  const auto packings = static_cast<std::size_t>(args.integer("--packings", 1, 100000).value_or(7));
  const auto seed = static_cast<std::uint64_t>(args.integer("--seed", 0, INT32_MAX).value_or(1));
  const auto threads = static_cast<unsigned>(
      args.integer("--threads", 1, 1024).value_or(std::max(1u, std::thread::hardware_concurrency())));
  if (const auto raw = args.value("--raw")) require_writable(*raw);
  const std::vector<SoftMeasurement> all = measure_soft_particles(test, seed, packings, threads);
  if (const auto raw = args.value("--raw")) write_file_atomically(*raw, raw_csv(all));
  write_json(args, report(test, all));
  return exit_done;
}

}  // namespace isostat
