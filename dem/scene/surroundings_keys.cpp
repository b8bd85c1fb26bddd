// Rows of what stands around the grains, in every system. At their defaults there is nothing there, and the echo does
// not speak of them.
#include "dem/scene/key_rows.hpp"

namespace isostat {
namespace {

SceneField gravity_field(Scene& scene, std::size_t) { return &scene.gravity; }

template <auto Member>
SceneField motion(Scene& scene, std::size_t stage) {
  return &(scene.stages[stage].container.*Member);
}

bool is(const Scene& s, ContainerShape shape) { return s.container.shape == shape; }

constexpr SceneCondition has_container{[](const Scene& s) { return !is(s, ContainerShape::none); },
                                       "container.shape is not \"none\""};
constexpr SceneCondition has_upright_walls{
    [](const Scene& s) { return is(s, ContainerShape::box) || is(s, ContainerShape::hopper); },
    "container.shape is \"box\" or \"hopper\""};
constexpr SceneCondition has_outlet{[](const Scene& s) { return is(s, ContainerShape::hopper); },
                                    "container.shape is \"hopper\""};
constexpr SceneCondition is_drum{[](const Scene& s) { return is(s, ContainerShape::drum); },
                                 "container.shape is \"drum\""};
constexpr SceneCondition has_wall_grains{
    [](const Scene& s) { return has_container.holds(s) && s.container.walls == ContainerWalls::grains; },
    "container.walls is \"grains\" and container.shape is not \"none\""};

}  // namespace

std::vector<SceneKey> surroundings_keys() {
  using S = Scene;
  using C = ContainerScene;
  using M = ContainerMotionScene;
  using namespace key_rows;
  return {
      {.name = "gravity",
       .field = gravity_field,
       .unit = "a/T0^2",
       .range = not_negative,
       .hidden_at_default = true,
       .meaning = "Weight per mass, downwards (along -y)."},

      {.name = "container.shape",
       .field = in<&S::container, &C::shape>,
       .choices = names(kContainerShapeNames),
       .hidden_at_default = true,
       .meaning = "What holds the grains in place of a periodic cell: a box open at the top; a hopper, that is two "
                  "slopes down to an outlet and upright walls above them; a drum, closed all around. The origin is the "
                  "middle of the floor, of the outlet, of the drum."},
      {.name = "container.walls",
       .field = in<&S::container, &C::walls>,
       .choices = names(kContainerWallsNames),
       .condition = has_container,
       .meaning =
           "smooth: flat walls (a drum: round for disks, with facets for triangles), with the friction of the law; "
           "grains: rows of grains with teeth, which move with the container."},
      {.name = "container.width",
       .field = in<&S::container, &C::width>,
       .unit = "a",
       .range = positive,
       .condition = has_upright_walls,
       .meaning = "Inner width of a box, and of a hopper above its slopes."},
      {.name = "container.height",
       .field = in<&S::container, &C::height>,
       .unit = "a",
       .range = positive,
       .condition = has_upright_walls,
       .meaning = "Height of the upright walls."},
      {.name = "container.opening",
       .field = in<&S::container, &C::opening>,
       .unit = "a",
       .range = positive,
       .condition = has_outlet,
       .meaning = "Width of the outlet."},
      {.name = "container.angle",
       .field = in<&S::container, &C::angle>,
       .unit = "degrees",
       .range = {0, 90, true, true},
       .condition = has_outlet,
       .meaning = "Of the slopes against the horizontal."},
      {.name = "container.drop",
       .field = in<&S::container, &C::drop>,
       .unit = "a",
       .range = positive,
       .condition = has_outlet,
       .meaning = "A grain so far below the outlet is taken away."},
      {.name = "container.radius",
       .field = in<&S::container, &C::radius>,
       .unit = "a",
       .range = positive,
       .condition = is_drum,
       .meaning = "Inner radius of a drum."},
      {.name = "container.wall_size",
       .field = in<&S::container, &C::wall_size>,
       .unit = "a",
       .range = positive,
       .condition = has_wall_grains,
       .meaning = "Size of the grains that walls are made of: side of a square, diameter of a disk."},

      {.name = "stage.open",
       .field = motion<&M::open>,
       .hidden_at_default = true,
       .meaning = "Opens the outlet of a hopper at the start of the stage; it stays open."},
      {.name = "stage.vibration_amplitude",
       .field = motion<&M::vibration_amplitude>,
       .unit = "a",
       .range = not_negative,
       .hidden_at_default = true,
       .meaning = "A: t after the start of the stage the container stands at A (cos(2 pi f t) - 1) above where the "
                  "stage found it."},
      {.name = "stage.vibration_frequency",
       .field = motion<&M::vibration_frequency>,
       .unit = "1/T0",
       .range = not_negative,
       .hidden_at_default = true,
       .meaning = "f."},
      {.name = "stage.rotation",
       .field = motion<&M::rotation>,
       .unit = "1/T0",
       .hidden_at_default = true,
       .meaning = "Angular velocity of a drum, anticlockwise, in radians per time."},
      {.name = "stage.clog_time",
       .field = motion<&M::clog_time>,
       .unit = "T0",
       .range = positive,
       .hidden_at_default = true,
       .meaning = "An open outlet that no grain has left for so long is clogged."},
  };
}

}  // namespace isostat
