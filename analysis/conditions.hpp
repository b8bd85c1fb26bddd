// What the inputs of one ensemble should have in common, or it averages over it.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/input.hpp"

namespace isostat {

class Conditions {
 public:
  explicit Conditions(const AnalysisInput& input);
  // In words, what is not the same: "laws", "imposed stresses"; empty: nothing.
  std::string difference(const Conditions& other) const;

 private:
  std::array<double, 8> disks_{};  // numbers of DiskLaw
  SphereLaw spheres_;
  TriangleLaw triangles_;
  std::vector<std::optional<double>> stress_;
};

}  // namespace isostat
