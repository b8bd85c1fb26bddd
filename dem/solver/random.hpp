// Counter-based random numbers: draw k of seed s is a pure function of (s, k), so a restart needs one counter and no
// draw depends on threads. uniform() has the same bits on every platform; normal() those of the log and cos of its
// mathematics library, which are not rounded correctly everywhere. Philox 4x32 with 10 rounds (Salmon et al. 2011,
// "Parallel random numbers: as easy as 1, 2, 3").
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace isostat {

class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t counter = 0) : seed_(seed), counter_(counter) {}
  std::uint64_t counter() const { return counter_; }

  // Uniform in [0, 1), 53 bits.
  double uniform() {
    const std::array<std::uint32_t, 4> x = block(counter_++);
    const std::uint64_t bits = (std::uint64_t{x[0]} << 32 | x[1]) >> 11;
    return static_cast<double>(bits) * 0x1p-53;
  }

  // Standard normal, by Box and Muller; two draws each.
  double normal() {
    const double u = 1 - uniform(), angle = 2 * std::numbers::pi * uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(angle);
  }

 private:
  std::array<std::uint32_t, 4> block(std::uint64_t n) const {
    std::array<std::uint32_t, 4> c{static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n >> 32), 0, 0};
    auto k0 = static_cast<std::uint32_t>(seed_), k1 = static_cast<std::uint32_t>(seed_ >> 32);
    for (int round = 0; round < 10; ++round, k0 += 0x9E3779B9u, k1 += 0xBB67AE85u) {
      const std::uint64_t a = std::uint64_t{0xD2511F53u} * c[0], b = std::uint64_t{0xCD9E8D57u} * c[2];
      c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ k0, static_cast<std::uint32_t>(b),
           static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ k1, static_cast<std::uint32_t>(a)};
    }
    return c;
  }
  std::uint64_t seed_, counter_;
};

}  // namespace isostat
