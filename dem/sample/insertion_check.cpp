#include <algorithm>
#include <cmath>

#include "dem/sample/enclosure.hpp"
#include "dem/sample/insertion_scene.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

constexpr double kMostListed = 1e8;    // 64 bytes each are in use
constexpr double kLargestRatio = 1e6;  // of the room to r_min: what the levels of FreeVolume resolve
constexpr double kMostTrials = 1e15;   // counted in doubles

class Rules {
 public:
  Rules(const InsertionScene& scene, int dimension) : scene_(scene), dimension_(dimension) {}

  std::vector<SceneConflict> all() {
    const InsertionScene& s = scene_;
    const bool min = positive("radius_min", s.radius_min), max = positive("radius_max", s.radius_max);
    bool ordered = min && max;
    if (ordered && !(s.radius_min <= s.radius_max)) {
      refuse("radius_min", s.radius_min, "at most radius_max = " + real_text(s.radius_max), {"radius_max"});
      ordered = false;
    }
    const bool finite = std::isfinite(s.exponent);
    if (!finite) refuse("exponent", s.exponent, "a finite number");
    // With soft-particles the list is what is wanted: of more than fits, the large grains would leave them no room.
    const bool listable =
        std::isfinite(s.volume_factor) && (s.soft_share > 0 ? s.volume_factor > 0 : s.volume_factor >= 1);
    if (!listable)
      refuse("volume_factor", s.volume_factor, s.soft_share > 0 ? "above 0, and finite" : "at least 1, and finite");
    if (!(s.trials >= 1 && s.trials <= kMostTrials)) refuse("trials", s.trials, "from 1 to 1e15");
    if (s.solid_fraction && !(*s.solid_fraction > 0 && *s.solid_fraction < 1))
      refuse("solid_fraction", *s.solid_fraction, "between 0 and 1, both excluded");
    if (!(s.soft_share >= 0 && s.soft_share < 1)) refuse("soft_share", s.soft_share, "at least 0 and below 1");
    if (s.soft_share > 0 && positive("soft_radius", s.soft_radius) && max && s.soft_radius > s.radius_max)
      refuse("soft_radius", s.soft_radius, "at most radius_max = " + real_text(s.radius_max), {"radius_max"});
    if (s.soft_share > 0 && s.radius_min == s.radius_max && s.soft_radius == s.radius_min)
      refuse("soft_radius", s.soft_radius, "not the radius of all other grains", {"radius_min", "radius_max"});
    const double has = room(max);
    if (ordered && has > 0 && shortest() > kLargestRatio * s.radius_min)
      refuse("radius_min", s.radius_min,
             "at least a millionth of the room's shortest edge or diameter, " + real_text(shortest()),
             {"shell_radius", "box_1", "box_2", "box_3"});
    if (ordered && finite && listable && has > 0) length_of_list(has);
    return std::move(found_);
  }

 private:
  void refuse(const std::string& name, double value, const std::string& rule, std::vector<std::string> others = {}) {
    others.insert(others.begin(), name);
    for (std::string& key : others) key = "insertion." + key;
    found_.push_back({others.front(), real_text(value), rule, std::move(others)});
  }
  bool positive(const std::string& name, double value) {
    const bool fine = std::isfinite(value) && value > 0;
    if (!fine) refuse(name, value, "above 0, and finite");
    return fine;
  }

  // Its measure; 0 if something is wrong with it.
  double room(bool max_is_known) {
    const InsertionScene& s = scene_;
    if (s.room == InsertionRoom::shell) {
      if (!positive("shell_radius", s.shell_radius)) return 0;
      if (max_is_known && s.shell_radius < s.radius_max) {
        refuse("shell_radius", s.shell_radius, "at least radius_max = " + real_text(s.radius_max), {"radius_max"});
        return 0;
      }
      return dimension_ == 2 ? ball_measure<2>(s.shell_radius) : ball_measure<3>(s.shell_radius);
    }
    double measure = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
      const std::string name = "box_" + std::to_string(k + 1);
      if (!positive(name, s.box[k])) {
        measure = 0;
      } else if (max_is_known && s.box[k] < 2 * s.radius_max) {
        refuse(name, s.box[k], "at least twice radius_max = " + real_text(s.radius_max), {"radius_max"});
        measure = 0;
      }
      measure *= s.box[k];
    }
    return measure;
  }

  double shortest() const {
    if (scene_.room == InsertionRoom::shell) return 2 * scene_.shell_radius;
    return *std::min_element(scene_.box.begin(), scene_.box.begin() + dimension_);
  }

  void length_of_list(double measure) {
    const double one = ball_measure_of_mean(), listed = scene_.volume_factor * measure / one;
    if (!(listed <= kMostListed))
      refuse("radius_min", scene_.radius_min,
             "so small that some " + real_text(std::round(listed)) + " grains would be listed; at most 1e8",
             {"radius_max", "exponent", "volume_factor"});
  }
  double ball_measure_of_mean() const {
    const double moment = scene_.sizes().moment(dimension_);
    return moment * (dimension_ == 2 ? ball_measure<2>(1) : ball_measure<3>(1));
  }

  const InsertionScene& scene_;
  int dimension_;
  std::vector<SceneConflict> found_;
};

}  // namespace

std::vector<SceneConflict> insertion_conflicts(const InsertionScene& scene, int dimension) {
  return Rules(scene, dimension).all();
}

std::vector<SceneConflict> radius_conflicts(const std::vector<double>& radii, double radius_min, double radius_max) {
  std::vector<SceneConflict> found;
  for (std::size_t k = 0; k < radii.size(); ++k)
    if (!(radii[k] >= radius_min && radii[k] <= radius_max))
      found.push_back({"radius " + std::to_string(k + 1),
                       real_text(radii[k]),
                       "between " + real_text(radius_min) + " and " + real_text(radius_max),
                       {}});
  return found;
}

}  // namespace isostat
