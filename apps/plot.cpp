// isostat plot: from the options to charts of a result.
#include "analysis/figure/plot.hpp"

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "analysis/figure/chart.hpp"
#include "analysis/figure/column_plot.hpp"
#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/study_plot.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/file_rule.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

DataTable table_of(const std::string& path) {
  if (path.ends_with(".json"))
    throw InputError(path, 0, "--x", "", "columns are of tables (.csv); a result (.json) is plotted by --what");
  return parse_table(read_whole_file(path), path);
}

// Named columns; else what the file has a plot of its own for. study.csv: one curve for each choice of its parameters.
Plot plot_of(const Arguments& arguments, const std::string& what) {
  const auto x = arguments.value("--x"), y = arguments.value("--y");
  const std::vector<std::string>& paths = arguments.inputs();
  if (!x && !y && what != "study") {
    if (paths.size() > 1)
      throw InputError(paths[1], 0, "--x", "", "several tables are compared by columns: name them in --x and --y");
    return read_plot(paths[0], what);
  }
  if (!what.empty() && what != "study")
    throw InputError("command line", 0, x ? "--x" : "--y", "", "names columns, and --what " + what + " has its own");
  if (!x || !y) throw InputError("command line", 0, x ? "--y" : "--x", "", "is required: --x and --y name columns");
  const std::vector<std::string> names = list_of(*y);
  if (names.empty()) throw InputError("command line", 0, "--y", *y, "names columns, as in Phi or sigma11,sigma22");
  std::vector<DataTable> tables;
  for (const std::string& path : paths) tables.push_back(table_of(path));
  const bool study = tables[0].columns[0].name == "row" && tables[0].find("runs");
  if (what == "study" || (study && names.size() == 1)) {
    Plot all;
    std::size_t color = 0;
    for (const DataTable& table : tables) {
      Plot one = study_plot(table, *x, names[0], color);
      const RichText file = plain(std::filesystem::path(table.path).parent_path().filename().string() + " ");
      for (Curve& c : one.charts[0].curves)
        if (tables.size() > 1 && c.style == CurveStyle::points) c.label = file + c.label;
      if (all.charts.empty())
        all = std::move(one);
      else
        for (Curve& c : one.charts[0].curves) all.charts[0].curves.push_back(std::move(c));
    }
    return all;
  }
  return column_plot(tables, *x, names);
}

// What the options say of axes and page.
void apply(const Arguments& arguments, Plot& plot) {
  const char* const kRange = "must be LOW,HIGH with LOW below HIGH (logarithmic: above 0)";
  const auto x = arguments.two_numbers("--x-range", kRange), y = arguments.two_numbers("--y-range", kRange);
  for (Chart& c : plot.charts) {
    c.x.log = c.x.log || arguments.has("--log-x"), c.y.log = c.y.log || arguments.has("--log-y");
    if (x) c.x.low = x->first, c.x.high = x->second;
    if (y) c.y.low = y->first, c.y.high = y->second;
    for (const auto& [range, axis, option] : {std::tuple(x, c.x, "--x-range"), std::tuple(y, c.y, "--y-range")})
      if (range && (!(range->first < range->second) || (axis.log && !(range->first > 0))))
        throw InputError("command line", 0, option, *arguments.value(option), kRange);
  }
}

ChartStyle style_of(const Arguments& arguments) {
  ChartStyle style;
  const char* const kSize = "must be WIDTH,HEIGHT of a frame in points, from 60 to 4000";
  const auto sound = [](double v) { return v >= 60 && v <= 4000; };
  if (const auto size = arguments.two_numbers("--size", kSize)) {
    if (!sound(size->first) || !sound(size->second))
      throw InputError("command line", 0, "--size", *arguments.value("--size"), kSize);
    style.width = size->first, style.height = size->second;
  }
  if (const auto font = arguments.number("--font")) {
    if (!(*font >= 4 && *font <= 48))
      throw InputError("command line", 0, "--font", *arguments.value("--font"), "in points, from 4 to 48");
    style.text = *font;
  }
  return style;
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
        "density-of-states, "
        "series, law-fit, bench or study; default: the only one that the file has data for"},
       {"--log", "", "law-fit: logarithmic axes, of the forces against the deformation alone"},
       {"--x", "COLUMN", "of any table: what to plot against; a name's end is enough (friction)"},
       {"--y", "COLUMN[,...]", "of any table: what to plot, with its standard error (COLUMN_se); several tables: each"},
       {"--log-x", "", "logarithmic axis; --log-y likewise"},
       {"--log-y", "", ""},
       {"--x-range", "LOW,HIGH", "what the axis shows; --y-range likewise"},
       {"--y-range", "LOW,HIGH", ""},
       {"--size", "WIDTH,HEIGHT", "of each frame, in points; default 380 wide"},
       {"--font", "POINTS", "size of the numbers; default 9.5"}},
      {"RESULT.json|TABLE.csv... -o FILE",
       "Plots results of analyze, lab and study, series of pack, benchmark tables, and columns of any CSV."});
  arguments.require_inputs(1, 1000, "results (.json) or tables (.csv)");
  const std::string what = arguments
                               .choice("--what", {"force-histogram", "angle", "NT", "coordination", "scattering",
                                                  "correlation", "pores", "stressed", "loops", "two-contacts",
                                                  "density-of-states", "series", "law-fit", "bench", "study"})
                               .value_or("");
  FileRule rule;
  for (const std::string& input : arguments.inputs()) rule.reads("the input", input);
  rule.writes("-o", arguments.required("-o"));
  rule.require();
  const ChartStyle style = style_of(arguments);
  const FigureFile file(arguments.required("-o"));
  Plot plot = plot_of(arguments, what);
  if (arguments.has("--log")) {
    if (what != "law-fit") throw InputError("command line", 0, "--log", "", "only with --what law-fit");
    make_logarithmic(plot);
  }
  apply(arguments, plot);
  try {
    const ChartFigure figure(std::move(plot.charts), plot.share_x, style);
    const auto canvas = file.canvas(figure.size());
    figure.draw(*canvas);
    file.write(*canvas);
  } catch (const std::invalid_argument& error) {
    throw InputError(arguments.inputs()[0], 0, "", "", std::string(error.what()) + " on these axes");
  }
  return exit_done;
}

}  // namespace isostat
