#include "dem/scene/scene.hpp"

namespace isostat {

ImposedStress imposed_stress(const StageScene& stage) {
  ImposedStress stress = isotropic(stage.pressure);
  if (stage.stress_1 || stage.strain_rate_1) stress[0] = stage.stress_1;
  if (stage.stress_2 || stage.strain_rate_2) stress[1] = stage.stress_2;
  return stress;
}

}  // namespace isostat
