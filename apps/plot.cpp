// isostat plot: from the options to charts of a result.
#include "analysis/figure/plot.hpp"
#include "analysis/figure/chart.hpp"
#include "analysis/figure/figure_file.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"

namespace isostat {

int plot_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "FILE", "the figure; its extension is the format: .svg, .pdf or .png"},
       {"--what", "PLOT",
        "force-histogram, angle, NT, coordination, scattering, pores, series, law-fit or bench; default: the only one "
        "that the file has data for"}},
      {"RESULT.json|TABLE.csv -o FILE", "Plots results of analyze and lab, series of pack, and benchmark tables."});
  arguments.require_inputs(1, 1, "one result (.json) or table (.csv)");
  const std::string what = arguments
                               .choice("--what", {"force-histogram", "angle", "NT", "coordination", "scattering",
                                                  "pores", "series", "law-fit", "bench"})
                               .value_or("");
  const FigureFile file(arguments.required("-o"));
  Plot plot = read_plot(arguments.inputs()[0], what);
  const ChartFigure figure(std::move(plot.charts), plot.share_x);
  const auto canvas = file.canvas(figure.size());
  figure.draw(*canvas);
  file.write(*canvas);
  return exit_done;
}

}  // namespace isostat
