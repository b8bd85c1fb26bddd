#include "dem/files/formats/packing_header.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "dem/disks/sample.hpp"
#include "dem/disks/state_check.hpp"
#include "dem/disks/state_layout.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/real_text.hpp"
#include "dem/files/formats/table_packing.hpp"
#include "dem/files/formats/text_lines.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/deep_keys.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/spheres/state_check.hpp"
#include "dem/spheres/state_layout.hpp"

namespace isostat {
namespace {

constexpr std::string_view kCommentMark = "#isostat ";
constexpr std::string_view kDiameterMasses = "d^2";

std::string number_text(double x) {
  std::string text;
  append_real(text, x);
  return text;
}

template <class Numbers>
std::string list_text(const Numbers& numbers) {
  std::string text = "[";
  for (const double x : numbers) text += (text.size() > 1 ? ", " : "") + number_text(x);
  return text + "]";
}

// The Io of transfer_law() (dem/disks/state_layout.hpp, dem/spheres/state_layout.hpp).
struct LawWriter {
  std::string text;
  bool since(int) const { return true; }
  void value(const std::string&, const std::string& name, double x) { text += name + " = " + number_text(x) + "\n"; }
  template <class Enum, std::size_t N>
  void choice(const std::string&, const std::string& name, Enum e, const std::array<std::string_view, N>& names) {
    text += name + " = \"" + std::string(names[static_cast<std::size_t>(e)]) + "\"\n";
  }
};
// The same back: numbers and texts by their names; the first name that is missing or no choice.
struct LawReader {
  const std::map<std::string, std::vector<double>>& numbers;
  const std::map<std::string, std::string>& texts;
  std::string missing;
  bool since(int) const { return true; }
  void value(const std::string&, const std::string& name, double& x) {
    const auto found = numbers.find("law." + name);
    if (found != numbers.end() && found->second.size() == 1)
      x = found->second[0];
    else if (missing.empty())
      missing = "law." + name;
  }
  template <class Enum, std::size_t N>
  void choice(const std::string&, const std::string& name, Enum& e, const std::array<std::string_view, N>& names) {
    const auto text = texts.find("law." + name);
    const auto found = text == texts.end() ? names.end() : std::find(names.begin(), names.end(), text->second);
    if (found != names.end())
      e = static_cast<Enum>(found - names.begin());
    else if (missing.empty())
      missing = "law." + name;
  }
};
// Names alone.
struct LawNames {
  std::vector<std::string> names;
  bool since(int) const { return true; }
  void value(const std::string&, const std::string& name, double) { names.push_back("law." + name); }
  template <class Enum, std::size_t N>
  void choice(const std::string&, const std::string& name, Enum, const std::array<std::string_view, N>&) {
    names.push_back("law." + name);
  }
};

bool is_known(const std::string& key) {
  static const std::vector<std::string> known = [] {
    LawNames io;
    DiskLaw disks;
    SphereLaw spheres;
    transfer_law(io, disks), transfer_law(io, spheres);
    for (const char* name :
         {"system", "time", "step", "cell", "reference_length", "strain_rate", "imposed_stress", "tilt",
          "shear_strain_rate", "imposed_shear_stress", "masses", "density", "mass", "inertia"})
      io.names.emplace_back(name);
    return io.names;
  }();
  return std::find(known.begin(), known.end(), key) != known.end();
}

// Bodies without a law in units of the file; a law of kinds that the columns do not have would be another one.
bool has_law(const State<Disks>& state) { return state.law.normal_stiffness > 0; }
bool has_law(const State<Spheres>& state) { return state.law != SphereLaw{} && state.packing.kind.empty(); }

// How the masses follow from the radii, or else all of them. Without a line, as read_grains() makes them.
template <int D>
std::string mass_lines(const Packing<D>& packing, const Bodies<D>& by_rule, const std::string& rule) {
  const Bodies<D>& b = packing.bodies;
  Bodies<D> plain = b;
  set_equal_densities(plain);
  if (plain.mass == b.mass && plain.inertia == b.inertia) return "";
  if (by_rule.mass == b.mass && by_rule.inertia == b.inertia) return rule;
  const auto of_grains = [&](std::vector<double> all) {
    all.resize(packing.grains());
    return list_text(all);
  };
  return "mass = " + of_grains(b.mass) + "\ninertia = " + of_grains(b.inertia) + "\n";
}
std::string mass_lines(const State<Disks>& state) {
  Bodies<2> b = state.packing.bodies;
  set_disk_inertia(b);
  return mass_lines<2>(state.packing, b, "masses = \"" + std::string(kDiameterMasses) + "\"\n");
}
std::string mass_lines(const State<Spheres>& state) {
  Bodies<3> b = state.packing.bodies;
  const double density = state.scene.sphere_grains.density;
  set_sphere_inertia(b, density);
  return mass_lines<3>(state.packing, b, "density = " + number_text(density) + "\n");
}

void set_masses(Bodies<2>& b, const std::string* rule, std::optional<double>) {
  if (rule && *rule == kDiameterMasses) set_disk_inertia(b);
}
void set_masses(Bodies<3>& b, const std::string*, std::optional<double> density) {
  if (density) set_sphere_inertia(b, *density);
}

}  // namespace

template <class System>
std::string header_text(const State<System>& state) {
  std::string text = "system = \"" + std::string(System::name) + "\"\n";
  text += "time = " + number_text(state.time) + "\n";
  text += "step = " + std::to_string(state.step) + "\n";
  if (state.packing.cell) {
    text += "cell = " + list_text(state.packing.cell->length.c) + "\n";
    text += "reference_length = " + list_text(state.cell_motion.reference_length.c) + "\n";
    text += "strain_rate = " + list_text(state.cell_motion.strain_rate.c) + "\n";
    std::array<double, System::dimension> stress;
    std::transform(state.imposed_stress.begin(), state.imposed_stress.end(), stress.begin(),
                   [](const std::optional<double>& s) { return s.value_or(NAN); });
    text += "imposed_stress = " + list_text(stress) + "\n";
    if (state.packing.cell->tilt != 0) text += "tilt = " + number_text(state.packing.cell->tilt) + "\n";
    if (state.cell_motion.shear_strain_rate != 0)
      text += "shear_strain_rate = " + number_text(state.cell_motion.shear_strain_rate) + "\n";
    if (state.imposed_stress.shear) text += "imposed_shear_stress = " + number_text(*state.imposed_stress.shear) + "\n";
  }
  text += mass_lines(state);
  if (!has_law(state)) return text;
  LawWriter law;
  transfer_law(law, const_cast<typename System::Law&>(state.law));  // a writer only looks
  return text + "\n[law]\n" + law.text;
}

PackingHeader::PackingHeader(std::string_view toml, std::string path) : path_(std::move(path)) {
  refuse_deep_keys(toml, path_);
  toml::table table;
  try {
    table = toml::parse(toml, std::string_view(path_));
  } catch (const toml::parse_error& error) {
    throw InputError(path_, static_cast<int>(error.source().begin.line), "", "",
                     "not valid TOML: " + std::string(error.description()));
  }
  const auto take = [&](const std::string& name, const toml::node& node) {
    lines_[name] = static_cast<int>(node.source().begin.line);
    if (!is_known(name)) refuse(name, "unknown key");
    if (const auto* text = node.as_string()) {
      texts_[name] = text->get();
    } else if (const auto* array = node.as_array()) {
      std::vector<double>& list = numbers_[name];
      for (const toml::node& element : *array) {
        const auto number = element.value<double>();
        if (!number || element.is_boolean()) refuse(name, "must be a list of numbers");
        list.push_back(*number);
      }
    } else if (const auto number = node.value<double>(); number && !node.is_boolean()) {
      numbers_[name] = {*number};
    } else {
      refuse(name, "must be a number, a list of numbers or a text");
    }
  };
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (const toml::table* law = node.as_table())
      for (const auto& [inner, value] : *law) take(name + "." + std::string(inner.str()), value);
    else
      take(name, node);
  }
}

