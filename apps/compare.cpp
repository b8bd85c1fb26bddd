// isostat compare BEFORE AFTER: what changed between two states of the same grains.
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "analysis/compare/comparison.hpp"
#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/packing_picture.hpp"
#include "analysis/load_input.hpp"
#include "analysis/report_text.hpp"
#include "analysis/version.hpp"
#include "apps/analysis_options.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/file_rule.hpp"
#include "apps/json_output.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFarthestDrawn = 2;  // [sum of radii] lost contacts of grains farther apart are not drawn

struct Outputs {
  std::optional<std::string> csv;
  std::optional<FigureFile> picture;
  double tolerance = kRigidTolerance;
};

// The link between the same grains in the packing that is drawn, to the nearest image.
Link<2> transferred(const Link<2>& link, const Packing<2>& after, const Matching& grains) {
  Link<2> drawn = link;
  drawn.i = static_cast<std::int32_t>(grains.after[idx(grains.of_before[idx(link.i)])]);
  drawn.j = static_cast<std::int32_t>(grains.after[idx(grains.of_before[idx(link.j)])]);
  drawn.shift = {};
  if (after.cell)
    drawn.shift = after.cell->nearest_image(after.bodies.position[idx(drawn.j)] - after.bodies.position[idx(drawn.i)]);
  return drawn;
}

void draw(const FigureFile& file, const Packing<2>& before, const Packing<2>& after, const Comparison<2>& found,
          const RichText& length_unit) {
  ChangesOptions options;
  options.length_unit = length_unit;
  options.regions = found.regions.regions.size();
  options.region_of_grain.assign(after.bodies.size(), -1);
  options.displacement.assign(after.bodies.size(), Vec2{});
  for (std::size_t g = 0; g < found.grains.size(); ++g) {
    options.region_of_grain[found.grains.after[g]] = found.regions.of_grain[g];
    options.displacement[found.grains.after[g]] = found.displacement[g];
  }
  for (const std::size_t l : found.contacts.kept_after) options.kept.push_back(after.links[l]);
  for (const std::size_t l : found.contacts.gained) options.gained.push_back(after.links[l]);
  for (const std::size_t l : found.contacts.lost) {
    const Link<2> link = transferred(before.links[l], after, found.grains);
    const LinkEnds<2> e = ends(after, link);
    if (norm(e.branch) < kFarthestDrawn * (e.radius_i + e.radius_j)) options.lost.push_back(link);
  }
  const PackingPicture picture(after, changes_content(std::move(options)), length_unit);
  const auto canvas = file.canvas(picture.size());
  picture.draw(*canvas);
  file.write(*canvas);
}

template <int D>
Json compare_packings(const std::string& path, const Packing<D>& before, const Packing<D>& after,
                      const Outputs& outputs, const RichText& length_unit) {
  if (before.cell.has_value() != after.cell.has_value())
    throw InputError(path, 0, "cell", "", "only one of the two packings has a cell");
  if (D == 3 && outputs.picture)
    throw InputError(path, 0, "-o", "", "is a picture of disks; these packings are in space");
  const Comparison<D> found = compare(before, after, outputs.tolerance);
  if (found.grains.size() == 0) throw InputError(path, 0, "id", "", "no grain has the id of one in the first packing");
  if (outputs.csv) {
    std::error_code error;
    std::filesystem::create_directories(*outputs.csv, error);
    if (error) throw InputError(*outputs.csv, 0, "--csv", "", "cannot be made: " + error.message());
    write_files_atomically({{*outputs.csv + "/displacements.csv", displacements_csv(after, found)},
                            {*outputs.csv + "/links.csv", link_changes_csv(before, after, found)}});
  }
  if constexpr (D == 2)
    if (outputs.picture) draw(*outputs.picture, before, after, found, length_unit);
  return comparison_json(before, after, found, outputs.tolerance);
}

}  // namespace

int compare_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"--json", "FILE", "write the result as JSON; - for stdout (then nothing else is printed)"},
       {"--csv", "DIR", "write displacements.csv (a line a grain) and links.csv (a line a link)"},
       {"-o", "FILE", "picture of the second packing: regions, contacts lost and gained; .svg, .pdf or .png"},
       {"--tolerance", "ANGLE",
        "rad; contacts of a grain that enclose the same angle to it moved rigidly; default .01"},
       {"--gap-tolerance", "LENGTH", "gap up to which grains of lists without contacts touch"}},
      {"BEFORE AFTER", "What changed between two packings of the same grains, matched by their ids."});
  arguments.require_inputs(2, 2, "two packings");
  const std::string first = arguments.inputs()[0], second = arguments.inputs()[1];
  Outputs outputs;
  if (const auto tolerance = arguments.number("--tolerance")) {
    if (!(*tolerance > 0 && *tolerance < 1))
      throw InputError("command line", 0, "--tolerance", *arguments.value("--tolerance"), "must be in (0, 1)");
    outputs.tolerance = *tolerance;
  }
  const AnalysisOptions options = reading_options(arguments);
  outputs.csv = arguments.value("--csv");
  const auto json_path = arguments.value("--json"), picture = arguments.value("-o");
  FileRule rule;
  for (const std::string& path : arguments.inputs()) rule.reads("INPUT", path);
  rule.writes("--json", json_path.value_or(""));
  rule.writes("-o", picture.value_or(""));
  for (const char* name : {"/displacements.csv", "/links.csv"})
    if (outputs.csv) rule.writes("--csv", *outputs.csv + name);
  rule.require();
  if (json_path && *json_path != "-") require_writable(*json_path);
  if (picture) outputs.picture.emplace(*picture);

  const AnalysisInput before = load_input(first, options), after = load_input(second, options);
  if (before.triangles || after.triangles)
    throw InputError(before.triangles ? first : second, 0, "", "", "is of triangles; disks or spheres are compared");
  if (before.packing_3d.has_value() != after.packing_3d.has_value())
    throw InputError(second, 0, "", "", "is in another dimension than " + first);
  const RichText unit = after.has_law() ? rich("`a`") : RichText{};
  Json json{{"isostat", version()}, {"inputs", {first, second}}};
  json.update(before.packing_3d ? compare_packings<3>(second, *before.packing_3d, *after.packing_3d, outputs, unit)
                                : compare_packings<2>(second, before.packing(), after.packing(), outputs, unit));
  if (json_path)
    write_json(arguments, json);
  else
    std::cout << report_as_text(json);
  return exit_done;
}

}  // namespace isostat
