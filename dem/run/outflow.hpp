// A hopper's outlet in the run of a stage: it is opened when the stage begins, what has fallen through it is taken away
// at the looks, and empty and clogged are ends of the stage.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "dem/state/state.hpp"

namespace isostat {

// Of the system it wants open_outlet, take_away and grains_above_outlet (dem/disks/outflow.hpp).
template <class System>
class Outflow {
 public:
  Outflow(State<System>& state, const StageScene& stage) : s_(state), stage_(stage) {}

  static void open(State<System>& s) {
    open_outlet(s);
    s.surroundings.last_left = s.time;
  }

  bool flows() const { return s_.surroundings.open && s_.scene.container.shape == ContainerShape::hopper; }
  bool empties() { return flows() && take_away(s_); }

  bool empty() const { return grains_above_outlet(s_) == 0; }
  bool clogged() const {
    const double since = std::max(s_.surroundings.last_left, s_.progress.start_time);
    return !empty() && s_.time - since >= stage_.container.clog_time;
  }

  // The other end than the one that the stage waits for.
  std::optional<std::string> spoilt() const {
    if (stage_.until == Until::empty && clogged())
      return "clogged: " + std::to_string(grains_above_outlet(s_)) + " grains left";
    if (stage_.until == Until::clogged && empty()) return "empty: no grain is left to clog the outlet";
    return std::nullopt;
  }
  std::string missing() const {
    return std::to_string(grains_above_outlet(s_)) + " grains are still above the outlet, " +
           std::to_string(s_.surroundings.grains_left) + " have left";
  }

 private:
  State<System>& s_;
  const StageScene& stage_;
};

}  // namespace isostat
