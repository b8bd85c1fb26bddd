// isostat draw: from the options to a picture of a packing, or pictures of several.
#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>

#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/film_file.hpp"
#include "analysis/load_input.hpp"
#include "apps/analysis_options.hpp"
#include "apps/commands.hpp"
#include "apps/draw/subjects.hpp"
#include "apps/file_rule.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

constexpr double kFrameRate = 10, kMostFrameRate = 100;  // [1/s]

// Whether -o is a film (or a folder of frames); a single picture otherwise.
bool is_film(const Arguments& arguments, const std::string& path) {
  const auto refuse = [](const char* key, const std::string& value, std::string why) {
    throw InputError("command line", 0, key, value, std::move(why));
  };
  const bool folder = FilmFile::names_folder(path), page = FilmFile::names_page(path);
  if (const auto rate = arguments.number("--fps")) {
    const bool plays = page || (!folder && std::filesystem::path(path).extension() == ".svg");
    if (!plays) refuse("--fps", *arguments.value("--fps"), "is about films that play: -o FILM.html or FILM.svg");
    if (!(*rate > 0 && *rate <= kMostFrameRate))
      refuse("--fps", *arguments.value("--fps"), "must be positive, at most 100");
  }
  const bool film = folder || page || arguments.has("--fps");
  if (arguments.has("--stroboscopic")) {
    if (film) refuse("--stroboscopic", path, "makes one picture: .svg, .pdf or .png without --fps");
    return false;
  }
  const std::size_t count = arguments.inputs().size();
  if (count > 1 && !film)
    refuse(
        "-o", path,
        "is one picture, and these are " + std::to_string(count) +
            " packings: name a folder DIR/ for frames, FILM.html, or FILM.svg with --fps; or ask for --stroboscopic");
  if (count > 1 && arguments.value("--what") == "modes")
    refuse("--what", "modes", "of one packing at a time: their sizes are arbitrary");
  return film;
}

enum class Drawn { disks, spheres, triangles };
constexpr std::array<std::string_view, 3> kDrawnNames{"disks", "spheres", "triangles"};

Drawn system_of(const AnalysisInput& input) {
  return input.packing_3d ? Drawn::spheres : input.triangles ? Drawn::triangles : Drawn::disks;
}

// Of one system.
std::vector<AnalysisInput> load_all(const std::vector<std::string>& paths, const AnalysisOptions& options) {
  std::vector<AnalysisInput> inputs;
  const auto name = [](const AnalysisInput& of) {
    return std::string(kDrawnNames[static_cast<std::size_t>(system_of(of))]);
  };
  for (const std::string& path : paths) {
    inputs.push_back(load_input(path, options));
    AnalysisInput& input = inputs.back();
    if (system_of(input) != system_of(inputs[0]))
      throw InputError(
          path, 0, "", "",
          "is of " + name(input) + ", " + paths[0] + " of " + name(inputs[0]) + ": one picture shows one system");
    input.state.memory = {};  // of no use here, and a series may be long
    if (input.triangles) input.triangles->memory = {};
  }
  return inputs;
}

Drawing drawing_of(const Arguments& arguments, const std::vector<AnalysisInput>& inputs) {
  const Drawn system = system_of(inputs[0]);
  if (system == Drawn::spheres) return drawing_of_spheres(arguments, inputs);
  for (const char* option : {"--view", "--slice"})
    if (const auto value = arguments.value(option))
      throw InputError(inputs[0].path, 0, option, *value, "is about packings in space; this one is in the plane");
  return system == Drawn::triangles ? drawing_of_triangles(arguments, inputs) : drawing_of_disks(arguments, inputs);
}

std::optional<Vec2> page_of(const Arguments& arguments) {
  const auto size = arguments.two_numbers("--size", "must be WIDTH,HEIGHT in points, each from 100 to 8000");
  if (!size) return std::nullopt;
  for (const double edge : {size->first, size->second})
    if (!(edge >= 100 && edge <= 8000))
      throw InputError("command line", 0, "--size", *arguments.value("--size"),
                       "must be WIDTH,HEIGHT in points, each from 100 to 8000");
  return Vec2{{size->first, size->second}};
}

}  // namespace

ForceConvention convention_of(const Arguments& arguments) {
  ForceConvention convention;
  convention.threshold = arguments.number("--threshold");
  const auto width = arguments.value("--width").value_or(convention.threshold ? "total" : "normal");
  convention.width = width == "total" ? ForceMeasure::total : ForceMeasure::normal;
  return convention;
}

