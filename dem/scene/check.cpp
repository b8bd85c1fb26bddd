#include "dem/scene/check.hpp"

#include <algorithm>

#include "dem/scene/text.hpp"

namespace isostat {
namespace {

// By a stress or a rate.
bool loads(const StageScene& s) {
  const auto given = [](const auto& list) {
    return std::any_of(list.begin(), list.end(), [](auto x) { return x.has_value(); });
  };
  return s.pressure || !s.pressures.empty() || given(s.stresses()) || given(s.strain_rates()) || s.stress_12 ||
         s.shear_rate;
}

// Each direction has one master, and the end of a stage must be one that its directions can reach.
void check_control(const Scene& scene, std::size_t i, std::vector<SceneConflict>& found) {
  const StageScene& s = scene.stages[i];
  const auto key = [i](const char* name) { return stage_key(i, name); };
  const auto one_master = [&](const std::optional<double>& stress, const std::optional<double>& rate, const char* k,
                              const char* partner) {
    if (stress && rate)
      found.push_back({key(k),
                       real_text(*rate),
                       "a direction has an imposed stress or a strain rate, not both",
                       {key(k), key(partner)}});
  };
  one_master(s.stress_1, s.strain_rate_1, "strain_rate_1", "stress_1");
  one_master(s.stress_2, s.strain_rate_2, "strain_rate_2", "stress_2");
  one_master(s.stress_3, s.strain_rate_3, "strain_rate_3", "stress_3");
  one_master(s.stress_12, s.shear_rate, "shear_rate", "stress_12");
  const bool driven = s.driven();
  const std::vector<std::string> involved{key("until"), key("strain_rate_1"), key("strain_rate_2"), key("shear_rate")};
  if (waits_for_equilibrium(s.until) && driven)
    found.push_back({key("until"), quoted_text(name(s.until)),
                     "a driven cell never comes to rest: \"strain\", \"failure\" or \"time\"", involved});
  if (s.until == Until::strain && !driven)
    found.push_back({key("until"), quoted_text(name(s.until)),
                     "needs a strain rate other than 0 along a direction, or of shear", involved});
  if (s.until == Until::failure && !driven && !(s.ramp_time > 0 && loads(s)))
    found.push_back({key("until"),
                     quoted_text(name(s.until)),
                     "needs a strain rate other than 0 along a direction, or of shear, or a stress that changes over " +
                         key("ramp_time"),
                     {key("until"), key("strain_rate_1"), key("strain_rate_2"), key("shear_rate"), key("ramp_time")}});
  if (s.until == Until::strain && !(s.strain > 0))
    found.push_back({key("strain"),
                     real_text(s.strain),
                     "greater than 0, since " + key("until") + " is \"strain\"",
                     {key("strain"), key("until")}});
  if (!s.pressures.empty() && s.pressure)
    found.push_back({key("pressures"), "", "either pressure or pressures", {key("pressure"), key("pressures")}});
}

// A ramp has something to bring, and comes to its end within the stage.
void check_ramp(const Scene& scene, std::size_t i, std::vector<SceneConflict>& found) {
  const StageScene& s = scene.stages[i];
  if (!(s.ramp_time > 0)) return;
  const auto key = [i](const char* name) { return stage_key(i, name); };
  if (!loads(s))
    found.push_back({key("ramp_time"),
                     real_text(s.ramp_time),
                     "only with a stress or strain rate, which it brings",
                     {key("ramp_time"), key("pressure"), key("stress_1"), key("strain_rate_1")}});
  const bool timed = s.until == Until::time;
  const double length = timed ? s.time : s.max_time;
  const char* const limit = timed ? "time" : "max_time";
  if (s.ramp_time > length)
    found.push_back({key("ramp_time"),
                     real_text(s.ramp_time),
                     "at most " + key(limit) + " = " + real_text(length) + ", else the stage is over before the ramp",
                     {key("ramp_time"), key(limit), key("until")}});
}

void check_stages(const Scene& scene, std::vector<SceneConflict>& found) {
  if (scene.stages.empty()) found.push_back({"stage", "", "at least one [[stage]]", {"stage"}});
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageScene& s = scene.stages[i];
    const std::string until = stage_key(i, "until"), time = stage_key(i, "time");
    if (s.until == Until::time && !(s.time > 0))
      found.push_back({time, real_text(s.time), "greater than 0, since " + until + " is \"time\"", {time, until}});
    if (s.until != Until::time && s.time > 0)
      found.push_back({time, real_text(s.time), "only with " + until + " = \"time\"", {time, until}});
    check_control(scene, i, found);
    check_ramp(scene, i, found);
  }
}

}  // namespace

std::string stage_key(std::size_t stage, const char* key) { return "stage." + std::to_string(stage) + "." + key; }

std::vector<SceneConflict> conflicts(const Scene& scene) {
  std::vector<SceneConflict> found = system_conflicts(scene);
  check_stages(scene, found);
  for (SceneConflict& conflict : surroundings_conflicts(scene)) found.push_back(std::move(conflict));
  return found;
}

}  // namespace isostat
