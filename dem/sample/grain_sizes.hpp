// The diameters of grains as a scene asks for them (SizesScene), and samples of so many.
//
// A law by volume is one by number times d^-D: of a uniform or power law another power law, of a log-normal one the
// same with its median times exp(-D sigma^2) (Hatch and Choate 1929), and shares of classes are divided by their mean
// d^D.
#pragma once
#include <variant>
#include <vector>

#include "dem/sample/size_distribution.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/sizes.hpp"

namespace isostat {

struct UniformSizes {
  double min, max;
};

// Of ln d, cut at two diameters.
struct LogNormalSizes {
  double min, max, median, deviation;
  double kept() const;         // the part of the law between the cuts
  double moment(int k) const;  // of the cut law
};

// Grains of one diameter, or spread between two.
struct SizeClass {
  double share;            // by number; those of all classes are 1 together
  SizeDistribution range;  // of diameters
  double density = 1;      // [-] over that of other grains
};

struct DrawnSizes {
  std::vector<double> diameter;
  std::vector<double> density;  // [-] of each over that of a grain of density 1; empty: all 1
};

class GrainSizes {
 public:
  // Of a space of so many dimensions. Reads the table, if the law is one: throws InputError for a faulty one.
  GrainSizes(const SizesScene& scene, int dimension);

  // So many grains. Those of classes are as many as their shares say, rounded, in ascending order; throws InputError if
  // a class gets none.
  DrawnSizes draw(std::size_t count, Random& random) const;

  double mean_power(int k) const;  // [a^k] mean of d^k, by number

 private:
  std::variant<UniformSizes, SizeDistribution, LogNormalSizes, std::vector<SizeClass>> law_;
};

// Broken rules between the keys of sizes; those of a table are told when it is read.
std::vector<SceneConflict> size_conflicts(const SizesScene& scene, int dimension);

}  // namespace isostat
