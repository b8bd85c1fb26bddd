#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/scene/check.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

constexpr double kStepsPerPeriod = 20;  // of a vibration
constexpr double kLargestJump = 0.01;   // [smallest size] of a wall in a step

class Rules {
 public:
  explicit Rules(const Scene& scene) : scene_(scene) {}

  std::vector<SceneConflict> all() {
    const ContainerScene& c = scene_.container;
    if (c.shape == ContainerShape::none)
      without_container();
    else
      with_container();
    if (is_collision(scene_)) in_free_space();
    if (c.shape == ContainerShape::hopper && !(c.opening < c.width))
      refuse("container.opening", real_text(c.opening),
             "the outlet is narrower than the hopper, container.width = " + real_text(c.width), {"container.width"});
    if (c.shape == ContainerShape::drum && c.walls == ContainerWalls::grains && !(c.wall_size < c.radius))
      refuse("container.wall_size", real_text(c.wall_size),
             "the grains of the wall are smaller than the drum, container.radius = " + real_text(c.radius),
             {"container.radius", "container.walls"});
    for (std::size_t i = 0; i < scene_.stages.size(); ++i) stage(i);
    return std::move(found_);
  }

 private:
  void refuse(const std::string& key, const std::string& value, const std::string& rule,
              std::vector<std::string> others) {
    others.insert(others.begin(), {key, "container.shape"});
    found_.push_back({key, value, rule, std::move(others)});
  }

  void without_container() {
    if (scene_.gravity > 0)
      refuse("gravity", real_text(scene_.gravity), "needs a container: in a periodic cell all grains would fall", {});
  }

  void in_free_space() {
    if (scene_.container.shape != ContainerShape::none)
      refuse("grains.arrangement", quoted_text("collision"),
             "two grains collide in free space: container.shape is \"none\"", {"grains.file"});
    for (std::size_t i = 0; i < scene_.stages.size(); ++i)
      for (const std::string& key : cell_keys(scene_.stages[i], i))
        refuse(key, "", "a key of the periodic cell, and two grains collide in free space",
               {"grains.arrangement", "grains.file"});
  }

  void with_container() {
    for (std::size_t i = 0; i < scene_.stages.size(); ++i)
      for (const std::string& key : cell_keys(scene_.stages[i], i))
        refuse(key, "", "a key of the periodic cell, and container.shape is " + shape() + ": there is none", {});
    if (!scene_.output.snapshot_solid_fractions.empty())
      refuse("output.snapshot_solid_fractions", "",
             "needs a periodic cell, and container.shape is " + shape() + ": there is none", {});
  }

  void stage(std::size_t i) {
    const ContainerMotionScene& m = scene_.stages[i].container;
    const auto key = [i](const char* name) { return stage_key(i, name); };
    const ContainerShape is = scene_.container.shape;
    if (m.open && is != ContainerShape::hopper)
      refuse(key("open"), "true", "only a hopper has an outlet; container.shape is " + shape(), {});
    if (m.rotation != 0 && is != ContainerShape::drum)
      refuse(key("rotation"), real_text(m.rotation), "only a drum turns; container.shape is " + shape(), {});
    if (m.vibration_amplitude > 0 && is == ContainerShape::none)
      refuse(key("vibration_amplitude"), real_text(m.vibration_amplitude), "needs a container", {});
    if (m.vibration_amplitude > 0 && !(m.vibration_frequency > 0))
      refuse(key("vibration_frequency"), real_text(m.vibration_frequency),
             "greater than 0, since " + key("vibration_amplitude") + " is", {key("vibration_amplitude")});
    end(i);
  }

