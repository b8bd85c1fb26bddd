// The digest that a physical hash is made with: XXH3-128 over numbers in the order in which they are added.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "dem/state/state.hpp"

namespace isostat {

class Digest {
 public:
  Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;
  ~Digest();

  void add(double x) { raw(x + 0.0); }  // -0 + 0 = +0
  void add(std::int64_t n) { raw(n); }
  template <int D>
  void add(const Vec<D>& v) {
    for (const double x : v.c) add(x);
  }
  void add(std::string_view text);
  std::string hex() const;  // 32 digits

 private:
  template <class T>
  void raw(T value) {
    bytes(&value, sizeof value);
  }
  void bytes(const void* data, std::size_t size);
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

// Weight, where the container stands and what has left it; a state without adds nothing.
void add_surroundings(Digest& digest, double gravity, const Surroundings& surroundings);

}  // namespace isostat
