// isostat plot: from the options to charts of a result.
#include "analysis/figure/plot.hpp"

#include "analysis/figure/chart.hpp"
#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/study_plot.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

// study.csv has no plot of its own choice: the axes are named.
Plot plot_of(const Arguments& arguments, const std::string& path, const std::string& what) {
  const auto x = arguments.value("--x"), y = arguments.value("--y");
  if (what.empty() ? !x && !y : what != "study") {
    if (x || y) throw InputError("command line", 0, x ? "--x" : "--y", "", "only with --what study");
    return read_plot(path, what);
  }
  if (!x || !y) throw InputError("command line", 0, x ? "--y" : "--x", "", "is required with --what study");
  return study_plot(parse_table(read_whole_file(path), path), *x, *y);
}

// Charts against the deformation alone have only positive numbers.
void make_logarithmic(Plot& plot) {
  const RichText title = plot.charts[0].x.title;
  std::erase_if(plot.charts, [&](const Chart& c) { return c.x.title != title; });
  for (Chart& c : plot.charts) c.x.log = c.y.log = true;
  plot.share_x = true;
}

}  // namespace

int plot_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "FILE", "the figure; its extension is the format: .svg, .pdf or .png"},
       {"--what", "PLOT",
        "force-histogram, angle, NT, coordination, scattering, correlation, pores, stressed, loops, two-contacts, "
        "series, law-fit, bench or study; default: the only one that the file has data for"},
       {"--log", "", "law-fit: logarithmic axes, of the forces against the deformation alone"},
       {"--x", "COLUMN", "study.csv: what to plot against; a name's end is enough (friction)"},
       {"--y", "COLUMN", "study.csv: what to plot, with its standard error"}},
      {"RESULT.json|TABLE.csv -o FILE",
       "Plots results of analyze, lab and study, series of pack, and benchmark tables."});
  arguments.require_inputs(1, 1, "one result (.json) or table (.csv)");
  const std::string what =
      arguments
          .choice("--what", {"force-histogram", "angle", "NT", "coordination", "scattering", "correlation", "pores",
                             "stressed", "loops", "two-contacts", "series", "law-fit", "bench", "study"})
          .value_or("");
  const FigureFile file(arguments.required("-o"));
  Plot plot = plot_of(arguments, arguments.inputs()[0], what);
  if (arguments.has("--log")) {
    if (what != "law-fit") throw InputError("command line", 0, "--log", "", "only with --what law-fit");
    make_logarithmic(plot);
  }
  const ChartFigure figure(std::move(plot.charts), plot.share_x);
  const auto canvas = file.canvas(figure.size());
  figure.draw(*canvas);
  file.write(*canvas);
  return exit_done;
}

}  // namespace isostat
