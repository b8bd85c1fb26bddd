#include "dem/systems.hpp"

#include "dem/disks/check.hpp"
#include "dem/disks/keys.hpp"
#include "dem/disks/sample.hpp"
#include "dem/spheres/check.hpp"
#include "dem/spheres/keys.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/state/lengths.hpp"
#include "dem/triangles/check.hpp"
#include "dem/triangles/keys.hpp"
#include "dem/triangles/sample.hpp"

namespace isostat {

namespace {

AnyState made(const Scene& scene, std::uint64_t seed) {
  switch (scene.system) {
    case SceneSystem::disks:
      break;
    case SceneSystem::triangles:
      return initial_triangles(scene, seed);
    case SceneSystem::spheres:
      return initial_spheres(scene, seed);
  }
  return initial_disks(scene, seed);
}

}  // namespace

AnyState initial_state(const Scene& scene, std::uint64_t seed) {
  AnyState any = made(scene, seed);
  std::visit([](const auto& state) { require_lengths(state.packing.cell, state.packing.bodies, "scene"); }, any);
  return any;
}

std::vector<SceneKey> system_keys() {
  std::vector<SceneKey> rows = disk_keys();
  for (SceneKey& row : triangle_keys()) rows.push_back(std::move(row));
  for (SceneKey& row : sphere_keys()) rows.push_back(std::move(row));
  return rows;
}

std::vector<SceneConflict> system_conflicts(const Scene& scene) {
  switch (scene.system) {
    case SceneSystem::triangles:
      return triangle_conflicts(scene);
    case SceneSystem::spheres:
      return sphere_conflicts(scene);
    case SceneSystem::disks:
      break;
  }
  return disk_conflicts(scene);
}

}  // namespace isostat