  void end(std::size_t i) {
    const StageScene& s = scene_.stages[i];
    const std::string until = stage_key(i, "until"), value = quoted_text(name(s.until));
    if (s.until == Until::empty || s.until == Until::clogged) {
      if (scene_.container.shape != ContainerShape::hopper)
        refuse(until, value, "only a hopper has an outlet; container.shape is " + shape(), {});
      else if (!opened(i))
        refuse(until, value, "needs " + stage_key(i, "open") + " = true, or that of a stage before",
               {stage_key(i, "open")});
    }
    if (s.until == Until::separated && !is_collision(scene_))
      refuse(until, value, "only of a collision: grains.arrangement = \"collision\"",
             {"grains.arrangement", "grains.file"});
    if (waits_for_equilibrium(s.until) && (s.container.vibration_amplitude > 0 || s.container.rotation != 0))
      refuse(until, value, "grains never come to rest in a container that moves; \"time\"",
             {stage_key(i, "vibration_amplitude"), stage_key(i, "rotation")});
  }

  bool opened(std::size_t last) const {
    return std::any_of(scene_.stages.begin(), scene_.stages.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                       [](const StageScene& s) { return s.container.open; });
  }

  std::string shape() const {
    return quoted_text(kContainerShapeNames[static_cast<std::size_t>(scene_.container.shape)]);
  }

  const Scene& scene_;
  std::vector<SceneConflict> found_;
};

}  // namespace

std::vector<std::string> cell_keys(const StageScene& s, std::size_t index) {
  std::vector<std::string> keys;
  if (s.pressure) keys.push_back(stage_key(index, "pressure"));
  if (!s.pressures.empty()) keys.push_back(stage_key(index, "pressures"));
  if (s.stress_1) keys.push_back(stage_key(index, "stress_1"));
  if (s.stress_2) keys.push_back(stage_key(index, "stress_2"));
  if (s.stress_3) keys.push_back(stage_key(index, "stress_3"));
  if (s.strain_rate_1) keys.push_back(stage_key(index, "strain_rate_1"));
  if (s.strain_rate_2) keys.push_back(stage_key(index, "strain_rate_2"));
  if (s.strain_rate_3) keys.push_back(stage_key(index, "strain_rate_3"));
  if (s.stress_12) keys.push_back(stage_key(index, "stress_12"));
  if (s.shear_rate) keys.push_back(stage_key(index, "shear_rate"));
  if (s.max_edge_speed) keys.push_back(stage_key(index, "max_edge_speed"));
  return keys;
}

std::vector<SceneConflict> surroundings_conflicts(const Scene& scene) { return Rules(scene).all(); }

std::vector<SceneConflict> wall_motion_conflicts(const Scene& scene, double time_step, double smallest_size) {
  std::vector<SceneConflict> found;
  if (scene.container.shape == ContainerShape::none) return found;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const ContainerMotionScene& m = scene.stages[i].container;
    const std::string amplitude = stage_key(i, "vibration_amplitude"), frequency = stage_key(i, "vibration_frequency"),
                      rotation = stage_key(i, "rotation");
    const double fastest = 1 / (kStepsPerPeriod * time_step);
    const bool slow = m.vibration_frequency <= fastest;
    if (m.vibration_amplitude > 0 && !slow)
      found.push_back({frequency,
                       real_text(m.vibration_frequency),
                       "faster than the time step " + real_text(time_step) + ": a period needs " +
                           real_text(kStepsPerPeriod) + " steps; at most " + real_text(fastest),
                       {frequency, amplitude, "step.fraction"}});
    const double speed = kLargestJump * smallest_size / time_step;  // of a wall, the largest allowed
    const double shake = 2 * std::numbers::pi * m.vibration_frequency;
    if (slow && m.vibration_amplitude * shake > speed)
      found.push_back({amplitude,
                       real_text(m.vibration_amplitude),
                       "closes on grains: a wall would move by more than a hundredth of the smallest one in a step; "
                       "at most " +
                           real_text(speed / shake),
                       {frequency, amplitude, "step.fraction"}});
    if (std::abs(m.rotation) * scene.container.radius > speed && scene.container.shape == ContainerShape::drum)
      found.push_back({rotation,
                       real_text(m.rotation),
                       "closes on grains: a wall would move by more than a hundredth of the smallest one in a step; "
                       "at most " +
                           real_text(speed / scene.container.radius),
                       {rotation, "container.radius", "step.fraction"}});
  }
  return found;
}

}  // namespace isostat
