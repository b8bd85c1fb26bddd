// What rows of the table of scene keys are written with: where a key lives, its range, its choices. Included by the
// files that hold rows: dem/scene/keys.cpp, and keys.cpp of each system.
#pragma once
#include <array>
#include <type_traits>

#include "dem/scene/keys.hpp"

namespace isostat::key_rows {

template <class>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<std::vector<T>> = true;
template <class>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

// The field Scene::Group.Member; Group may be a struct, the optional [units] (must be there) or the stages.
template <auto Group, auto Member>
SceneField in(Scene& scene, std::size_t stage) {
  auto& group = scene.*Group;
  using Type = std::remove_cvref_t<decltype(group)>;
  if constexpr (is_vector<Type>)
    return &(group[stage].*Member);
  else if constexpr (is_optional<Type>)
    return &((*group).*Member);
  else
    return &(group.*Member);
}

template <std::size_t N>
std::vector<std::string_view> names(const std::array<std::string_view, N>& choices) {
  return {choices.begin(), choices.end()};
}

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr SceneRange positive{0, kInfinity, true, false};
inline constexpr SceneRange not_negative{0, kInfinity, false, false};
inline constexpr double kLeastStepFraction = 1e-6;  // a shorter step only makes a run that never comes anywhere
constexpr SceneRange from(double low, double high) { return {low, high, false, false}; }

inline const std::string& grains_file(const Scene& s) {
  switch (s.system) {
    case SceneSystem::disks:
      break;
    case SceneSystem::triangles:
      return s.triangle_grains.file;
    case SceneSystem::spheres:
      return s.sphere_grains.file;
  }
  return s.grains.file;
}
inline constexpr SceneCondition random_start{[](const Scene& s) { return grains_file(s).empty(); },
                                             "grains.file is empty"};
inline constexpr SceneCondition random_places{[](const Scene& s) { return random_start.holds(s) && !is_collision(s); },
                                              "grains.file is empty and grains.arrangement is \"random\""};
inline constexpr SceneCondition collision{is_collision, "grains.file is empty and grains.arrangement is \"collision\""};

// Rows as the rows of one system.
inline std::vector<SceneKey> of(SceneSystem system, std::vector<SceneKey> rows) {
  for (SceneKey& row : rows) row.systems = SystemSet::only(system);
  return rows;
}

}  // namespace isostat::key_rows
