#include <algorithm>
#include <filesystem>
#include <numeric>

#include "analysis/figure/triangle_content.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "apps/draw/subjects.hpp"
#include "dem/input_error.hpp"
#include "dem/state/container_motion.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Content = std::unique_ptr<TriangleContent>;

const TrianglePacking& grains_of(const AnalysisInput& input) { return input.triangles->packing; }

// The triangle that each body of the network is: the free ones first (triangle_network()).
std::vector<std::size_t> triangle_of_body(const TrianglePacking& packing) {
  const std::vector<std::int32_t> grain = grain_of(packing.grains);
  std::vector<std::size_t> order(grain.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t k) { return packing.grains.part[idx(grain[k])] == GrainPart::free; });
  return order;
}

std::vector<Content> forces(const Arguments& arguments, const std::vector<AnalysisInput>& inputs) {
  TriangleForceOptions options;
  options.convention = convention_of(arguments);
  std::vector<double> means;  // the middle one: a series may hold a violent impact, and frames without a force
  for (const AnalysisInput& input : inputs)
    if (const double mean = mean_overlap_force(grains_of(input)); mean > 0) means.push_back(mean);
  std::sort(means.begin(), means.end());
  options.scale = arguments.number("--scale").value_or(means.empty() ? 0 : means[means.size() / 2]);
  std::vector<Content> contents;
  for (std::size_t k = 0; k < inputs.size(); ++k) contents.push_back(triangle_forces_content(options));
  return contents;
}

std::vector<Content> velocities(const std::vector<AnalysisInput>& inputs) {
  std::vector<GrainMotion> motions;
  MotionScale scale;
  for (const AnalysisInput& input : inputs) {
    const TrianglePacking& p = grains_of(input);
    motions.push_back(grain_motion(p, p.bodies.velocity, p.bodies.spin));
    scale = larger(scale, motion_scale(motions.back().velocity, motions.back().spin));
  }
  std::vector<Content> contents;
  for (GrainMotion& m : motions)
    contents.push_back(triangle_motion_content(
        std::move(m), {{}, {}, rich("`v`"), plain("spin"), plain("cm/s"), plain("/s"), {}, scale}));
  return contents;
}

Content mode(const Arguments& arguments, const AnalysisInput& input) {
  const TrianglePacking& p = grains_of(input);
  DrawnMode mode = drawn_mode(arguments, input, plain("/s"));
  std::vector<Vec2> displacement(p.bodies.size());
  std::vector<double> rotation(p.bodies.size());
  const std::vector<std::size_t> triangle = triangle_of_body(p);
  for (std::size_t i = 0; i < triangle.size(); ++i)
    displacement[triangle[i]] = mode.displacement[i], rotation[triangle[i]] = mode.rotation[i];
  return triangle_motion_content(grain_motion(p, displacement, rotation),
                                 {{}, {}, rich("`u`"), plain("rotation"), {}, {}, {std::move(mode.note)}});
}

Content clusters(const AnalysisInput& input) {
  const LinkNetwork network = input.network();
  const RigidClusters rigid = rigid_clusters(network, input.network_law({}), false);
  TriangleClusterOptions options;
  const std::vector<std::size_t> triangle = triangle_of_body(grains_of(input));
  options.of_body.assign(triangle.size(), -1);
  for (std::size_t i = 0; i < rigid.cluster_of_grain.size(); ++i)
    options.of_body[triangle[i]] = rigid.cluster_of_grain[i];
  for (std::size_t l = 0; l < network.links(); ++l)
    network.each_bond(l, [&](std::int32_t i, std::int32_t j, const ImageShift<2>&) {
      options.meet.push_back({rigid.cluster_of_grain[idx(i)], rigid.cluster_of_grain[idx(j)]});
    });
  for (const RigidCluster& c : rigid.clusters) options.hyperstatic.push_back(c.hyperstatic > 0);
  return triangle_clusters_content(std::move(options));
}

std::vector<Content> contents_of(const std::string& what, const Arguments& arguments,
                                 const std::vector<AnalysisInput>& inputs) {
  if (what == "forces") return forces(arguments, inputs);
  if (what == "velocity") return velocities(inputs);
  std::vector<Content> contents;
  for (const AnalysisInput& input : inputs)
    contents.push_back(what == "clusters" ? clusters(input)
                       : what == "modes"  ? mode(arguments, input)
                                          : triangle_grains_content());
  return contents;
}

// A network was never run: its name tells more than a time.
RichText caption(const AnalysisInput& input) {
  if (!(input.triangles->time_step > 0)) return plain(std::filesystem::path(input.path).filename().string());
  return rich("`t` = ") + number_with_unit(input.triangles->time, plain("s"));
}

}  // namespace

Drawing drawing_of_triangles(const Arguments& arguments, const std::vector<AnalysisInput>& inputs) {
  bool overlaps = false;
  for (const AnalysisInput& input : inputs) {
    if (input.grains() == 0) throw InputError(input.path, 0, "", "", "has no grains to draw");
    overlaps = overlaps || !grains_of(input).overlaps.empty();
  }
  const std::string what = what_to_draw(arguments, overlaps);
  if (what == "pores" || what == "stressed" || what == "loops")
    throw InputError(inputs[0].path, 0, "--what", what, "is about disks; this packing is of triangles");
  std::vector<Content> contents = contents_of(what, arguments, inputs);
  Drawing drawing;
  drawing.length_unit = plain("cm");
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const State<TriangleGrains>& state = *inputs[k].triangles;
    drawing.subjects.push_back(std::make_unique<TriangleSubject>(
        grains_of(inputs[k]), std::move(contents[k]), room_of(state.scene.container, container_of(state).offset)));
    drawing.captions.push_back(caption(inputs[k]));
  }
  return drawing;
}

}  // namespace isostat
