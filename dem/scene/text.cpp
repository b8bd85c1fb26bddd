#include "dem/scene/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <type_traits>

namespace isostat {
namespace {

std::string_view type_name(const SceneField& field) {
  constexpr std::array<std::string_view, std::variant_size_v<SceneField>> names{
      "boolean", "integer", "integer", "real", "real", "text", "list of reals", "text", "text", "text", "text",
      "text",    "text",    "text",    "text", "text", "text", "text",          "text", "text", "text"};
  return names[field.index()];
}

std::string number(double x) {  // for prose: 0.5, 1e+09
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr};
}

std::string range_text(const SceneRange& range) {
  const bool low = range.low > -std::numeric_limits<double>::infinity(),
             high = range.high < std::numeric_limits<double>::infinity();
  if (low && high)
    return std::string("in ") + (range.low_open ? "(" : "[") + number(range.low) + ", " + number(range.high) +
           (range.high_open ? ")" : "]");
  if (low) return (range.low_open ? "> " : ">= ") + number(range.low);
  if (high) return (range.high_open ? "< " : "<= ") + number(range.high);
  return {};
}

// Scene is only looked at; the table hands out mutable fields because the parser writes through the same rows.
SceneField field_of(const SceneKey& key, const Scene& scene, std::size_t stage) {
  return key.field(const_cast<Scene&>(scene), stage);
}

}  // namespace

Scene scene_with_every_key(SceneSystem system) {
  Scene scene = default_scene(system, 1);
  scene.units.emplace();
  return scene;
}

const std::vector<UnitWord>& unit_words() {
  static const std::vector<UnitWord> words{{"a", "cm", "a"},
                                           {"T0", "s", "T0"},
                                           {"1/T0", "1/s", "1/T0"},
                                           {"a/T0", "cm/s", "a/T0"},
                                           {"a/T0^2", "cm/s^2", "a/T0^2"},
                                           {"F0/a", "g/s^2", "F0/a^2"},
                                           {"F1/a", "F1/a", "F1/a^2"}};
  return words;
}

std::string_view unit_text(const SceneKey& key, SceneSystem system) {
  if (system == SceneSystem::disks || !key.systems.has(SceneSystem::disks)) return key.unit;
  const auto& words = unit_words();
  const auto found = std::find_if(words.begin(), words.end(), [&](const UnitWord& w) { return w.disks == key.unit; });
  if (found == words.end()) return key.unit;
  return system == SceneSystem::triangles ? found->triangles : found->spheres;
}

std::string real_text(double value) {
  if (value != value) return "nan";
  if (value - value != 0) return value > 0 ? "inf" : "-inf";
  std::string text = number(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string quoted_text(std::string_view value) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "\"";
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      text += '\\', text += c;
    else if (code < 0x20 || code == 0x7f)
      text += "\\u00", text += digits[code >> 4], text += digits[code & 15];
    else
      text += c;
  }
  return text + "\"";
}

std::string value_text(const SceneKey& key, const Scene& scene, std::size_t stage) {
  return std::visit(
      [&](const auto* value) -> std::string {
        using Type = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<Type, bool>)
          return *value ? "true" : "false";
        else if constexpr (std::is_same_v<Type, double>)
          return real_text(*value);
        else if constexpr (std::is_integral_v<Type>)
          return std::to_string(*value);
        else if constexpr (std::is_same_v<Type, std::optional<double>>)
          return value->has_value() ? real_text(**value) : std::string{};
        else if constexpr (std::is_same_v<Type, std::string>)
          return quoted_text(*value);
        else if constexpr (std::is_same_v<Type, std::vector<double>>) {
          std::string text;
          for (const double x : *value) text += (text.empty() ? "" : ", ") + real_text(x);
          return "[" + text + "]";
        } else
          return quoted_text(key.choices.at(static_cast<std::size_t>(*value)));
      },
      field_of(key, scene, stage));
}

std::string rule_text(const SceneKey& key) {
  const Scene scene = scene_with_every_key(SceneSystem::disks);
  std::string text(type_name(field_of(key, scene, 0)));
  if (!key.choices.empty()) {
    text = "one of";
    for (const std::string_view choice : key.choices) text += " " + quoted_text(choice);
  }
  const std::string range = range_text(key.range);
  return range.empty() ? text : text + " " + range;
}

bool echoed(const SceneKey& key, const Scene& scene, std::size_t stage) {
  if (!applies(key, scene)) return false;
  if (!key.hidden_at_default) return true;
  Scene plain;
  plain.stages.resize(scene.stages.size());
  return value_text(key, scene, stage) != value_text(key, plain, stage);
}

std::string scene_to_toml(const Scene& scene) {
  std::string text, table;
  const auto write = [&](const SceneKey& key, std::size_t stage) {
    const std::string value = value_text(key, scene, stage);
    const std::string name(leaf_of(key));
    if (!value.empty())
      text += name + " = " + value + "\n";
    else
      text += "# " + name + ": " + std::string(key.absent) + "\n";
  };
  for (const SceneKey& key : scene_keys(scene.system)) {
    if (belongs_to_stage(key) || !echoed(key, scene, 0)) continue;
    if (table_of(key) != table) {
      table = table_of(key);
      text += "\n[" + table + "]\n";
    }
    write(key, 0);
  }
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    text += "\n[[stage]]\n";
    for (const SceneKey& key : scene_keys(scene.system))
      if (belongs_to_stage(key) && echoed(key, scene, stage)) write(key, stage);
  }
  return text;
}

}  // namespace isostat