void PackingHeader::refuse(const std::string& key, const std::string& rule) const {
  const auto line = lines_.find(key);
  throw InputError(path_, line == lines_.end() ? 0 : line->second, key, "", rule);
}

std::optional<std::vector<double>> PackingHeader::cell() const {
  const auto found = numbers_.find("cell");
  return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

double PackingHeader::tilt() const {
  const auto found = numbers_.find("tilt");
  if (found == numbers_.end()) return 0;
  if (found->second.size() != 1) refuse("tilt", "must be a number");
  return found->second[0];
}

template <class System>
void PackingHeader::complete(State<System>& state) const {
  constexpr int D = System::dimension;
  const auto system = texts_.find("system");
  if (system == texts_.end() || system->second != System::name)
    refuse("system", "must be \"" + std::string(System::name) + "\", as the grains are");
  const auto list = [&](const char* key, std::size_t size) -> const std::vector<double>* {
    const auto found = numbers_.find(key);
    if (found == numbers_.end()) return nullptr;
    if (found->second.size() != size) refuse(key, "must be " + std::to_string(size) + " numbers");
    return &found->second;
  };
  const auto real = [&](const char* key) {
    const auto* value = list(key, 1);
    return value ? std::optional((*value)[0]) : std::nullopt;
  };
  state.time = real("time").value_or(0);
  const double step = real("step").value_or(0);
  constexpr double most_steps = 9e15;  // exact in a real
  if (!(step >= 0 && step <= most_steps)) refuse("step", "must not be negative");
  state.step = static_cast<std::int64_t>(step);
  if (const auto* v = list("reference_length", D))
    std::copy_n(v->begin(), D, state.cell_motion.reference_length.c.begin());
  if (const auto* v = list("strain_rate", D)) std::copy_n(v->begin(), D, state.cell_motion.strain_rate.c.begin());
  if (const auto* v = list("imposed_stress", D))
    for (std::size_t a = 0; a < D; ++a)
      state.imposed_stress[a] = std::isnan((*v)[a]) ? std::nullopt : std::optional((*v)[a]);

  state.cell_motion.shear_strain_rate = real("shear_strain_rate").value_or(0);
  state.imposed_stress.shear = real("imposed_shear_stress");

  Bodies<D>& bodies = state.packing.bodies;
  const auto rule = texts_.find("masses");
  if (rule != texts_.end() && rule->second != kDiameterMasses) refuse("masses", "must be \"d^2\"");
  set_masses(bodies, rule == texts_.end() ? nullptr : &rule->second, real("density"));
  if (const auto* mass = list("mass", bodies.size())) bodies.mass = *mass;
  if (const auto* inertia = list("inertia", bodies.size())) bodies.inertia = *inertia;

  if (std::any_of(lines_.begin(), lines_.end(), [](const auto& l) { return l.first.starts_with("law."); })) {
    LawReader law{numbers_, texts_, {}};
    transfer_law(law, state.law);
    if (!law.missing.empty()) refuse(law.missing, "is missing or out of range");
  }
  if (const auto fault = state_fault(state)) throw InputError(path_, 0, fault->field, "", fault->rule);
}

std::string commented_header(std::string_view header) {
  std::string text;
  Lines lines(header);
  for (std::string_view line; lines.next(line);)
    if (!line.empty()) text += std::string(kCommentMark) + std::string(line) + '\n';
  return text;
}

std::optional<PackingHeader> header_in_comments(std::string_view network, const std::string& path) {
  std::string toml;
  bool any = false;
  Lines lines(network);
  for (std::string_view line; lines.next(line); toml += '\n')
    if (line.starts_with(kCommentMark)) toml += line.substr(kCommentMark.size()), any = true;
  if (!any) return std::nullopt;
  return PackingHeader(toml, path);
}

std::string header_path(std::string_view path) {
  if (!path.ends_with(".csv")) return std::string(path) + ".toml";
  const std::string grains = grains_csv_path(path);
  return grains.substr(0, grains.size() - std::string_view(".grains.csv").size()) + ".csv.toml";
}

template std::string header_text(const State<Disks>&);
template std::string header_text(const State<Spheres>&);
template void PackingHeader::complete(State<Disks>&) const;
template void PackingHeader::complete(State<Spheres>&) const;

}  // namespace isostat
