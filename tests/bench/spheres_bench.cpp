// Speed of the step of spheres on dense static packings, by instruction set: million grain-steps per CPU second and the
// time of each stage [ns a grain-step].
//   spheres_bench PACKING.net... [--law KEYWORD] [--copies N] [--steps N] [--threads N] [--rebuild] [--shell] [--isa
//   NAME]
// A packing is read as grains in a periodic cell, put N times beside itself along each edge (--copies N), and relaxed
// for some steps under Hertz and Mindlin's law with E = 1e6, nu = .3, mu = .3, zeta = .3, density 1. KEYWORD: friction
// (default), frictionless, rolling. --rebuild: the outer list anew every 20 steps, as in a flow. --shell: the
// grains that fit into a shell in the cell, without the cell.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "dem/solver/clocks.hpp"
#include "dem/spheres/engine.hpp"

using namespace isostat;

namespace {

struct Options {
  std::string law = "friction", isa;
  int copies = 1, threads = 1;
  std::int64_t steps = 0;
  bool rebuild = false, shell = false;
  std::vector<std::string> files;
};

SpherePacking read_grains(const std::string& path) {
  std::ifstream in(path);
  if (!in) std::fprintf(stderr, "cannot read %s\n", path.c_str()), std::exit(2);
  SpherePacking p;
  Bodies<3>& b = p.bodies;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "cell") {
      Vec3 l;
      words >> l[0] >> l[1] >> l[2];
      p.cell = PeriodicCell<3>{l};
    } else if (key == "grain") {
      const std::size_t k = b.size();
      b.resize(k + 1);
      words >> b.id[k] >> b.position[k][0] >> b.position[k][1] >> b.position[k][2] >> b.radius[k];
    }
  }
  return p;
}

SpherePacking tiled(const SpherePacking& p, int copies) {
  SpherePacking out = p;
  out.cell->length = copies * p.cell->length;
  out.bodies.resize(0);
  for (int c = 0; c < copies * copies * copies; ++c) {
    const Vec3 at = p.cell->offset({c % copies, c / copies % copies, c / copies / copies});
    for (std::size_t k = 0; k < p.bodies.size(); ++k) {
      const std::size_t n = out.bodies.size();
      out.bodies.resize(n + 1);
      out.bodies.id[n] = static_cast<std::int64_t>(n) + 1;
      out.bodies.position[n] = p.bodies.position[k] + at, out.bodies.radius[n] = p.bodies.radius[k];
    }
  }
  return out;
}

// Those that touch the shell are pressed into it a little, as by a weight.
SpherePacking in_shell(const SpherePacking& p) {
  SpherePacking out;
  SphereWall shell;
  shell.shape = WallShape::shell, shell.group = 0;
  shell.radius = 0.5 * *std::min_element(p.cell->length.c.begin(), p.cell->length.c.end());
  shell.point = 0.5 * p.cell->length;
  out.walls = {shell};
  for (std::size_t k = 0; k < p.bodies.size(); ++k) {
    const Vec3 r = p.cell->wrap(p.bodies.position[k]);
    if (norm(r - shell.point) + 0.5 * p.bodies.radius[k] > shell.radius) continue;
    const std::size_t n = out.bodies.size();
    out.bodies.resize(n + 1);
    out.bodies.id[n] = static_cast<std::int64_t>(n) + 1;
    out.bodies.position[n] = r, out.bodies.radius[n] = p.bodies.radius[k];
  }
  out.walls[0].radius *= 1.02;
  return out;
}

