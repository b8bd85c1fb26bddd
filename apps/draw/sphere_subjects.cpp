#include <algorithm>
#include <filesystem>
#include <map>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/slice_subject.hpp"
#include "analysis/figure/sphere_subject.hpp"
#include "analysis/network/coordination.hpp"
#include "apps/draw/space_options.hpp"
#include "apps/draw/sphere_clusters.hpp"
#include "apps/draw/subjects.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

// What all pictures of a series have in common.
struct Series {
  std::string what;
  std::vector<State<Spheres>> states;  // foreign packings, too
  std::vector<ForceReading> readings;
  bool law_known = false;
  double force = 0;   // [force] scale
  double radius = 0;  // [length] of the largest sphere
};

Series series_of(const Arguments& arguments, const std::vector<AnalysisInput>& inputs) {
  Series series;
  for (const AnalysisInput& input : inputs) {
    State<Spheres> state;
    if (input.spheres_state) state = *input.spheres_state;
    static_cast<Packing<3>&>(state.packing) = *input.packing_3d;
    if (state.packing.bodies.size() == 0) throw InputError(input.path, 0, "", "", "has no grains to draw");
    series.readings.push_back(read_forces(input));
    if (series.readings.back().law_known != series.readings[0].law_known)
      throw InputError(input.path, 0, "", "",
                       "is not of one kind with " + inputs[0].path + ": only one has a law, and units");
    series.force = std::max(series.force, series.readings.back().scale);
    for (const double r : state.packing.bodies.radius) series.radius = std::max(series.radius, r);
    series.states.push_back(std::move(state));
  }
  series.law_known = series.readings[0].law_known;
  const auto known = [](const ForceReading& r) { return r.known; };
  series.what = what_to_draw(arguments, std::all_of(series.readings.begin(), series.readings.end(), known));
  for (std::size_t k = 0; k < inputs.size(); ++k)
    if (series.what == "forces" && !series.readings[k].known)
      throw InputError(inputs[k].path, 0, "--what", "forces", "this file gives no forces; draw grains");
  if (series.what == "pores" || series.what == "modes" || series.what == "stressed" || series.what == "loops")
    throw InputError(inputs[0].path, 0, "--what", series.what, "is drawn of packings in the plane; this one is in 3D");
  return series;
}

ForceOptions force_options(const Arguments& arguments, const Series& series, std::size_t k) {
  ForceOptions options;
  options.convention = convention_of(arguments);
  options.scale = series.force;
  options.diameter = 2 * series.radius;
  options.width_at_scale = kSphereWidthAtAP;  // without a law of a mean force
  if (series.law_known) {
    const bool by_attraction = series.states[k].law.attraction >= series.force;
    options.scale_label = by_attraction ? rich("`F`_{0}") : rich("`a`^{2}`P`");
    if (by_attraction) options.width_at_scale = kWidthAtF0;
  }
  if (const auto given = arguments.number("--scale")) options.scale = *given, options.scale_label = {};
  if (!series.readings[k].cohesive) {
    const Coordination c = coordination<3>(series.states[k].packing, series.readings[k]);
    options.rattler.assign(c.rattler.begin(), c.rattler.end());
  }
  return options;
}

SphereMotion motion_of(const Series& series, std::size_t k) {
  return {series.states[k].packing.bodies.velocity, series.law_known ? rich("`a`/`T`_{0}") : RichText{}};
}

MotionScale motion_scale_of(const Series& series, const View& view) {
  MotionScale scale;
  for (std::size_t k = 0; k < series.states.size(); ++k)
    scale = larger(scale, motion_scale(motion_of(series, k), view));
  return scale;
}

// One colour a group, where there are several.
std::unique_ptr<SphereContent> grains(const SpherePacking& packing) {
  if (packing.group.empty() ||
      std::count(packing.group.begin(), packing.group.end(), packing.group[0]) == std::ssize(packing.group))
    return balls_content(std::vector<std::size_t>(packing.bodies.size(), 0), {{kGrain, {}}});
  std::map<std::int32_t, std::size_t> style_of;
  for (const std::int32_t g : packing.group) style_of[g];
  std::vector<BallStyle> styles;
  for (auto& [g, style] : style_of) {
    style = styles.size();
    styles.push_back({blend(curve_color(style), kWhite, 0.35), plain("group " + std::to_string(g))});
  }
  std::vector<std::size_t> style;
  for (const std::int32_t g : packing.group) style.push_back(style_of[g]);
  return balls_content(std::move(style), std::move(styles));
}

