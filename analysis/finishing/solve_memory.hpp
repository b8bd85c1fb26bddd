// A static solve under way, written into the state and read back: whoever keeps such a state goes on within the solve,
// to the same bits. Classes of the solve have one transfer(io) for both ways.
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "dem/disks/disks.hpp"
#include "dem/input_error.hpp"

namespace isostat {

class SolveWriter {
 public:
  static constexpr bool writes = true;
  void real(double x) { memory_.numbers.push_back(x); }
  void whole(std::int64_t n) { memory_.indices.push_back(static_cast<std::int32_t>(n)); }
  void vector(const Vec2& v) { real(v[0]), real(v[1]); }
  template <class T>
  std::size_t count(const std::vector<T>& list) {
    whole(static_cast<std::int64_t>(list.size()));
    return list.size();
  }
  SolveMemory take() { return std::move(memory_); }

 private:
  SolveMemory memory_;
};

class SolveReader {
 public:
  static constexpr bool writes = false;
  explicit SolveReader(const SolveMemory& memory) : memory_(memory) {}

  void real(double& x) { x = next(memory_.numbers, number_); }
  template <class Integer>
  void whole(Integer& n) {
    n = static_cast<Integer>(next(memory_.indices, index_));
  }
  void vector(Vec2& v) { real(v[0]), real(v[1]); }
  template <class T>
  std::size_t count(std::vector<T>& list) {
    std::int32_t size = 0;
    whole(size);
    require(size >= 0 && static_cast<std::size_t>(size) <= memory_.numbers.size());
    list.resize(static_cast<std::size_t>(size));
    return list.size();
  }
  void end() const { require(number_ == memory_.numbers.size() && index_ == memory_.indices.size()); }
  static void require(bool sound) {
    if (!sound) throw InputError("state", 0, "memory/solve", "", "is no static solve of this packing");
  }

 private:
  template <class T>
  T next(const std::vector<T>& list, std::size_t& at) {
    require(at < list.size());
    return list[at++];
  }
  const SolveMemory& memory_;
  std::size_t number_ = 0, index_ = 0;
};

template <class Io, class Reals>
void transfer_reals(Io& io, Reals& list) {
  const std::size_t n = io.count(list);
  for (std::size_t k = 0; k < n; ++k) io.real(list[k]);
}
template <class Io, class Vectors>
void transfer_vectors(Io& io, Vectors& list) {
  const std::size_t n = io.count(list);
  for (std::size_t k = 0; k < n; ++k) io.vector(list[k]);
}

}  // namespace isostat
