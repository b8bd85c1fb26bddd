#include "dem/scene/documentation.hpp"

#include "dem/scene/text.hpp"

namespace isostat {
namespace {

// As it stands in a cell of a Markdown table, where a bar would end the cell.
std::string cell_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string defaults_of(const SceneKey& key, SceneSystem system) {
  if (belongs_to_units(key)) return "required";
  const std::string value = value_text(key, scene_with_every_key(system), 0);
  return value.empty() ? std::string(key.absent) : value;
}

std::string row_text(const SceneKey& key) {
  std::vector<SceneSystem> systems;
  for (std::size_t s = 0; s < kSystemNames.size(); ++s)
    if (key.systems.has(static_cast<SceneSystem>(s))) systems.push_back(static_cast<SceneSystem>(s));
  const std::string first = defaults_of(key, systems.front());
  std::string fallback = first;
  for (const SceneSystem system : systems)
    if (const std::string other = defaults_of(key, system); other != first)
      fallback += " (" + std::string(name(system)) + " " + other + ")";
  std::string meaning(key.meaning);
  if (key.condition.holds) meaning += " Applies when " + std::string(key.condition.in_words) + ".";
  std::string text = "| `" + std::string(key.name) + "`";
  for (const std::string& cell : {rule_text(key), std::string(key.unit.empty() ? "-" : key.unit), fallback, meaning})
    text += " | " + cell_text(cell);
  return text + " |\n";
}

std::string tables_of(SystemSet systems) {
  std::string text, table = "-";
  for (const SceneKey& key : scene_keys()) {
    if (key.systems != systems) continue;
    if (table_of(key) != table) {
      table = table_of(key);
      const std::string heading = table.empty()           ? "Top level"
                                  : belongs_to_stage(key) ? "`[[stage]]`, in the order they run"
                                  : belongs_to_units(key)
                                      ? "`[units]`, maps the reduced run to SI; all three keys or no table"
                                      : "`[" + table + "]`";
      text += "\n### " + heading +
              "\n\n| key | type and range | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
    }
    text += row_text(key);
  }
  return text;
}

std::string units_text() {
  std::string text = "\n| unit | of triangles | of spheres |\n| --- | --- | --- |\n";
  for (const UnitWord& word : unit_words())
    text += "| " + std::string(word.disks) + " | " + std::string(word.triangles) + " | " + std::string(word.spheres) +
            " |\n";
  return text;
}

}  // namespace

std::string scene_documentation() {
  std::string text =
      "# Scene keys\n\n"
      "Generated from the table of keys (`dem/scene/keys.cpp`, `dem/disks/keys.cpp`, `dem/triangles/keys.cpp`, "
      "`dem/spheres/keys.cpp`); run "
      "the tests with `ISOSTAT_REGENERATE=1` to write it anew.\n\n"
      "A scene is a TOML file. Every key has a default unless the table says otherwise; an unknown key is an error. On "
      "the command line, `--set KEY=VALUE` overrides a key with a TOML value (`0.5`, `true`, `'\"text\"'`); keys of "
      "the "
      "n-th `[[stage]]` are `stage.n.KEY`, counted from 0. An integer is accepted for a real. A key whose condition "
      "does not hold is ignored.\n\n"
      "The key `system` says what the grains are, disks where it is absent. Keys of all systems come first, then those "
      "that some of them or only one has; a key of another system is an error.\n\n"
      "Units of disks: a is the largest diameter, m the mass of a disk of that diameter, F0 the attraction of a "
      "contact (without cohesion a P), T0 = sqrt(m a / F0), V* = sqrt(F0 D0 / m) (without cohesion see "
      "stage.velocity), F1 = max(F0, a P).\n\n"
      "Triangles have units of their own, cm, g and s. Spheres have those of disks, or any consistent set: read a, m, "
      "F0 and T0 as 1 m, 1 kg, 1 N and 1 s for SI. Where a key of all systems has a unit of disks, it is of "
      "triangles and spheres:\n";
  text += units_text();
  text +=
      "\nIn F1, F1/a and F1 a, a is then the root of the area of the largest grain, F1 = max(a P, weight of the "
      "heaviest "
      "grain) or, without either, 1 dyn.\n";
  text += "\n## Keys of all systems\n" + tables_of(SystemSet::all());
  std::vector<SystemSet> sets{SystemSet::both(SceneSystem::disks, SceneSystem::spheres)};
  for (std::size_t s = 0; s < kSystemNames.size(); ++s) sets.push_back(SystemSet::only(static_cast<SceneSystem>(s)));
  for (const SystemSet set : sets) text += "\n## Keys of " + names_of(set) + "\n" + tables_of(set);
  return text;
}

}  // namespace isostat
