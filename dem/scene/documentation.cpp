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

}  // namespace

std::string scene_documentation() {
  const Scene scene = scene_with_every_key();
  std::string text =
      "# Scene keys\n\n"
      "Generated from the table of keys (`dem/scene/keys.cpp`, `dem/disks/keys.cpp`); run the tests with "
      "`ISOSTAT_REGENERATE=1` to write it "
      "anew.\n\n"
      "A scene is a TOML file. Every key has a default unless the table says otherwise; an unknown key is an error. On "
      "the command line, `--set KEY=VALUE` overrides a key with a TOML value (`0.5`, `true`, `'\"text\"'`); keys of "
      "the "
      "n-th `[[stage]]` are `stage.n.KEY`, counted from 0. An integer is accepted for a real. A key whose condition "
      "does not hold is ignored.\n\n"
      "Units: a is the largest diameter, m the mass of a disk of that diameter, F0 the attraction of a contact "
      "(without "
      "cohesion a P), T0 = sqrt(m a / F0), V* = sqrt(F0 D0 / m), F1 = max(F0, a P).\n";
  std::string table = "-";
  for (const SceneKey& key : scene_keys()) {
    if (table_of(key) != table) {
      table = table_of(key);
      const std::string heading = table.empty()           ? "Top level"
                                  : belongs_to_stage(key) ? "`[[stage]]`, in the order they run"
                                  : belongs_to_units(key)
                                      ? "`[units]`, maps the reduced run to SI; all three keys or no table"
                                      : "`[" + table + "]`";
      text += "\n## " + heading +
              "\n\n| key | type and range | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
    }
    std::string fallback = value_text(key, scene, 0);
    if (belongs_to_units(key)) fallback = "required";
    if (fallback.empty()) fallback = std::string(key.absent);
    std::string meaning(key.meaning);
    if (key.condition.holds) meaning += " Applies when " + std::string(key.condition.in_words) + ".";
    text += "| `" + std::string(key.name) + "`";
    for (const std::string& cell : {rule_text(key), std::string(key.unit.empty() ? "-" : key.unit), fallback, meaning})
      text += " | " + cell_text(cell);
    text += " |\n";
  }
  return text;
}

}  // namespace isostat
