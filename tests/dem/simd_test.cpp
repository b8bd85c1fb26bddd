// The vector operations that the kernels are made of, for each instruction set, against one lane at a time: random
// numbers, zeros of both signs, equal operands, batches without a lane below.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "dem/disks/kernel/pair_force.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/solver/random.hpp"
#include "tests/support/machine_isas.hpp"
#include "tests/support/simd_operations.hpp"

namespace isostat {
namespace {

constexpr std::size_t kBatch = kPairBatch, kBatches = 500, kNumbers = kBatch * kBatches;

std::uint64_t bits(double x) {
  std::uint64_t b;
  std::memcpy(&b, &x, sizeof b);
  return b;
}

// The sign of a zero that min or max gives is left open by <experimental/simd>, and g++ uses it.
bool same(SimdOperation operation, double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  const bool by_value = operation == kRoot || operation == kLarger || operation == kSmaller;
  return by_value ? a == b : bits(a) == bits(b);
}

double expected(SimdOperation operation, double a, double b, bool fused) {
  switch (operation) {
    case kSum:
      return a + b;
    case kDifference:
      return a - b;
    case kProduct:
      return a * b;
    case kQuotient:
      return a / b;
    case kOpposite:
      return -a;
    case kRoot:
      return std::sqrt(std::max(a, -a));
    case kLarger:
      return std::max(a, b);
    case kSmaller:
      return std::min(a, b);
    case kMulAdd:
      return fused ? std::fma(a, b, a) : a * b + a;
    case kChosenByLess:
      return a < b ? a : b;
    case kChosenByNot:
      return !(a < b) ? a : b;
    case kChosenByBoth:
      return a < b && a < 0 ? a : b;
    default:
      return a < 0 && !(a < b) ? -a : 0;  // kMasked
  }
}

TEST(Simd, EveryOperationIsThatOfALane) {
  Random random(23);
  std::vector<double> x(kNumbers), y(kNumbers);
  const auto number = [&] {
    const double u = random.uniform();
    return u < 0.05 ? 0.0 : u < 0.1 ? -0.0 : 2 * random.uniform() - 1;
  };
  for (std::size_t n = 0; n < kNumbers; ++n) {
    x[n] = number(), y[n] = n % 7 == 0 ? x[n] : number();
    if (n / kBatch % 3 == 0 && y[n] > x[n]) std::swap(x[n], y[n]);  // none of this batch below
    if (n / kBatch % 3 == 1 && n % kBatch != n / kBatch % kBatch && y[n] > x[n]) std::swap(x[n], y[n]);  // at most one
  }
  for (const Isa isa : machine_isas()) {
    const SimdOperations run = isa == Isa::avx512 ? simd_operations_avx512
                               : isa == Isa::avx2 ? simd_operations_avx2
                                                  : simd_operations_scalar;
    std::vector<std::vector<double>> result(kSimdOperations, std::vector<double>(kNumbers));
    std::array<double*, kSimdOperations> out{};
    for (std::size_t k = 0; k < kSimdOperations; ++k) out[k] = result[k].data();
    run(x.data(), y.data(), kNumbers, out.data());

    for (std::size_t k = 0; k < kAnyLess; ++k) {
      std::size_t wrong = 0;
      for (std::size_t n = 0; n < kNumbers; ++n) {
        const auto operation = static_cast<SimdOperation>(k);
        wrong += !same(operation, expected(operation, x[n], y[n], isa != Isa::scalar), result[k][n]);
      }
      EXPECT_EQ(wrong, 0u) << "of " << kNumbers << ", operation " << k << ", " << name(isa);
    }
    const std::size_t lanes = isa == Isa::avx512 ? 16 : isa == Isa::avx2 ? 8 : 1;
    std::size_t without = 0;
    for (std::size_t n = 0; n < kNumbers; n += lanes) {
      bool any = false;
      double sum = 0, magnitude = 0;
      for (std::size_t l = n; l < n + lanes; ++l) any = any || x[l] < y[l], sum += x[l], magnitude += std::abs(x[l]);
      without += !any;
      for (std::size_t l = n; l < n + lanes; ++l) {
        EXPECT_EQ(result[kAnyLess][l], any ? 1 : 0) << name(isa);
        EXPECT_NEAR(result[kReduced][l], sum, 1e-15 * magnitude) << name(isa);
      }
    }
    EXPECT_GT(without, kBatches / 4);
    EXPECT_LT(without, kNumbers / lanes);
  }
}

}  // namespace
}  // namespace isostat
