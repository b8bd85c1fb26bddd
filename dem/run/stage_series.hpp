// Columns of the time series that every system has: where the run stands, what the stage imposes, how far it has come.
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "dem/run/loading.hpp"
#include "dem/run/series.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// In any stage: the columns of a series are the same from its first line to its last.
template <class System>
bool may_tilt(const State<System>& s) {
  return s.packing.cell->tilt != 0 ||
         std::any_of(s.scene.stages.begin(), s.scene.stages.end(),
                     [](const StageScene& stage) { return stage.stress_12 || stage.shear_driven(); });
}

// `off_diagonal`: with a cell sigma_12(, sigma_13, sigma_23), mean of both halves. Strains are those that
// until = "strain" looks at, 1 - L / L0 of the stage, compression positive; a stress that is not imposed is not a
// number. A cell that has a tilt or may get one has columns more.
template <class System, std::size_t N>
void add_stage_columns(std::vector<SeriesColumn>& columns, const State<System>& s,
                       const std::array<double, N>& off_diagonal) {
  static constexpr std::array<std::string_view, 3> kShear{"sigma12", "sigma13", "sigma23"},
      kStrain{"strain1", "strain2", "strain3"}, kImposed{"imposed11", "imposed22", "imposed33"};
  columns.push_back({"stage", static_cast<double>(s.progress.stage)});
  if (s.packing.cell) {
    for (std::size_t k = 0; k < N; ++k) columns.push_back({kShear[k], off_diagonal[k]});
    for (int a = 0; a < System::dimension; ++a) {
      const double before = s.cell_motion.reference_length[a];
      columns.push_back(
          {kStrain[static_cast<std::size_t>(a)], before > 0 ? 1 - s.packing.cell->length[a] / before : 0});
    }
    for (int a = 0; a < System::dimension; ++a) {
      const auto u = static_cast<std::size_t>(a);
      columns.push_back({kImposed[u], s.imposed_stress[u].value_or(std::numeric_limits<double>::quiet_NaN())});
    }
    if (may_tilt(s)) {
      columns.push_back({"imposed12", s.imposed_stress.shear.value_or(std::numeric_limits<double>::quiet_NaN())});
      columns.push_back({"tilt", s.packing.cell->tilt});
      columns.push_back({"shear_strain", s.cell_motion.shear_strain});
      columns.push_back({"shear_rate", -s.cell_motion.shear_strain_rate * s.cell_motion.reference_length[1] /
                                           s.packing.cell->length[1]});
    }
    columns.push_back({"inertial_number", inertial_number(s)});
    columns.push_back({"stress_error", stress_error(s)});
  }
  columns.push_back({"static_solves", static_cast<double>(s.progress.solves)});
}

}  // namespace isostat
