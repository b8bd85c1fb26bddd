// Section "forces": populations of repulsive, attractive and unstressed interactions (Gilabert 2007, Table VI) and the
// force distributions of Figs. 9, 10, 14, 15, 17. Of contacts and distant pairs: beams are left out.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/histogram.hpp"
#include "analysis/network/sections.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

// Interactions of one sign of N: number, mean and root mean square of |N|; and how many ends they have at grains.
struct Population {
  double count = 0, ends = 0, sum = 0, sum_of_squares = 0;
  void add(double force, double at_grains) {
    count += 1, ends += at_grains, sum += force, sum_of_squares += force * force;
  }
  double mean() const { return count > 0 ? sum / count : kUndefined; }
  double root_mean_square() const { return count > 0 ? std::sqrt(sum_of_squares / count) : kUndefined; }
};

// A contact with a wall has one end at a grain.
template <int D>
double free_ends(const Packing<D>& packing, const Link<D>& link) {
  return static_cast<double>(is_free(packing.part, idx(link.i)) + is_free(packing.part, idx(link.j)));
}

// In space its magnitude.
double tangential_of(const Link<2>& link) { return link.tangential_force; }
double tangential_of(const Link<3>& link) { return norm(link.tangential_force); }

// Fig. 15: angle between n and F in degrees; 0 repulsive, 180 tensile, both with T = 0.
template <int D>
double angle_to_normal(const Link<D>& link) {
  return std::atan2(std::abs(tangential_of(link)), link.normal_force) * (180 / std::numbers::pi);
}

nlohmann::ordered_json as_json(const Histogram& h) { return {{"edges", h.edges}, {"density", h.density}}; }
nlohmann::ordered_json as_json(const Histogram2& h) {
  return {{"edges", {h.x_edges, h.y_edges}}, {"density", h.density}};
}

std::vector<double> degrees(int from, int to, int step) {
  std::vector<double> edges;
  for (int a = from; a <= to; a += step) edges.push_back(a);
  return edges;
}

std::vector<double> decades(int from, int to, int per_decade, double unit) {
  std::vector<double> edges;
  for (int k = from * per_decade; k <= to * per_decade; ++k)
    edges.push_back(unit * std::pow(10.0, static_cast<double>(k) / per_decade));
  return edges;
}

template <int D>
nlohmann::ordered_json histograms(const Packing<D>& packing, const ForceReading& reading,
                                  const AnalysisOptions& options) {
  const double width = options.bin_width.value_or(0.02) * reading.scale;
  std::vector<double> normal, tangential, relative, magnitude, angle;
  double repulsive_sum = 0, repulsive = 0;
  for (const Link<D>& link : packing.links) {
    if (link.kind == LinkKind::beam) continue;
    const double total = force_magnitude(link);
    normal.push_back(link.normal_force);
    magnitude.push_back(total);
    if (link.normal_force > reading.threshold) repulsive_sum += link.normal_force, repulsive += 1;
    if (!is_contact(link.kind)) continue;
    tangential.push_back(tangential_of(link));
    relative.push_back(link.normal_force);
    if (total > reading.threshold) angle.push_back(angle_to_normal(link));
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (normal.empty()) return json;
  json["N"] = as_json(anchored_histogram(normal, width));
  if (!relative.empty()) json["NT"] = as_json(anchored_histogram_2(relative, tangential, width));
  if (!angle.empty()) json["angle"] = as_json(histogram_over(angle, degrees(0, 180, 2)));
  json["F"] = as_json(histogram_over(magnitude, decades(-5, 2, 10, reading.scale)));
  if (repulsive > 0) {  // Fig. 9a
    std::vector<double> over_mean;
    for (const double n : normal)
      if (n > reading.threshold) over_mean.push_back(n * repulsive / repulsive_sum);
    json["N_over_mean"] = as_json(anchored_histogram(over_mean, options.bin_width.value_or(0.1)));
  }
  return json;
}

template <int D>
nlohmann::ordered_json forces_of(const Packing<D>& packing, const ForceReading& reading,
                                 const AnalysisOptions& options) {
  Population plus, minus, zero;
  double unstressed = 0, above_tenth = 0;
  std::vector<double> magnitudes;
  for (const Link<D>& link : packing.links) {
    if (link.kind == LinkKind::beam) continue;
    const double n = link.normal_force;
    (n > reading.threshold ? plus : n < -reading.threshold ? minus : zero).add(std::abs(n), free_ends(packing, link));
    unstressed += !(force_magnitude(link) > reading.threshold);
    above_tenth += std::abs(n) > 0.1 * reading.scale;
    magnitudes.push_back(std::abs(n));
  }
  const auto grains = static_cast<double>(count_free(packing)), links = static_cast<double>(magnitudes.size());
  const PowerLaw small = fit_power_law(magnitudes, 1e-3 * reading.scale, 1e-2 * reading.scale);
  nlohmann::ordered_json json;
  json["z_plus"] = plus.ends / grains;
  json["z_minus"] = minus.ends / grains;
  json["z_zero"] = zero.ends / grains;
  json["N_plus"] = plus.mean();
  json["N_minus"] = minus.mean();
  json["N_plus_2"] = plus.root_mean_square();
  json["N_minus_2"] = minus.root_mean_square();
  json["zero_fraction"] = links > 0 ? unstressed / links : kUndefined;
  json["above_tenth_fraction"] = links > 0 ? above_tenth / links : kUndefined;
  json["small_force_exponent"] = small.exponent;
  json["small_force_exponent_error"] = small.error;
  json["threshold"] = reading.threshold;
  json["histograms"] = histograms(packing, reading, options);
  return json;
}

void add_vectors(std::vector<double>& line, const Link<2>& link) {
  line.insert(line.end(), {link.tangential_force, link.moment});
}
void add_vectors(std::vector<double>& line, const Link<3>& link) {
  line.insert(line.end(), link.tangential_force.c.begin(), link.tangential_force.c.end());
  line.insert(line.end(), link.moment.c.begin(), link.moment.c.end());
}

template <int D>
Table links_of(const Packing<D>& packing) {
  Table table{"links", {"i", "j", "distant", "h", "N", "T", "M", "F", "angle"}, {}};
  if (D == 3) table.columns = {"i", "j", "distant", "h", "N", "Tx", "Ty", "Tz", "Mx", "My", "Mz", "F", "angle"};
  for (const Link<D>& link : packing.links) {
    if (link.kind == LinkKind::beam) continue;
    const auto id = [&](std::int32_t k) { return static_cast<double>(packing.bodies.id[idx(k)]); };
    std::vector<double> line{id(link.i), id(link.j), static_cast<double>(link.kind == LinkKind::distant), link.gap,
                             link.normal_force};
    add_vectors(line, link);
    line.insert(line.end(), {force_magnitude(link), angle_to_normal(link)});
    table.rows.push_back(std::move(line));
  }
  return table;
}

}  // namespace

nlohmann::ordered_json forces_section(const AnalysisInput& input, const AnalysisOptions& options) {
  const ForceReading reading = read_forces(input);
  return input.packing_3d ? forces_of(*input.packing_3d, reading, options)
                          : forces_of(input.packing(), reading, options);
}

std::vector<Table> forces_tables(const AnalysisInput& input, const AnalysisOptions&) {
  return {input.packing_3d ? links_of(*input.packing_3d) : links_of(input.packing())};
}

}  // namespace isostat
