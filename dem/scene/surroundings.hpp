// What stands around the grains, for every system: weight, a container of smooth walls or of grains, and what a stage
// does with it. Lengths and times in the units of the system (disks: a, T0; triangles: cm, s).
#pragma once
#include <array>
#include <optional>
#include <string_view>

namespace isostat {

enum class ContainerShape { none, box, hopper, drum };
inline constexpr std::array<std::string_view, 4> kContainerShapeNames{"none", "box", "hopper", "drum"};

// A smooth wall is a line without friction of its own; a wall of grains is a row of grains that move with the
// container.
enum class ContainerWalls { smooth, grains };
inline constexpr std::array<std::string_view, 2> kContainerWallsNames{"smooth", "grains"};

// [container]. The origin is the middle of the floor of a box, of the outlet of a hopper, of a drum; y points up.
struct ContainerScene {
  ContainerShape shape = ContainerShape::none;
  ContainerWalls walls = ContainerWalls::grains;
  double width = 4;        // inner width of a box, and of a hopper above its slopes
  double height = 8;       // of the upright walls of a box or hopper (a hopper: above the slopes)
  double opening = 0.9;    // width of the outlet of a hopper
  double angle = 45;       // [degrees] of a hopper's slopes against the horizontal
  double radius = 2;       // inner radius of a drum
  double wall_size = 0.1;  // size of the grains that walls are made of
  double drop = 2;         // a grain this far below the outlet of a hopper is taken away
  friend bool operator==(const ContainerScene&, const ContainerScene&) = default;
};

// What a stage does with the container: functions of the time since the stage began.
struct ContainerMotionScene {
  bool open = false;               // the outlet of a hopper
  double vibration_amplitude = 0;  // A: the container stands at A (cos(2 pi f t) - 1) above where the stage found it
  double vibration_frequency = 0;  // f
  double rotation = 0;             // [rad per time] of a drum, anticlockwise
  double clog_time = 1;            // without a grain leaving for so long the outlet is clogged
  friend bool operator==(const ContainerMotionScene&, const ContainerMotionScene&) = default;
};

}  // namespace isostat
