// Section "loops": how strong the forces are in links that bear a self-stress by rolling moments alone (Gilabert 2007,
// Sec. IV.B.4: "of the same order of magnitude as mu_r F0/a"), beside those of trees and of hyperstatic clusters.
//
// What the paper calls forces of loops are those outside the clusters that are self-stressed without rolling
// resistance, too. So links fall into three classes. Trees: on no closed loop; statics lets them bear nothing.
// Clusters: some self-stress of the contacts without their moments passes through them. Loops: the rest; every
// self-stress in them needs moments, which mu_r N_e limits, and so a force of about 2 mu_r F0 over the width of the
// loop.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/histogram.hpp"
#include "analysis/network/loops.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/link_classes.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kSupport = 1e-8;       // of a projected random force of size 1: smaller ones are rounding
constexpr double kLeastForce = 1e-12;   // [F1] smaller ones count as this in the histogram
constexpr double kHistogramBin = 0.25;  // of log10 of the force

struct ClassForces {
  std::vector<double> total, mobilisation;  // sorted; |M|/(mu_r N_e) of contacts that a rolling law limits
};

ClassForces forces_of(const AnalysisInput& input, const std::vector<LinkClass>& classes, LinkClass which) {
  ClassForces f;
  const DiskLaw& law = input.state.law;
  const std::vector<Link<2>>& links = input.packing().links;
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (classes[l] != which || links[l].kind == LinkKind::beam) continue;
    f.total.push_back(force_magnitude(links[l]));
    const double limit = -law.rolling_friction * law.normal_stiffness * links[l].gap;
    if (is_contact(links[l].kind) && limit > 0) f.mobilisation.push_back(std::abs(links[l].moment) / limit);
  }
  std::sort(f.total.begin(), f.total.end());
  return f;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? kUndefined : sum / static_cast<double>(values.size());
}

double quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return kUndefined;
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at), above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

// Without forces in the input only their number.
Json class_json(const ClassForces& f, double scale, bool forces_known) {
  const std::vector<double>& total = f.total;
  double squares = 0;
  for (const double v : total) squares += v * v;
  const auto known = [&](double v) { return forces_known ? v : kUndefined; };
  Json json;
  json["links"] = total.size();
  json["mean"] = known(mean_of(total));
  json["rms"] = known(total.empty() ? kUndefined : std::sqrt(squares / static_cast<double>(total.size())));
  json["median"] = known(quantile(total, 0.5)), json["largest"] = known(quantile(total, 1));
  json["mean_over_scale"] = known(mean_of(total) / scale);
  json["median_over_scale"] = known(quantile(total, 0.5) / scale);
  json["mean_mobilisation"] = known(mean_of(f.mobilisation));
  return json;
}

Json histogram_of(const ClassForces& f, double unit) {
  std::vector<double> logs;
  for (const double v : f.total) logs.push_back(std::log10(std::max(v / unit, kLeastForce)));
  const Histogram h = anchored_histogram(logs, kHistogramBin);
  return {{"edges", h.edges}, {"density", h.density}};
}

constexpr std::array<LinkClass, 3> kClasses{LinkClass::tree, LinkClass::loop, LinkClass::cluster};
constexpr std::array<const char*, 3> kNames{"trees", "loops", "clusters"};

}  // namespace

std::vector<LinkClass> link_classes(const LinkNetwork& network, NetworkLaw law, bool cell_free) {
  const Packing<2>& packing = network.packing;
  const LoopCount loops = count_loops(packing);
  const NetworkLaw without_moments = law == NetworkLaw::rolling ? NetworkLaw::friction : law;
  const RigidityMatrix g = rigidity_matrix(network, without_moments, cell_free);
  // A random force, projected: with probability 1 it passes wherever some self-stress does.
  std::mt19937_64 engine(20070111);
  std::vector<double> random(idx(g.rows()));
  for (double& f : random) f = 2 * std::ldexp(static_cast<double>(engine() >> 11), -53) - 1;
  const std::vector<double> stress = split_forces(network, without_moments, cell_free, random).self_stress;
  std::vector<LinkClass> classes(packing.links.size(), LinkClass::loop);
  for (std::size_t r = 0; r < stress.size(); ++r)
    if (std::abs(stress[r]) > kSupport) classes[idx(g.link_of_row[r])] = LinkClass::cluster;
  for (std::size_t l = 0; l < classes.size(); ++l)
    if (!loops.on_loop[l]) classes[l] = LinkClass::tree;
  return classes;
}

Json loops_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const LoopCount count = count_loops(input.packing());
  const ForceReading reading = read_forces(input);
  // mu_r F0/a with mu_r in units of length: a moment limit over the length a = 1 of reduced units.
  const double scale =
      input.state.law.rolling_friction > 0 ? input.state.law.rolling_friction * reading.scale : kUndefined;
  Json json;
  json["independent"] = count.independent, json["components"] = count.components;
  json["scale"] = scale;
  std::vector<LinkClass> classes;
  try {
    classes = link_classes(input.network(), input.network_law(options), options.cell_free);
  } catch (const FactorisationFailed& e) {
    json["failed"] = std::string("the independent columns are too nearly dependent for double precision: ") + e.what();
    return json;
  }
  json["histograms"] = Json::object();
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    const ClassForces f = forces_of(input, classes, kClasses[c]);
    json[kNames[c]] = class_json(f, scale, reading.known);
    if (reading.known && !f.total.empty())
      json["histograms"][std::string("log10_F_") + kNames[c]] = histogram_of(f, reading.scale);
  }
  return json;
}

std::vector<Table> loops_tables(const AnalysisInput& input, const AnalysisOptions& options) {
  Table table{"links", {"i", "j", "s1", "s2", "class", "N", "T", "M", "F"}, {}};
  try {
    const auto classes = link_classes(input.network(), input.network_law(options), options.cell_free);
    const Packing<2>& packing = input.packing();
    for (std::size_t l = 0; l < classes.size(); ++l) {
      const Link<2>& link = packing.links[l];
      table.rows.push_back({static_cast<double>(packing.bodies.id[idx(link.i)]),
                            static_cast<double>(packing.bodies.id[idx(link.j)]), double(link.shift[0]),
                            double(link.shift[1]), static_cast<double>(classes[l]), link.normal_force,
                            link.tangential_force, link.moment, force_magnitude(link)});
    }
  } catch (const FactorisationFailed&) {
    return {};  // the section says why
  }
  return {table};
}

}  // namespace isostat
