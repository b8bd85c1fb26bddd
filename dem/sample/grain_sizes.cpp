#include "dem/sample/grain_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "dem/input_error.hpp"
#include "dem/sample/size_table.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

constexpr double kLeastKept = 0.01;  // of a log-normal law between its cuts: draws beyond them are taken back

double normal_between(double a, double b) {
  const double root = std::numbers::sqrt2;
  return 0.5 * (a > 0 ? std::erfc(a / root) - std::erfc(b / root) : std::erfc(-b / root) - std::erfc(-a / root));
}

// The classes of two sizes, shares by number.
std::vector<SizeClass> two_sizes(const SizesScene& s, int dimension) {
  double large = s.large_share;
  if (s.share_of == ShareOf::volume) {
    const double ratio = std::pow(s.diameter_min / s.diameter_max, dimension);
    large = large * ratio / (large * ratio + (1 - large));
  }
  std::vector<SizeClass> classes;
  if (large < 1) classes.push_back({1 - large, {s.diameter_min, s.diameter_min, 0}, 1});
  if (large > 0) classes.push_back({large, {s.diameter_max, s.diameter_max, 0}, s.density_ratio});
  return classes;
}

LogNormalSizes log_normal(const SizesScene& s, int dimension) {
  double median = s.median.value_or(std::sqrt(s.diameter_min * s.diameter_max));
  if (s.share_of == ShareOf::volume) median *= std::exp(-dimension * s.log_deviation * s.log_deviation);
  return {s.diameter_min, s.diameter_max, median, s.log_deviation};
}

}  // namespace

double LogNormalSizes::kept() const {
  return normal_between(std::log(min / median) / deviation, std::log(max / median) / deviation);
}

double LogNormalSizes::moment(int k) const {
  const double shift = k * deviation;
  return std::pow(median, k) * std::exp(0.5 * shift * shift) *
         normal_between(std::log(min / median) / deviation - shift, std::log(max / median) / deviation - shift) /
         kept();
}

GrainSizes::GrainSizes(const SizesScene& s, int dimension) {
  const double weight = s.share_of == ShareOf::volume ? dimension : 0;
  switch (s.law()) {
    case SizeLaw::uniform:
      // In the plane and in space the same law, each in the arithmetic whose bits its scenes have.
      if (dimension == 2 && weight == 0)
        law_ = UniformSizes{s.diameter_min, s.diameter_max};
      else
        law_ = SizeDistribution{s.diameter_min, s.diameter_max, weight};
      break;
    case SizeLaw::power_law:
      law_ = SizeDistribution{s.diameter_min, s.diameter_max, s.exponent.value_or(0) + weight};
      break;
    case SizeLaw::lognormal:
      law_ = log_normal(s, dimension);
      break;
    case SizeLaw::bidisperse:
      law_ = two_sizes(s, dimension);
      break;
    case SizeLaw::table:
      law_ = read_size_table(s.size_table, s.share_of, dimension, s.diameter_max);
      break;
  }
}

namespace {

double draw_one(const UniformSizes& law, Random& random) { return law.min + (law.max - law.min) * random.uniform(); }
double draw_one(const SizeDistribution& law, Random& random) { return law.draw(random); }
double draw_one(const LogNormalSizes& law, Random& random) {
  for (;;) {
    const double d = law.median * std::exp(law.deviation * random.normal());
    if (d >= law.min && d <= law.max) return d;
  }
}

// Grain k is of the class in which the share (k + 1/2) / N of all grains lies.
DrawnSizes draw_classes(const std::vector<SizeClass>& classes, std::size_t count, Random& random) {
  DrawnSizes drawn;
  double until = 0;
  const bool unlike = std::any_of(classes.begin(), classes.end(), [](const SizeClass& c) { return c.density != 1; });
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const SizeClass& k = classes[c];
    const std::size_t before = drawn.diameter.size();
    until += k.share;
    const bool last = c + 1 == classes.size();
    while (drawn.diameter.size() < count &&
           (last || static_cast<double>(drawn.diameter.size()) + 0.5 < until * static_cast<double>(count))) {
      drawn.diameter.push_back(k.range.radius_min == k.range.radius_max ? k.range.radius_min : k.range.draw(random));
      if (unlike) drawn.density.push_back(k.density);
    }
    if (drawn.diameter.size() == before)
      throw InputError("scene", 0, "grains.count", std::to_string(count),
                       "no grain falls to the diameter " + real_text(k.range.radius_max) + " a, which has the share " +
                           real_text(k.share) + " by number; at least " + real_text(std::ceil(1 / k.share)) +
                           " grains have one");
  }
  return drawn;
}

}  // namespace

DrawnSizes GrainSizes::draw(std::size_t count, Random& random) const {
  return std::visit(
      [&](const auto& law) -> DrawnSizes {
        if constexpr (std::is_same_v<std::decay_t<decltype(law)>, std::vector<SizeClass>>) {
          return draw_classes(law, count, random);
        } else {
          DrawnSizes drawn{std::vector<double>(count), {}};
          for (double& d : drawn.diameter) d = draw_one(law, random);
          return drawn;
        }
      },
      law_);
}

double GrainSizes::mean_power(int k) const {
  if (const auto* u = std::get_if<UniformSizes>(&law_)) return SizeDistribution{u->min, u->max, 0}.moment(k);
  if (const auto* p = std::get_if<SizeDistribution>(&law_)) return p->moment(k);
  if (const auto* l = std::get_if<LogNormalSizes>(&law_)) return l->moment(k);
  double sum = 0;
  for (const SizeClass& c : std::get<std::vector<SizeClass>>(law_)) sum += c.share * c.range.moment(k);
  return sum;
}

std::vector<SceneConflict> size_conflicts(const SizesScene& s, int dimension) {
  std::vector<SceneConflict> found;
  const SizeLaw law = s.law();
  if (law != SizeLaw::table && s.diameter_min > s.diameter_max)
    found.push_back({"grains.diameter_min",
                     real_text(s.diameter_min),
                     "at most grains.diameter_max = " + real_text(s.diameter_max),
                     {"grains.diameter_min", "grains.diameter_max"}});
  const std::string sizes = quoted_text(kSizeLawNames[static_cast<std::size_t>(s.sizes)]);
  if (law == SizeLaw::power_law && !s.exponent)
    found.push_back({"grains.exponent", "", "is wanted, since grains.sizes is " + sizes, {"grains.sizes"}});
  if (law == SizeLaw::table && s.size_table.empty())
    found.push_back({"grains.size_table",
                     quoted_text(s.size_table),
                     "a CSV file of diameter,share is wanted, since grains.sizes is " + sizes,
                     {"grains.sizes", "grains.size_table"}});
  if (law != SizeLaw::table && !s.size_table.empty())
    found.push_back(
        {"grains.sizes", sizes, "\"table\", since grains.size_table is given", {"grains.sizes", "grains.size_table"}});
  if (law == SizeLaw::lognormal && found.empty())
    if (const double kept = log_normal(s, dimension).kept(); !(kept >= kLeastKept))
      found.push_back(
          {s.median ? "grains.median" : "grains.log_deviation",
           real_text(s.median.value_or(s.log_deviation)),
           "only the part " + real_text(kept) +
               " of this law, by number, lies between grains.diameter_min and grains.diameter_max, at "
               "least 0.01 has to: a median between them, or a smaller deviation",
           {"grains.median", "grains.share_of", "grains.log_deviation", "grains.diameter_min", "grains.diameter_max"}});
  return found;
}

}  // namespace isostat
