// Time of a step of grains of triangles, ns per free triangle, by stage: settled beds of squares, a dam break, the same
// with other laws, integrators, walls, instruction sets and threads.
//   triangles_bench STATE.h5 PART...   parts: stages, variants, flow, tilesN (N beds side by side); a number:
//   triangle-steps of a round from then on
// The state: a settled bed in a box with smooth walls (isostat pack data/scenes/triangles-settle.toml). CSV on stdout.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "dem/files/state_file.hpp"
#include "dem/solver/clocks.hpp"
#include "dem/triangles/grain_store.hpp"
#include "dem/triangles/lab/throughput.hpp"
#include "dem/triangles/sample.hpp"
#include "dem/triangles/time_step.hpp"
#include "geometry/base/index.hpp"

using namespace isostat;
using BedState = State<TriangleGrains>;

namespace {

constexpr int kRounds = 3;
double triangle_steps = 1.2e7;      // of a round; a number among the parts changes it
constexpr double kFlowing = 0.06;   // [s] after the wall of a dam is gone
constexpr double kSeamSteps = 4e7;  // triangle-steps in which tiles put side by side settle against each other

struct Variant {
  std::string name;
  BedState state;
  Isa isa = best_isa();
  int threads = 1;
};

// The beams' kernel alone [s a step], over and over: what it reads stays in the cache if it fits.
double beam_seconds(const Variant& v) {
  GrainStore store;
  store.load(v.state.packing, v.state.law, {});
  const TriangleKernels kernels = triangle_kernels({}, {v.state.law.damping > 0, false}, false, v.isa);
  kernels.corners(0, store.slots(), store.arrays());
  AlignedVector<double> work(store.most_work() + 8);
  BeamInput in;
  in.blocks = store.blocks().data(), in.end = store.blocks().size(), in.arrays = store.arrays();
  in.half_step = 0.5 * v.state.time_step, in.work = work.data();
  const int passes = std::max(3, static_cast<int>(2e6 / static_cast<double>(v.state.packing.bodies.size())));
  std::vector<double> seconds;
  for (int r = 0; r < 5; ++r) {
    const double before = cpu_seconds(1);
    for (int k = 0; k < passes; ++k) kernels.beams(in);
    seconds.push_back((cpu_seconds(1) - before) / passes);
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[2];
}

// In turn, so that a shared machine slows all alike; the median by total time.
void measure(const std::vector<Variant>& variants) {
  std::vector<std::vector<lab::TriangleThroughput>> found(variants.size());
  for (int r = 0; r < kRounds; ++r)
    for (std::size_t k = 0; k < variants.size(); ++k) {
      const Variant& v = variants[k];
      lab::TriangleThroughputSetup setup;
      setup.isa = v.isa, setup.threads = v.threads;
      setup.steps = std::max<std::int64_t>(
          64, static_cast<std::int64_t>(triangle_steps / static_cast<double>(v.state.packing.bodies.size())));
      found[k].push_back(lab::measure_throughput(v.state, setup));
    }
  for (std::size_t k = 0; k < variants.size(); ++k) {
    std::sort(found[k].begin(), found[k].end(),
              [](const auto& a, const auto& b) { return a.cpu_seconds < b.cpu_seconds; });
    const lab::TriangleThroughput& t = found[k][kRounds / 2];
    const double each = 1e9 / (double(t.triangles) * double(t.steps));
    // Stages are sampled every 64 steps, which rebuilds of lists in step with that would all miss or all meet: lists
    // are what the others leave of the whole. Best on a quiet machine.
    const auto stage = [&](Stage s) {
      return each * t.cpu_seconds / t.wall_seconds * t.times.seconds[static_cast<std::size_t>(s)];
    };
    const double lists = t.cpu_seconds * each - stage(Stage::motion) - stage(Stage::forces) - stage(Stage::stress);
    const double beams = 1e9 * beam_seconds(variants[k]) / double(t.triangles);
    std::printf("%lld,%s,%s,%d,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f\n", static_cast<long long>(t.grains),
                variants[k].name.c_str(), std::string(name(variants[k].isa)).c_str(), variants[k].threads,
                t.cpu_seconds * each, t.wall_seconds * each, stage(Stage::motion), lists, stage(Stage::forces) - beams,
                beams, stage(Stage::stress), t.pairs_per_triangle, 1e3 * double(t.rebuilds) / double(t.steps));
    std::fflush(stdout);
  }
}

std::vector<Isa> sets() {
  std::vector<Isa> all;
  for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::scalar})
    if (isa <= machine_isa()) all.push_back(isa);
  return all;
}

