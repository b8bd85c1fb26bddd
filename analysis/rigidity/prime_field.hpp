// Arithmetic modulo a prime p = 2^61 - C. Every finite double is a dyadic rational m 2^e and has an exact image here
// (p is odd), so a matrix with double entries has an exact image too, and
//
//   rank over the field <= rank over the rationals,
//
// with equality unless p divides all the maximal minors. 2^61 - 1 and 2^61 - 31 are prime.
#pragma once
#include <cmath>
#include <cstdint>

namespace isostat {

__extension__ using Wide = unsigned __int128;

template <std::uint64_t C>
struct PrimeField {
  static constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - C;
  static constexpr std::uint64_t kMask = (std::uint64_t{1} << 61) - 1;

  // Products of two residues that a Wide can add up without overflow: 64 (2^61)^2 = 2^128, and p < 2^61.
  static constexpr int kDeferred = 64;

  // Residue of any 128-bit number, by 2^61 = C (mod p).
  static std::uint64_t reduce(Wide x) {
    x = (x & kMask) + static_cast<Wide>(C) * (x >> 61);  // < 2^73
    x = (x & kMask) + static_cast<Wide>(C) * (x >> 61);  // < 2^61 + 2^18
    const auto y = static_cast<std::uint64_t>(x);
    return y >= kPrime ? y - kPrime : y;
  }

  std::uint64_t value = 0;  // in [0, p)

  PrimeField() = default;
  explicit PrimeField(std::uint64_t residue) : value(residue) {}

  static PrimeField from_integer(std::int64_t k) {
    const std::uint64_t magnitude =
        k < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(k) : static_cast<std::uint64_t>(k);
    const PrimeField r(reduce(magnitude));
    return k < 0 ? -r : r;
  }

  // Exact image of a finite double.
  static PrimeField from_double(double x) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);  // |fraction| in [1/2, 1)
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
    return from_integer(mantissa) * power_of_two(exponent - 53);
  }

  static PrimeField power_of_two(int exponent) {
    static const PrimeField half = PrimeField(2).inverse();
    return exponent >= 0 ? PrimeField(2).power(static_cast<std::uint64_t>(exponent))
                         : half.power(static_cast<std::uint64_t>(-exponent));
  }

  PrimeField power(std::uint64_t n) const {
    PrimeField result(1), square = *this;
    for (; n > 0; n >>= 1, square = square * square)
      if (n & 1) result = result * square;
    return result;
  }
  PrimeField inverse() const { return power(kPrime - 2); }  // Fermat; of 0: 0

  // Residue drawn from a counter: splitmix64 of (seed, index), never 0. Uniform to 2^-58.
  static PrimeField random(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed * 0xD1342543DE82EF95ull + index * 0x9E3779B97F4A7C15ull + 0x632BE59BD9B4E019ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return PrimeField((z ^ (z >> 31)) % (kPrime - 1) + 1);
  }

  friend PrimeField operator+(PrimeField a, PrimeField b) {
    const std::uint64_t s = a.value + b.value;
    return PrimeField(s >= kPrime ? s - kPrime : s);
  }
  friend PrimeField operator-(PrimeField a, PrimeField b) {
    return PrimeField(a.value >= b.value ? a.value - b.value : a.value + kPrime - b.value);
  }
  friend PrimeField operator-(PrimeField a) { return PrimeField(a.value == 0 ? 0 : kPrime - a.value); }
  friend PrimeField operator*(PrimeField a, PrimeField b) {
    return PrimeField(reduce(static_cast<Wide>(a.value) * b.value));
  }
  friend bool operator==(PrimeField a, PrimeField b) { return a.value == b.value; }
  bool is_zero() const { return value == 0; }
};

using FirstField = PrimeField<1>;    // p = 2^61 - 1
using SecondField = PrimeField<31>;  // p = 2^61 - 31

}  // namespace isostat