State<Spheres> begun(SpherePacking packing, const Options& o) {
  State<Spheres> s;
  SphereLawScene law;
  law.modulus = 1e6, law.poisson = 0.3, law.friction = o.law == "frictionless" ? 0 : 0.3, law.damping = 0.3;
  law.rolling = o.law == "rolling";
  s.law = resolve(law);
  Bodies<3>& b = packing.bodies;
  double lightest = INFINITY;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const double r = b.radius[k];
    b.mass[k] = 4.0 / 3 * 3.14159265358979324 * r * r * r, b.inertia[k] = 0.4 * b.mass[k] * r * r;
    lightest = std::min(lightest, b.mass[k] / r);
  }
  // k_N at an overlap of 1e-3 diameters of the smallest grain is some .06 E R.
  s.time_step = 0.1 * std::sqrt(lightest / (0.06 * law.modulus));
  if (packing.cell) s.cell_motion.reference_length = packing.cell->length;
  s.packing = std::move(packing);
  return s;
}

void measure(const std::string& file, const State<Spheres>& settled, Isa isa, const Options& o) {
  SolverOptions options;
  options.isa = isa, options.threads = o.threads;
  Solver solver(settled, CellControl<3>{}, options);
  const auto n = static_cast<double>(settled.packing.bodies.size());
  const std::int64_t steps = o.steps > 0 ? o.steps : std::max<std::int64_t>(20, static_cast<std::int64_t>(2e7 / n));
  solver.run(std::max<std::int64_t>(10, steps / 10));
  const StepTimes before = solver.times();
  const std::size_t outer = solver.engine().lists().outer_rebuilds(), inner = solver.engine().lists().inner_rebuilds();
  const double cpu = cpu_seconds(o.threads);
  for (std::int64_t k = 0; k < steps; ++k) {
    if (o.rebuild && k % 20 == 0) solver.engine().update_lists(solver.cell(), 1e3);
    solver.step();
  }
  const double seconds = cpu_seconds(o.threads) - cpu;
  std::printf("%s,%s,%s,%.0f,%d,%.2f,%.2f", file.substr(file.rfind('/') + 1).c_str(), o.law.c_str(),
              std::string(name(isa)).c_str(), n, o.threads, n * static_cast<double>(steps) / seconds * 1e-6,
              static_cast<double>(solver.engine().lists().inner_pairs()) / n);
  for (std::size_t k = 0; k < before.seconds.size(); ++k)
    std::printf(",%.2f", (solver.times().seconds[k] - before.seconds[k]) / n / static_cast<double>(steps) * 1e9);
  std::printf(",%zu,%zu\n", solver.engine().lists().inner_rebuilds() - inner,
              solver.engine().lists().outer_rebuilds() - outer);
  if (o.shell) {
    State<Spheres> end = settled;
    solver.snapshot(end);
    std::printf("# contacts of pairs %zu, at the wall %zu\n", end.packing.links.size(), end.packing.wall_links.size());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  Options o;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    const auto value = [&] { return k + 1 < count ? std::string(words[++k]) : std::string("0"); };
    if (word == "--law")
      o.law = value();
    else if (word == "--copies")
      o.copies = std::stoi(value());
    else if (word == "--threads")
      o.threads = std::stoi(value());
    else if (word == "--steps")
      o.steps = std::stoll(value());
    else if (word == "--isa")
      o.isa = value();
    else if (word == "--shell")
      o.shell = true;
    else if (word == "--rebuild")
      o.rebuild = true;
    else
      o.files.push_back(word);
  }
  std::printf(
      "packing,law,isa,grains,threads,mega_grain_steps_per_cpu_s,pairs_per_grain,motion_ns,neighbours_ns,"
      "forces_ns,stress_ns,inner_rebuilds,outer_rebuilds\n");
  for (const std::string& file : o.files) {
    SpherePacking grains = tiled(read_grains(file), o.copies);
    State<Spheres> s = begun(o.shell ? in_shell(grains) : std::move(grains), o);
    Solver settle(s, CellControl<3>{}, {});
    settle.set_drag(2 / (100 * s.time_step));
    settle.run(500);
    settle.snapshot(s);
    for (const Isa isa : {Isa::scalar, Isa::avx2, Isa::avx512})
      if (isa <= best_isa() && (o.isa.empty() || o.isa == name(isa))) measure(file, s, isa, o);
  }
}
