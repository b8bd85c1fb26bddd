// Arithmetic modulo a prime p = 2^B - C. Every finite double is a dyadic rational m 2^e and has an exact image here
// (p is odd), so a matrix with double entries has an exact image too, and
//
//   rank over the field <= rank over the rationals,
//
// with equality unless p divides all the maximal minors. 2^52 - 47, 2^52 - 143 and 2^61 - 1 are prime. Residues of 52
// bits are what the integer multiply-add of AVX-512 takes, eight at a time (modular_products.hpp); 61 bits are for
// questions that are asked once, where a chance of 1 / p a comparison has to do.
#pragma once
#include <cmath>
#include <cstdint>

namespace isostat {

__extension__ using Wide = unsigned __int128;

template <int B, std::uint64_t C>
struct PrimeField {
  static_assert(B > 42 && B < 62 && C < 256);
  static constexpr int kBits = B;
  static constexpr std::uint64_t kComplement = C;
  static constexpr std::uint64_t kPrime = (std::uint64_t{1} << B) - C;
  static constexpr std::uint64_t kMask = (std::uint64_t{1} << B) - 1;

  // Products of two residues that a Wide can add up without overflow: 64 (2^61)^2 = 2^128, and p < 2^61.
  static constexpr int kDeferred = 64;

  // Residue of any 128-bit number, by 2^B = C (mod p).
  static std::uint64_t reduce(Wide x) {
    x = (x & kMask) + static_cast<Wide>(C) * (x >> B);  // < 2^B + 2^(136 - B)
    x = (x & kMask) + static_cast<Wide>(C) * (x >> B);  // < 2^B + 2^(144 - 2 B) + C, less than 2 p
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
  // Of 0: 0. Euclid's algorithm on (p, value), which keeps s_k value = +-r_k (mod p) with alternating signs.
  PrimeField inverse() const {
    std::uint64_t r0 = kPrime, r1 = value, s0 = 0, s1 = 1;
    bool negative = false;
    while (r1 > 1) {
      const std::uint64_t q = r0 / r1, r2 = r0 - q * r1, s2 = s0 + q * s1;
      r0 = r1, r1 = r2, s0 = s1, s1 = s2;
      negative = !negative;
    }
    const PrimeField s(r1 == 0 ? 0 : s1);
    return negative ? -s : s;
  }

  // Residue drawn from a counter: splitmix64 of (seed, index), never 0. Uniform to 2^(B - 64).
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

using FirstField = PrimeField<52, 47>;
using SecondField = PrimeField<52, 143>;
using WideField = PrimeField<61, 1>;

}  // namespace isostat
