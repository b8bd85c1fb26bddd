#include "dem/scene/scene.hpp"

namespace isostat {

Scene default_scene(SceneSystem system, std::size_t stages) {
  Scene scene;
  scene.system = system;
  StageScene stage;
  if (system == SceneSystem::triangles) {
    scene.finish.drag = 50;
    scene.finish.quiet_time = 0.02;
    scene.finish.unchanged_time = 0.1;
    scene.output.series_interval = 0.01;
    stage.max_strain_rate = 1;
    stage.max_time = 60;
  }
  scene.stages.assign(stages, stage);
  return scene;
}

}  // namespace isostat
