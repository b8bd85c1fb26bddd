#include "dem/state/container_motion.hpp"

#include <cmath>
#include <numbers>

namespace isostat {

bool moves(const ContainerMotionScene& m) {
  return (m.vibration_amplitude != 0 && m.vibration_frequency != 0) || m.rotation != 0;
}

ContainerPlacement container_at(const ContainerMotionScene& m, const Surroundings& from, double t) {
  ContainerPlacement p{from.start_offset, from.start_angle, {}, m.rotation};
  if (m.rotation != 0) p.angle += m.rotation * t;
  if (m.vibration_amplitude != 0 && m.vibration_frequency != 0) {
    const double omega = 2 * std::numbers::pi * m.vibration_frequency, phase = omega * t;
    p.offset[1] += m.vibration_amplitude * (std::cos(phase) - 1);
    p.velocity[1] = -(m.vibration_amplitude * omega) * std::sin(phase);
  }
  return p;
}

Vec2 point_at(const ContainerPlacement& p, const Vec2& r0) {
  const double c = std::cos(p.angle), s = std::sin(p.angle);
  return {{(c * r0[0] - s * r0[1]) + p.offset[0], (s * r0[0] + c * r0[1]) + p.offset[1]}};
}

Vec2 velocity_at(const ContainerPlacement& p, const Vec2& r) {
  const Vec2 arm = r - p.offset;
  return {{p.velocity[0] - p.spin * arm[1], p.velocity[1] + p.spin * arm[0]}};
}

Vec2 built_at(const ContainerPlacement& p, const Vec2& r) {
  const double c = std::cos(p.angle), s = std::sin(p.angle);
  const Vec2 arm = r - p.offset;
  return {{c * arm[0] + s * arm[1], c * arm[1] - s * arm[0]}};
}

void bring_forward(Surroundings& s, const ContainerMotionScene& m, double time_in_stage) {
  const ContainerPlacement now = container_at(m, s, time_in_stage);
  s.start_offset = now.offset, s.start_angle = now.angle;
}

}  // namespace isostat
