#include "apps/draw/subjects.hpp"

#include <algorithm>
#include <filesystem>
#include <span>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/network/coordination.hpp"
#include "analysis/network/force_scale.hpp"
#include "analysis/network/stressed_clusters.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/stiffness/link_classes.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/input_error.hpp"
#include "dem/state/smooth_walls.hpp"
#include "geometry/pores.hpp"

namespace isostat {
namespace {

using Content = std::unique_ptr<PictureContent>;

// Walls come after them.
std::size_t grains_of(const AnalysisInput& input) { return static_cast<std::size_t>(input.network().free); }

RichText length_unit(const ForceReading& reading) { return reading.law_known ? rich("`a`") : RichText{}; }

// The scale of forces, its name, and how wide a link of that force is.
struct ForceScaleMarks {
  double scale = 1;
  RichText label;                      // empty: written as a number
  double width_at_scale = kWidthAtAP;  // [a]
};
ForceScaleMarks force_scale_marks(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading,
                                  double scale) {
  const auto given = arguments.number("--scale");
  if (!reading.law_known) return {given.value_or(scale), {}};  // else of a mean force
  const bool by_attraction = input.state.law.attraction >= scale;
  const bool by_stress = !(heaviest_weight(input.packing(), input.state.scene.gravity) >= scale);
  const double width = by_attraction ? kWidthAtF0 : kWidthAtAP;
  if (given) return {*given, {}, width};
  return {scale, by_attraction ? rich("`F`_{0}") : by_stress ? rich("`aP`") : plain("heaviest weight"), width};
}

Content forces(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading, double scale) {
  if (!reading.known) throw InputError(input.path, 0, "--what", "forces", "this file gives no forces; draw grains");
  ForceOptions options;
  options.convention = convention_of(arguments);
  const ForceScaleMarks marks = force_scale_marks(arguments, input, reading, scale);
  options.scale = marks.scale, options.scale_label = marks.label, options.width_at_scale = marks.width_at_scale;
  if (!reading.cohesive) {
    const Coordination c = coordination(input.packing(), reading);
    options.rattler.assign(c.rattler.begin(), c.rattler.end());
  }
  return forces_content(std::move(options));
}

Content velocity(const AnalysisInput& input, const ForceReading& reading, const MotionScale& scale) {
  std::vector<Vec2> velocity = input.packing().bodies.velocity;
  std::vector<double> spin = input.packing().bodies.spin;
  velocity.resize(grains_of(input)), spin.resize(grains_of(input));
  MotionOptions options{std::move(velocity), std::move(spin), rich("`v`"), plain("spin"), {}, {}, {}, scale};
  if (reading.law_known) options.speed_unit = rich("`a`/`T`_{0}"), options.spin_unit = rich("/`T`_{0}");
  return motion_content(std::move(options));
}

Content mode(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading) {
  DrawnMode mode = drawn_mode(arguments, input, reading.law_known ? rich("/`T`_{0}") : RichText{});
  mode.displacement.resize(grains_of(input)), mode.rotation.resize(grains_of(input));
  return motion_content({std::move(mode.displacement),
                         std::move(mode.rotation),
                         rich("`u`"),
                         plain("rotation"),
                         {},
                         {},
                         {std::move(mode.note)}});
}

Content clusters(const AnalysisInput& input) {
  const RigidClusters rigid = rigid_clusters(input.packing(), input.network_law({}), false);
  ClusterOptions options{rigid.cluster_of_grain, rigid.cluster_of_link, {}};
  for (const RigidCluster& c : rigid.clusters) options.hyperstatic.push_back(c.hyperstatic > 0);
  return clusters_content(std::move(options));
}

Content stressed(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading, double scale) {
  if (!reading.known) throw InputError(input.path, 0, "--what", "stressed", "this file gives no forces");
  StressedOptions options;
  options.width = convention_of(arguments).width;
  if (!arguments.has("--width")) options.width = ForceMeasure::total;
  const double threshold = arguments.number("--threshold").value_or(0.01 * reading.scale);
  const auto found = stressed_clusters(input.packing(), options.width, threshold);
  options.of_grain = found.of_body, options.of_link = found.of_link, options.clusters = found.clusters.size();
  const ForceScaleMarks marks = force_scale_marks(arguments, input, reading, scale);
  options.scale = marks.scale, options.scale_label = marks.label, options.width_at_scale = marks.width_at_scale;
  options.below = plain("below ") + number_text(threshold);
  return stressed_content(std::move(options));
}

Content loops(const AnalysisInput& input) {
  try {
    return loops_content(link_classes(input.network(), input.network_law({}), false));
  } catch (const FactorisationFailed& error) {
    throw InputError(input.path, 0, "--what", "loops", error.what());
  }
}

// Outer walls run clockwise: their area is negative.
double signed_area(const Polygon& wall) {
  double twice = 0;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const Vec2 a = wall[k] - wall[0], b = wall[(k + 1) % wall.size()] - wall[0];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return twice / 2;
}

PoreMapOptions pores(const AnalysisInput& input, const ForceReading& reading) {
  const Bodies<2>& b = input.packing().bodies;
  const std::span<const Vec2> centre(b.position.data(), grains_of(input));
  const std::span<const double> radius(b.radius.data(), grains_of(input));
  PoreOptions how;
  how.with_arcs = true;
  Pores found;
  try {
    found = input.packing().cell ? find_pores(centre, radius, *input.packing().cell, how)
                                 : find_enclosed_pores(centre, radius, how);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.path, 0, "--what", "pores", error.what());
  }
  PoreMapOptions options;
  options.length_unit = length_unit(reading);
  for (std::size_t p = 0; p < found.pores.size(); ++p) {
    const Pore& pore = found.pores[p];
    options.percolating = options.percolating || pore.percolating;
    if (pore.percolating) continue;
    for (Polygon& wall : pore_polygons(found, p))
      if (signed_area(wall) < 0) options.pores.push_back({std::move(wall), pore.area, pore.equivalent_radius});
  }
  return options;
}

std::vector<Content> pores_of_all(const std::vector<AnalysisInput>& inputs, const std::vector<ForceReading>& readings) {
  std::vector<PoreMapOptions> maps;
  std::vector<PorePatch> all;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    maps.push_back(pores(inputs[k], readings[k]));
    for (const PorePatch& p : maps.back().pores) all.push_back({{}, p.area, p.radius});
  }
  std::vector<Content> contents;
  for (PoreMapOptions& map : maps) {
    map.range = radius_range(all);
    contents.push_back(pores_content(std::move(map)));
  }
  return contents;
}