std::string what_to_draw(const Arguments& arguments, bool forces_known) {
  const bool asks_forces = arguments.has("--threshold") || arguments.has("--width") || arguments.has("--scale");
  const std::string what = arguments.value("--what").value_or(asks_forces || forces_known ? "forces" : "grains");
  if (asks_forces && what != "forces" && what != "stressed")
    throw InputError("command line", 0, "--what", what, "--threshold, --width and --scale are about forces");
  if (arguments.has("--mode") && what != "modes")
    throw InputError("command line", 0, "--what", what, "--mode is about modes");
  if (arguments.has("--stiffness") && what != "modes")
    throw InputError("command line", 0, "--what", what, "--stiffness is about modes");
  return what;
}

int draw_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "FILE", "the picture: .svg, .pdf or .png; of several inputs FILM.html, FILM.svg or a folder DIR/"},
       {"--what", "KIND",
        "grains, forces, stressed, loops, pores, clusters, modes or velocity; default: forces, or grains if the file "
        "gives no forces"},
       {"--threshold", "F", "links whose total force is below F are blue, disks touched only by such light grey"},
       {"--width", "MEASURE", "line width by normal or total force; default: normal, with --threshold total"},
       {"--scale", "F", "forces: the one whose line is as wide as the legend says of F0 or aP; default by the file"},
       {"--box", "L1,L2[,L3]", "edges of the periodic cell of a file that has none"},
       {"--gap-tolerance", "LENGTH", "gap up to which grains of a list without contacts touch"},
       {"--stiffness", "K_N[,K_T[,K_R]]", "modes: of contacts, of a packing without a law"},
       {"--mode", "N", "which vibration mode, from the lowest above the zero modes; default 1"},
       {"--view", "DIRECTION",
        "spheres: from where, x, y, z or AZIMUTH,ELEVATION in degrees, 0,0 from x, 0,90 from above; default -60,20"},
       {"--slice", "AXIS=POSITION", "spheres: a plane section, as in z=0.5, drawn as disks"},
       {"--fps", "N", "the inputs one after the other as a film that plays, N frames a second; default 10"},
       {"--size", "WIDTH,HEIGHT", "of the page in points (PNG: 2 pixels each): frames drawn one by one fit together"},
       {"--stroboscopic", "", "all inputs in one picture, the earlier the paler"}},
      {"INPUT... -o FILE",
       "Draws a packing: its grains, the forces between them, pores, rigid clusters, motion; several as a film."});
  arguments.require_inputs(1, std::numeric_limits<std::size_t>::max(), "packings");
  (void)arguments.choice("--what", {"grains", "forces", "stressed", "loops", "pores", "clusters", "modes", "velocity"});
  (void)arguments.choice("--width", {"normal", "total"});
  if (const auto threshold = arguments.number("--threshold"); threshold && !(*threshold > 0))
    throw InputError("command line", 0, "--threshold", *arguments.value("--threshold"), "must be positive");
  if (const auto scale = arguments.number("--scale"); scale && !(*scale > 0))
    throw InputError("command line", 0, "--scale", *arguments.value("--scale"), "must be positive");
  const std::string path = arguments.required("-o");
  FileRule rule;
  for (const std::string& input : arguments.inputs()) rule.reads("INPUT", input);
  rule.writes("-o", path);
  rule.require();
  const bool film = is_film(arguments, path);
  std::optional<FilmFile> film_file;
  std::optional<FigureFile> picture_file;
  if (film)
    film_file.emplace(path, arguments.number("--fps").value_or(kFrameRate));
  else
    picture_file.emplace(path);

  const std::vector<AnalysisInput> inputs = load_all(arguments.inputs(), reading_options(arguments));
  Drawing drawing = drawing_of(arguments, inputs);
  if (!film) drawing.captions.clear();
  const PictureSeries series = [&] {
    try {
      return PictureSeries(std::move(drawing.subjects), drawing.length_unit, std::move(drawing.captions),
                           page_of(arguments));
    } catch (const std::invalid_argument& error) {
      throw InputError("command line", 0, "--size", arguments.value("--size").value_or(""), error.what());
    }
  }();
  if (film) {
    film_file->write(series);
    return exit_done;
  }
  const auto canvas = picture_file->canvas(series.page());
  if (arguments.has("--stroboscopic")) {
    series.draw_stroboscopic(*canvas);
  } else {
    series.draw_packing(*canvas, 0);
    series.draw_legend(*canvas);
  }
  picture_file->write(*canvas);
  return exit_done;
}

}  // namespace isostat
