// Where a container stands: a function of the time since its stage began alone, for every system, so that a restart
// finds it at the same place to the last bit.
#pragma once
#include "dem/scene/surroundings.hpp"
#include "dem/state/state.hpp"
#include "geometry/vec.hpp"

namespace isostat {

// What was built at r0 stands at R(angle) r0 + offset.
struct ContainerPlacement {
  Vec2 offset{};     // of the container's origin against where it was built
  double angle = 0;  // [rad]
  Vec2 velocity{};   // of the container's origin
  double spin = 0;   // [rad per time]
  friend bool operator==(const ContainerPlacement&, const ContainerPlacement&) = default;
};

// Vibration: A (cos(2 pi f t) - 1) along y above where the stage found it, so that it starts at rest at its top;
// rotation about its origin. Neither: where the stage found it, exactly.
ContainerPlacement container_at(const ContainerMotionScene& motion, const Surroundings& from, double time_in_stage);

bool moves(const ContainerMotionScene& motion);

// Place and velocity of a point that was built at r0.
Vec2 point_at(const ContainerPlacement& placement, const Vec2& r0);
Vec2 velocity_at(const ContainerPlacement& placement, const Vec2& r);  // of the point that is now at r

// The point r of a placement, where it was built: the inverse of point_at.
Vec2 built_at(const ContainerPlacement& placement, const Vec2& r);

// What the stage that a state is in does with the container; nothing between stages.
template <class System>
ContainerMotionScene container_motion_of(const State<System>& s) {
  const auto stage = static_cast<std::size_t>(s.progress.stage);
  return s.progress.started && stage < s.scene.stages.size() ? s.scene.stages[stage].container : ContainerMotionScene{};
}

// Where the container of a state stands at its time.
template <class System>
ContainerPlacement container_of(const State<System>& s) {
  return container_at(container_motion_of(s), s.surroundings, s.time - s.progress.start_time);
}

// y of the outlet of a hopper, the container's origin.
template <class System>
double outlet_height(const State<System>& s) {
  return container_of(s).offset[1];
}

// The next stage begins where this one left the container, at rest.
void bring_forward(Surroundings& surroundings, const ContainerMotionScene& motion, double time_in_stage);

}  // namespace isostat
