// Cost of keeping a state: CPU seconds to hash, encode, write with sync, and read with all checks, against the number
// of grains. Random grains, two links and one remembered pair a grain, all solver arrays.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <random>

#include "dem/disks/physical_hash.hpp"
#include "dem/files/state_file.hpp"

namespace {

using namespace isostat;

State<Disks> random_state(std::size_t n) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<> real(0, 1);
  const auto vec = [&] {
    const double x = real(engine);
    return Vec2{{x, real(engine)}};
  };
  State<Disks> s;
  s.packing.cell = PeriodicCell<2>{{{1, 1}}};
  Bodies<2>& b = s.packing.bodies;
  b.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    b.id[k] = static_cast<std::int64_t>(k), b.position[k] = vec(), b.velocity[k] = vec(), b.spin[k] = real(engine);
    b.radius[k] = b.mass[k] = b.inertia[k] = 0.5;
    const auto i = static_cast<std::int32_t>(k), j = static_cast<std::int32_t>((k + 1) % n);
    for (int copy = 0; copy < 2; ++copy)
      s.packing.links.push_back({i, j, {copy, 0}, LinkKind::closed, -1, real(engine), real(engine), real(engine), 0});
    s.memory.pairs.push_back({i, j, {}, {real(engine), 0}});
  }
  for (auto* v :
       {&s.memory.half_velocity, &s.memory.force, &s.memory.lists.outer_position, &s.memory.lists.inner_position})
    *v = b.position;
  s.memory.half_spin = s.memory.torque = b.spin;
  return s;
}

template <class Work>
double cpu_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

int main() {
  const std::string path = (std::filesystem::temp_directory_path() / "isostat_bench.h5").string();
  std::printf("grains,bytes,bytes_per_grain,hash_cpu_s,encode_cpu_s,write_cpu_s,read_cpu_s\n");
  for (const std::size_t n : {1400u, 10000u, 100000u, 1000000u}) {
    const State<Disks> state = random_state(n);
    std::string image;
    const double hash = cpu_seconds([&] { (void)physical_hash(state); });
    const double encode = cpu_seconds([&] { image = encode_state(state); });
    const double write = cpu_seconds([&] { write_state(state, path); });
    const double read = cpu_seconds([&] { (void)read_state<Disks>(path); });
    std::printf("%zu,%zu,%.1f,%.4g,%.4g,%.4g,%.4g\n", n, image.size(),
                static_cast<double>(image.size()) / static_cast<double>(n), hash, encode, write, read);
  }
  std::filesystem::remove(path);
}