// Only what `keep` names of its grains; the memory of the run is gone.
BedState with_grains(const BedState& from, const std::function<bool(std::size_t)>& keep) {
  BedState to = from;
  to.memory = {};
  TrianglePacking& p = to.packing;
  p = {};
  p.grains.begin.push_back(0);
  std::vector<std::int32_t> place(from.packing.bodies.size(), -1);
  for (std::size_t g = 0; g < from.packing.grains.size(); ++g) {
    if (!keep(g)) continue;
    const TrianglePacking& q = from.packing;
    for (std::size_t k = idx(q.grains.begin[g]); k < idx(q.grains.begin[g + 1]); ++k) {
      const std::size_t n = p.bodies.size();
      place[k] = static_cast<std::int32_t>(n);
      p.bodies.resize(n + 1);
      p.bodies.id[n] = q.bodies.id[k], p.bodies.position[n] = q.bodies.position[k];
      p.bodies.velocity[n] = q.bodies.velocity[k], p.bodies.spin[n] = q.bodies.spin[k];
      p.bodies.radius[n] = q.bodies.radius[k], p.bodies.mass[n] = q.bodies.mass[k];
      p.bodies.inertia[n] = q.bodies.inertia[k];
      p.corner.push_back(q.corner[k]), p.angle.push_back(q.angle[k]);
    }
    p.grains.id.push_back(q.grains.id[g]), p.grains.part.push_back(q.grains.part[g]);
    p.grains.radius.push_back(q.grains.radius[g]);
    p.grains.begin.push_back(static_cast<std::int32_t>(p.bodies.size()));
  }
  for (Link<2> l : from.packing.links) {
    l.i = place[idx(l.i)], l.j = place[idx(l.j)];
    if (l.i < 0 || l.j < 0) continue;
    p.beams.push_back(from.packing.beams[idx(l.beam)]);
    l.beam = static_cast<std::int32_t>(p.beams.size()) - 1;
    p.links.push_back(l);
  }
  return to;
}

bool is_free(const BedState& s, std::size_t g) { return s.packing.grains.part[g] == GrainPart::free; }

// Without its right wall, under way.
BedState dam_break(const BedState& bed) {
  double right = 0;
  const auto x = [&](std::size_t g) { return bed.packing.bodies.position[idx(bed.packing.grains.begin[g])][0]; };
  for (std::size_t g = 0; g < bed.packing.grains.size(); ++g)
    if (!is_free(bed, g)) right = std::max(right, x(g));
  BedState flow = with_grains(bed, [&](std::size_t g) { return is_free(bed, g) || x(g) < right; });
  Solver<TriangleGrains> solver(flow, {});
  solver.run(static_cast<std::int64_t>(kFlowing / flow.time_step));
  solver.snapshot(flow);
  return flow;
}

BedState with_walls_of_grains(const BedState& bed) {
  Scene scene = bed.scene;
  scene.container.walls = ContainerWalls::grains;
  return start_from(bed, "bed", scene, 1);
}

