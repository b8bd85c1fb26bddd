#include "dem/disks/wall_contacts.hpp"

#include <algorithm>
#include <tuple>

namespace isostat {

using kernel::Slot;

namespace {

auto key(const WallContacts::Spring& s) { return std::tie(s.disk, s.wall); }

}  // namespace

WallContacts::WallContacts(std::vector<SmoothWall> built, bool open, const DiskLaw& law)
    : built_(std::move(built)), open_(open), columns_(law) {}

void WallContacts::list(BodiesStore& bodies, const ContainerStep& container, double reach,
                        std::vector<Spring> springs) {
  i_.clear(), wall_.clear(), disk_.clear();
  std::vector<SmoothWall> walls;
  for (const SmoothWall& w : built_) walls.push_back(wall_at(container.now, w));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (bodies.constants[k].inverse_mass == 0) continue;
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (!stands(w)) continue;
      const Vec2 r = bodies.position(k);
      if (norm(foot_point(walls[w], r).place - r) > bodies.radius(k) + reach) continue;
      i_.push_back(static_cast<std::uint32_t>(k) * DiskPairs::kStride);
      wall_.push_back(static_cast<std::int32_t>(w));
      disk_.push_back(bodies.id[k]);
    }
  }
  bodies.set_feet(size());
  turning_.resize(size()), j_.resize(size());
  columns_.resize(size());
  std::sort(springs.begin(), springs.end(), [](const Spring& a, const Spring& b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < size(); ++k) {
    const std::size_t foot = bodies.foot(k);
    j_[k] = static_cast<std::uint32_t>(foot) * DiskPairs::kStride;
    columns_.fill(k, bodies, i_[k] / DiskPairs::kStride, foot);
    const Spring wanted{disk_[k], wall_[k], {}};
    const auto known = std::lower_bound(springs.begin(), springs.end(), wanted,
                                        [](const Spring& a, const Spring& b) { return key(a) < key(b); });
    if (known != springs.end() && key(*known) == key(wanted)) columns_.remember(k, known->history);
  }
  place(bodies, container);
}

auto WallContacts::springs() const -> std::vector<Spring> {
  std::vector<Spring> springs;
  for (std::size_t k = 0; k < size(); ++k)
    if (const DiskHistory h = columns_.history(k); h != DiskHistory{}) springs.push_back({disk_[k], wall_[k], h});
  return springs;
}

void WallContacts::place(BodiesStore& bodies, const ContainerStep& container) {
  std::vector<SmoothWall> walls;
  for (const SmoothWall& w : built_) walls.push_back(wall_at(container.now, w));
  for (std::size_t k = 0; k < size(); ++k) {
    const FootPoint foot =
        foot_point(walls[static_cast<std::size_t>(wall_[k])], bodies.position(i_[k] / DiskPairs::kStride));
    // The point of the wall that is there now, half a step ago.
    const Vec2 u = velocity_at(container.half, point_at(container.half, built_at(container.now, foot.place)));
    const Vec2 v = velocity_at(container.now, foot.place);
    double *row = bodies.row(bodies.foot(k)), *load = bodies.load(bodies.foot(k));
    row[Slot::x] = foot.place[0], row[Slot::y] = foot.place[1];
    row[Slot::half_vx] = u[0], row[Slot::half_vy] = u[1];
    row[Slot::surface_speed] = 0, row[Slot::half_spin] = container.half.spin;
    row[Slot::vx] = v[0], row[Slot::vy] = v[1];
    std::fill_n(load, kernel::kLoadWidth, 0.0);
    turning_[k] = foot.turning;
  }
}

double WallContacts::largest_speed(const ContainerStep& container) const {
  double fastest = 0;
  for (const SmoothWall& w : built_)
    for (const Vec2& end : {w.a, w.b})
      fastest = std::max(fastest, norm(velocity_at(container.half, point_at(container.half, end))));
  return fastest;
}

PairArrays WallContacts::arrays() {
  return {i_.data(),        j_.data(), nullptr, columns_.damping(), columns_.radius_sum(), columns_.tangential(),
          columns_.moment()};
}

}  // namespace isostat
