#include "dem/sample/insertion.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "dem/input_error.hpp"
#include "dem/sample/placement.hpp"

namespace isostat {
namespace {

constexpr double kMostTrials = 1e6;    // of the search for a solid fraction
constexpr double kTrialsRatio = 1.02;  // to which it finds I

template <int D>
double volume(const std::vector<double>& radii) {
  double sum = 0;
  for (const double r : radii) sum += ball_measure<D>(r);
  return sum;
}

// A list, and what becomes of it for each I: always the same draws after the list.
template <int D>
class Insertion {
 public:
  Insertion(const InsertionScene& scene, std::uint64_t seed)
      : most_(scene.radius_max),
        soft_(scene.soft_share > 0 ? scene.soft_radius : 0.0),
        enclosure_(enclosure_of<D>(scene)),
        random_(seed) {
    radii_ = listed_radii(scene, D, enclosure_.measure(), random_);
  }

  void insert(double trials) {
    placed_ = place(enclosure_, radii_, trials, random_);
    blind_ += placed_.work.blind_trials, points_ += placed_.work.points;
    cells_ = std::max(cells_, placed_.work.cells);
    trials_ = trials;
  }
  std::size_t placed() const { return placed_.radius.size(); }
  double solid_fraction(std::size_t count) const {
    return volume<D>(grown(enclosure_, placed_, count, most_, soft_)) / enclosure_.measure();
  }
  InsertedGrains<D> result(std::size_t count, bool reached) const {
    const auto end = static_cast<std::ptrdiff_t>(count);
    InsertedGrains<D> r;
    r.enclosure = enclosure_;
    r.position.assign(placed_.position.begin(), placed_.position.begin() + end);
    r.drawn_radius.assign(placed_.radius.begin(), placed_.radius.begin() + end);
    r.radius = grown(enclosure_, placed_, count, most_, soft_);
    if (soft_ > 0)
      for (const double drawn : r.drawn_radius) r.soft.push_back(drawn == soft_ ? 1 : 0);
    r.solid_fraction = volume<D>(r.radius) / enclosure_.measure();
    r.trials = trials_, r.reached = reached;
    r.work = {blind_, points_, cells_, radii_.size()};
    return r;
  }

 private:
  double most_, soft_;
  Enclosure<D> enclosure_;
  Random random_;
  std::vector<double> radii_;
  Placed<D> placed_;
  double trials_ = 0, blind_ = 0;
  std::uint64_t points_ = 0;
  std::size_t cells_ = 0;
};

// The smallest I that reaches the solid fraction, then the fewest of its grains: the last ones only, so that the sizes
// keep their law.
template <int D>
InsertedGrains<D> reach(Insertion<D>& insertion, double wanted) {
  const auto reaches = [&](double trials) {
    insertion.insert(trials);
    return insertion.solid_fraction(insertion.placed()) >= wanted;
  };
  double low = 0, high = 1;
  while (!reaches(high)) {
    if (high >= kMostTrials) return insertion.result(insertion.placed(), false);
    low = high, high *= 10;
  }
  double last = high;
  while (low > 0 && high > kTrialsRatio * low && high - low > 1) {
    const double middle = std::floor(std::sqrt(low * high) + 0.5);
    if (middle <= low || middle >= high) break;
    last = middle;
    (reaches(middle) ? high : low) = middle;
  }
  if (last != high) insertion.insert(high);
  std::size_t too_few = 0, enough = insertion.placed();
  while (enough - too_few > 1) {
    const std::size_t middle = too_few + (enough - too_few) / 2;
    (insertion.solid_fraction(middle) >= wanted ? enough : too_few) = middle;
  }
  return insertion.result(enough, true);
}

}  // namespace

std::vector<double> listed_radii(const InsertionScene& scene, int dimension, double measure, Random& random) {
  const SizeDistribution sizes = scene.sizes();
  const auto volume_of = [dimension](double r) { return dimension == 2 ? ball_measure<2>(r) : ball_measure<3>(r); };
  const double listed = scene.volume_factor * measure;
  std::vector<double> radii;
  for (double sum = 0; sum <= (1 - scene.soft_share) * listed;) {
    radii.push_back(sizes.draw(random));
    sum += volume_of(radii.back());
  }
  if (scene.soft_share > 0)
    radii.insert(radii.end(),
                 static_cast<std::size_t>(std::ceil(scene.soft_share * listed / volume_of(scene.soft_radius))),
                 scene.soft_radius);
  std::sort(radii.begin(), radii.end(), std::greater<>());
  return radii;
}

template <int D>
Enclosure<D> enclosure_of(const InsertionScene& scene) {
  if (scene.room == InsertionRoom::shell) return Enclosure<D>::shell(scene.shell_radius);
  Vec<D> length;
  for (int k = 0; k < D; ++k) length[k] = scene.box[static_cast<std::size_t>(k)];
  return Enclosure<D>::box(length);
}

template <int D>
InsertedGrains<D> insert_grains(const InsertionScene& scene, std::uint64_t seed) {
  std::vector<Fault> faults;
  for (const SceneConflict& c : insertion_conflicts(scene, D)) faults.push_back({"scene", 0, c.key, c.value, c.rule});
  if (!faults.empty()) throw InputError(std::move(faults));
  Insertion<D> insertion(scene, seed);
  if (scene.solid_fraction) return reach(insertion, *scene.solid_fraction);
  insertion.insert(scene.trials);
  return insertion.result(insertion.placed(), true);
}

template Enclosure<2> enclosure_of<2>(const InsertionScene&);
template Enclosure<3> enclosure_of<3>(const InsertionScene&);
template InsertedGrains<2> insert_grains<2>(const InsertionScene&, std::uint64_t);
template InsertedGrains<3> insert_grains<3>(const InsertionScene&, std::uint64_t);

}  // namespace isostat