std::vector<Content> contents_of(const std::string& what, const Arguments& arguments,
                                 const std::vector<AnalysisInput>& inputs, const std::vector<ForceReading>& readings) {
  if (what == "pores") return pores_of_all(inputs, readings);
  double force = 0;
  MotionScale motion;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    std::vector<Vec2> velocity = inputs[k].packing().bodies.velocity;
    std::vector<double> spin = inputs[k].packing().bodies.spin;
    velocity.resize(grains_of(inputs[k])), spin.resize(grains_of(inputs[k]));
    force = std::max(force, readings[k].scale);
    motion = larger(motion, motion_scale(velocity, spin));
  }
  std::vector<Content> contents;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    contents.push_back(what == "forces"     ? forces(arguments, inputs[k], readings[k], force)
                       : what == "velocity" ? velocity(inputs[k], readings[k], motion)
                       : what == "modes"    ? mode(arguments, inputs[k], readings[k])
                       : what == "clusters" ? clusters(inputs[k])
                       : what == "stressed" ? stressed(arguments, inputs[k], readings[k], force)
                       : what == "loops"    ? loops(inputs[k])
                                            : grains_content());
  return contents;
}

RichText caption(const AnalysisInput& input) {
  if (!input.has_law()) return plain(std::filesystem::path(input.path).filename().string());
  return rich("`t` = ") + number_with_unit(input.state.time, rich("`T`_{0}"));
}

}  // namespace

Drawing drawing_of_disks(const Arguments& arguments, const std::vector<AnalysisInput>& inputs) {
  std::vector<ForceReading> readings;
  for (const AnalysisInput& input : inputs) {
    if (input.packing().bodies.size() == 0) throw InputError(input.path, 0, "", "", "has no grains to draw");
    if (input.has_law() != inputs[0].has_law())
      throw InputError(input.path, 0, "", "",
                       "is not of one kind with " + inputs[0].path + ": only one has a law, and units");
    readings.push_back(read_forces(input));
  }
  const bool known = std::all_of(readings.begin(), readings.end(), [](const ForceReading& r) { return r.known; });
  const std::string what = what_to_draw(arguments, known);
  std::vector<Content> contents = contents_of(what, arguments, inputs, readings);
  Drawing drawing;
  drawing.length_unit = length_unit(readings[0]);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    drawing.subjects.push_back(
        std::make_unique<DiskSubject>(inputs[k].packing(), std::move(contents[k]), smooth_walls_of(inputs[k].state)));
    drawing.captions.push_back(caption(inputs[k]));
  }
  return drawing;
}

}  // namespace isostat