// Side by side in a wider box.
BedState tiled(const BedState& bed, int tiles) {
  const BedState one = with_grains(bed, [&](std::size_t g) { return is_free(bed, g); });
  BedState all = one;
  const auto bodies = static_cast<std::int32_t>(one.packing.bodies.size());
  std::int64_t last = 0;
  for (const std::int64_t id : one.packing.bodies.id) last = std::max(last, id + 1);
  for (const std::int64_t id : one.packing.grains.id) last = std::max(last, id + 1);
  const double width = bed.scene.container.width;
  TrianglePacking& p = all.packing;
  p = {};
  p.grains.begin.push_back(0);
  for (int k = 0; k < tiles; ++k) {
    const TrianglePacking& q = one.packing;
    for (std::size_t b = 0; b < q.bodies.size(); ++b) {
      const std::size_t n = p.bodies.size();
      p.bodies.resize(n + 1);
      p.bodies.id[n] = q.bodies.id[b] + k * last;
      p.bodies.position[n] = q.bodies.position[b] + Vec2{{width * (k - 0.5 * (tiles - 1)), 0}};
      p.bodies.velocity[n] = q.bodies.velocity[b], p.bodies.spin[n] = q.bodies.spin[b];
      p.bodies.radius[n] = q.bodies.radius[b], p.bodies.mass[n] = q.bodies.mass[b];
      p.bodies.inertia[n] = q.bodies.inertia[b];
      p.corner.push_back(q.corner[b]), p.angle.push_back(q.angle[b]);
    }
    for (std::size_t g = 0; g < q.grains.size(); ++g) {
      p.grains.id.push_back(q.grains.id[g] + k * last), p.grains.part.push_back(GrainPart::free);
      p.grains.radius.push_back(q.grains.radius[g]);
      p.grains.begin.push_back(q.grains.begin[g + 1] + k * bodies);
    }
    for (Link<2> l : q.links) {
      l.i += k * bodies, l.j += k * bodies;
      p.beams.push_back(q.beams[idx(l.beam)]);
      l.beam = static_cast<std::int32_t>(p.beams.size()) - 1;
      p.links.push_back(l);
    }
  }
  Scene scene = bed.scene;
  scene.container.width = width * tiles;
  return start_from(all, "tiled", scene, 1);
}

BedState settled_seams(BedState wide) {
  Solver<TriangleGrains> solver(wide, {});
  solver.run(static_cast<std::int64_t>(kSeamSteps / static_cast<double>(wide.packing.bodies.size())));
  solver.snapshot(wide);
  return wide;
}

void variants(const BedState& bed) {
  const auto changed = [&](const char* label, const std::function<void(BedState&)>& change) {
    Variant v{label, bed};
    change(v.state);
    return v;
  };
  std::vector<Variant> all{{"settled", bed}};
  all.push_back(changed("friction", [](BedState& s) { s.law.friction = 0.3, s.law.tangential_stiffness = 1e5; }));
  all.push_back(
      changed("breaking", [](BedState& s) { s.law.failure = BeamFailure::break_, s.law.limit_tension = 1e12; }));
  all.push_back(changed("no dampers", [](BedState& s) { s.law.damping = 0; }));
  all.push_back(changed("Gear", [](BedState& s) {
    s.scene.step.integrator = Integrator::gear, s.memory = {};
    s.time_step *= 0.2 / triangle_step_fraction(s.scene);
  }));
  all.push_back(changed("paper law", [](BedState& s) { s.law.contact = ContactLaw::paper; }));
  all.push_back({"walls of grains", with_walls_of_grains(bed)});
  measure(all);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("triangles_bench STATE.h5 [TRIANGLE_STEPS] stages|variants|flow|tilesN ...\n", stderr);
    return 2;
  }
  const BedState bed = read_state<TriangleGrains>(argv[1]);
  std::printf(
      "grains,variant,isa,threads,cpu_ns,wall_ns,motion_ns,lists_ns,overlaps_ns,beams_ns,books_ns,"
      "pairs_per_triangle,rebuilds_per_1000_steps\n");
  for (int k = 2; k < argc; ++k) {
    const std::string part = argv[k];
    std::vector<Variant> all;
    if (std::isdigit(static_cast<unsigned char>(part[0]))) triangle_steps = std::stod(part);
    if (part == "variants") variants(bed);
    if (part == "stages")
      for (const Isa isa : sets()) all.push_back({"settled", bed, isa});
    if (part == "flow") {
      const BedState flow = dam_break(bed);
      for (const Isa isa : sets()) all.push_back({"dam break", flow, isa});
    }
    if (part.starts_with("tiles")) {
      const BedState wide = settled_seams(tiled(bed, std::stoi(part.substr(5))));
      all = {{"tiled", wide, best_isa(), 1}, {"tiled", wide, best_isa(), 2}, {"tiled", wide, Isa::avx2, 1}};
    }
    if (!all.empty()) measure(all);
  }
  return 0;
}
