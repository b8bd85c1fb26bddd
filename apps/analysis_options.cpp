#include "apps/analysis_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

constexpr long long kMostModes = 1000;  // that Lanczos is asked for

// Numbers separated by commas; empty where something else stands between them.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> all;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    std::size_t used = 0;
    double value = 0;
    try {
      value = std::stod(part, &used);
    } catch (const std::exception&) {
      return {};
    }
    if (used != part.size() || !std::isfinite(value)) return {};
    all.push_back(value);
  }
  return text.empty() || text.back() == ',' ? std::vector<double>{} : all;
}

bool all_positive(const std::vector<double>& all) {
  return std::all_of(all.begin(), all.end(), [](double v) { return v > 0; });
}

// K_N[,K_T[,K_R]], each positive.
std::vector<double> stiffness_of(const std::string& text) {
  const std::vector<double> all = numbers_in(text);
  if (all.empty() || all.size() > 3 || !all_positive(all))
    throw InputError("command line", 0, "--stiffness", text, "is K_N or K_N,K_T or K_N,K_T,K_R, positive numbers");
  return all;
}

// L1,L2[,L3].
std::vector<double> box_of(const std::string& text) {
  std::vector<double> edges = numbers_in(text);
  if ((edges.size() != 2 && edges.size() != 3) || !all_positive(edges))
    throw InputError("command line", 0, "--box", text, "must be two (3D: three) positive edges, as in 10,20");
  return edges;
}

// LOW,HIGH with 0 <= LOW < HIGH.
AnalysisOptions::Window window(const Arguments& arguments, const char* name) {
  const auto text = arguments.value(name);
  if (!text) return std::nullopt;
  const std::vector<double> ends = numbers_in(*text);
  if (ends.size() != 2 || !(ends[0] >= 0) || !(ends[0] < ends[1]))
    throw InputError("command line", 0, name, *text, "is two numbers LOW,HIGH with 0 <= LOW < HIGH");
  return std::array{ends[0], ends[1]};
}

int modes_of(const Arguments& arguments) {
  try {
    return static_cast<int>(*arguments.integer("--modes", 1, kMostModes));
  } catch (const InputError&) {
    throw InputError("command line", 0, "--modes", *arguments.value("--modes"),
                     "must be a number from 1 to " + std::to_string(kMostModes) + ", or all");
  }
}

std::optional<DensityOptions> density_of(const Arguments& arguments) {
  const auto bins = arguments.integer("--density-of-states", 1, 10000);
  const auto moments = arguments.integer("--moments", 16, 1000000),
             vectors = arguments.integer("--random-vectors", 1, 10000);
  for (const char* option : {"--moments", "--random-vectors"})
    if (arguments.has(option) && !bins)
      throw InputError("command line", 0, option, *arguments.value(option), "belongs to --density-of-states");
  if (!bins) return std::nullopt;
  DensityOptions density;
  density.bins = static_cast<int>(*bins);
  density.moments = static_cast<int>(moments.value_or(density.moments));
  density.vectors = static_cast<int>(vectors.value_or(density.vectors));
  return density;
}

std::optional<double> positive(const Arguments& arguments, const char* name) {
  const auto number = arguments.number(name);
  if (number && !(*number > 0)) throw InputError("command line", 0, name, *arguments.value(name), "must be positive");
  return number;
}

}  // namespace

AnalysisOptions reading_options(const Arguments& arguments) {
  AnalysisOptions options;
  options.gap_tolerance = arguments.number("--gap-tolerance");
  if (options.gap_tolerance && *options.gap_tolerance < 0)
    throw InputError("command line", 0, "--gap-tolerance", *arguments.value("--gap-tolerance"), "must not be negative");
  if (const auto text = arguments.value("--box")) options.box = box_of(*text);
  if (const auto text = arguments.value("--stiffness")) options.stiffness = stiffness_of(*text);
  return options;
}

AnalysisOptions analysis_options(const Arguments& arguments) {
  AnalysisOptions options = reading_options(arguments);
  if (const auto law = arguments.choice("--law", kNetworkLawNames)) options.law = network_law_named(*law);
  options.cell_free = arguments.choice("--cell", {"fixed", "free"}).value_or("fixed") == "free";
  options.prestress = arguments.has("--prestress");
  options.near_null = arguments.has("--near-null");
  options.most_vectors = static_cast<int>(arguments.integer("--vectors", 1, 1000000).value_or(options.most_vectors));
  if (const auto text = arguments.value("--modes"))
    options.modes = *text == "all" ? std::nullopt : std::optional<int>(modes_of(arguments));
  if (!options.modes && options.prestress)
    throw InputError("command line", 0, "--modes", "all", "is of the symmetric modes; --prestress takes a number");
  options.density = density_of(arguments);
  if (options.density && options.prestress)
    throw InputError("command line", 0, "--density-of-states", "", "is of the symmetric modes: leave out --prestress");
  if (options.density && !arguments.has("--modes")) options.modes = 0;
  options.bin_width = positive(arguments, "--bins");
  options.k_max = positive(arguments, "--k-max").value_or(0);
  options.k_window = window(arguments, "--k-window");
  options.r_window = window(arguments, "--r-window");
  options.pore_window = window(arguments, "--pore-window");
  if (options.pore_window && !((*options.pore_window)[0] > 0))
    throw InputError("command line", 0, "--pore-window", *arguments.value("--pore-window"),
                     "must begin above 0: a power law has no end there");
  options.window_scan = arguments.has("--window-scan");
  if (const auto name = arguments.choice("--fit-constant", kFitConstantNames))
    options.fit_constant = *fit_constant_named(*name);
  options.pore_size = positive(arguments, "--pore-size");
  options.threshold = positive(arguments, "--threshold");
  if (arguments.choice("--force", {"total", "normal"}) == "normal") options.force_measure = ForceMeasure::normal;
  return options;
}

void refuse_options_of_other_sections(const Arguments& arguments, const std::vector<std::string>& only) {
  struct Belongs {
    const char* option;
    std::vector<std::string> sections;
  };
  static const std::vector<Belongs> all{{"--prestress", {"modes"}},         {"--modes", {"modes"}},
                                        {"--density-of-states", {"modes"}}, {"--bins", {"forces"}},
                                        {"--near-null", {"rigidity"}},      {"--vectors", {"bases"}},
                                        {"--k-window", {"scattering"}},     {"--fit-constant", {"scattering"}},
                                        {"--r-window", {"dacf"}},           {"--window-scan", {"scattering", "dacf"}},
                                        {"--pore-size", {"pores"}},         {"--pore-window", {"pores"}},
                                        {"--threshold", {"stressed"}},      {"--force", {"stressed"}}};
  for (const Belongs& b : all) {
    if (!arguments.has(b.option)) continue;
    const bool named = std::any_of(b.sections.begin(), b.sections.end(), [&](const std::string& section) {
      return std::find(only.begin(), only.end(), section) != only.end();
    });
    std::string list;
    for (const std::string& s : b.sections) list += (list.empty() ? "" : " or ") + s;
    if (!named)
      throw InputError("command line", 0, b.option, "", "belongs to the section " + list + ": name it in --only");
  }
}

}  // namespace isostat