void add_views(Drawing& drawing, const Arguments& arguments, const std::vector<AnalysisInput>& inputs, Series& series) {
  const View view = view_of(arguments);
  DepthRange range = depth_range(series.states[0].packing, view);
  for (const State<Spheres>& s : series.states) range = around(range, depth_range(s.packing, view));
  const MotionScale motion = motion_scale_of(series, view);
  for (std::size_t k = 0; k < series.states.size(); ++k) {
    SpherePacking& packing = series.states[k].packing;
    auto content = series.what == "forces"     ? sphere_forces_content(force_options(arguments, series, k))
                   : series.what == "velocity" ? sphere_motion_content(motion_of(series, k), view, motion)
                   : series.what == "clusters" ? sphere_clusters(inputs[k])
                                               : grains(packing);
    drawing.subjects.push_back(
        std::make_unique<SphereSubject>(std::move(packing), SphereView{view, range}, std::move(content)));
  }
}

// Options of forces are about spheres; those of the circles follow from them.
ForceOptions forces_in(const SlicedSpheres& sliced, const SpherePacking& packing, ForceOptions options) {
  const std::vector<DiskShade> shade = disk_shades(packing, options.convention, options.rattler);
  for (const std::size_t k : sliced.sphere) options.shade.push_back(shade[k]);
  options.rattler.clear();
  return options;
}

std::unique_ptr<PictureContent> motion_in(const SlicedSpheres& sliced, const SphereMotion& motion, const View& view,
                                          const MotionScale& scale) {
  std::vector<Vec2> in_plane;
  std::vector<double> toward;
  for (const std::size_t k : sliced.sphere) {
    in_plane.push_back(view.flat(motion.velocity[k]));
    toward.push_back(view.depth(motion.velocity[k]));
  }
  return motion_content({std::move(in_plane),
                         std::move(toward),
                         rich("`v`"),
                         plain("toward viewer"),
                         motion.speed_unit,
                         motion.speed_unit,
                         {},
                         scale});
}

void add_slices(Drawing& drawing, const Arguments& arguments, const Slice& slice, const Series& series,
                const std::string& path) {
  const View view = view_along(slice.axis);
  const MotionScale motion = motion_scale_of(series, view);
  bool any = false;
  for (std::size_t k = 0; k < series.states.size(); ++k) {
    const SpherePacking& packing = series.states[k].packing;
    if (slice.axis == 0 && packing.cell && packing.cell->tilt != 0)
      throw InputError(path, 0, "--slice", *arguments.value("--slice"),
                       "a cell that leans along x has no periodic section across x: cut it at y or z");
    SlicedSpheres sliced = cut(packing, slice);
    any = any || !sliced.sphere.empty();
    auto content = series.what == "forces"
                       ? forces_content(forces_in(sliced, packing, force_options(arguments, series, k)))
                   : series.what == "velocity" ? motion_in(sliced, motion_of(series, k), view, motion)
                                               : grains_content();
    RichText title = rich(std::string("`") + static_cast<char>('x' + slice.axis) + "` = ") +
                     number_with_unit(slice.at, drawing.length_unit);
    drawing.subjects.push_back(
        std::make_unique<SliceSubject>(packing, slice, std::move(sliced), std::move(content), std::move(title)));
  }
  if (!any) throw InputError(path, 0, "--slice", *arguments.value("--slice"), "cuts no grain");
}

}  // namespace

Drawing drawing_of_spheres(const Arguments& arguments, const std::vector<AnalysisInput>& inputs) {
  const std::optional<Slice> slice = slice_of(arguments);
  Series series = series_of(arguments, inputs);
  if (slice && series.what == "clusters")
    throw InputError(inputs[0].path, 0, "--what", "clusters", "lie in space: leave --slice out");
  Drawing drawing;
  if (series.law_known) drawing.length_unit = rich("`a`");
  for (std::size_t k = 0; k < inputs.size(); ++k)
    drawing.captions.push_back(series.law_known
                                   ? rich("`t` = ") + number_with_unit(series.states[k].time, rich("`T`_{0}"))
                                   : plain(std::filesystem::path(inputs[k].path).filename().string()));
  if (slice)
    add_slices(drawing, arguments, *slice, series, inputs[0].path);
  else
    add_views(drawing, arguments, inputs, series);
  return drawing;
}

}  // namespace isostat
