#include "dem/files/formats/column_names.hpp"

#include <algorithm>
#include <cctype>

#include "dem/files/formats/text_lines.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Synonyms = std::vector<std::pair<std::string, std::vector<std::string>>>;

// In small letters.
const Synonyms& synonyms_of_grains() {
  static const Synonyms all = [] {
    Synonyms names{{"id", {"label", "particle", "particle_id", "grain"}},
                   {"r", {"radius", "rad"}},
                   {"d", {"diameter", "diam"}},
                   {"omega", {"omegaz", "omega_z", "wz"}},
                   {"m", {"mass"}},
                   {"density", {"rho"}}};
    for (const std::string a : {"x", "y", "z"}) {
      names.push_back({a, {a + "c", a + "_center", "center_" + a, "pos_" + a, "position_" + a}});
      names.push_back({"v" + a, {"v_" + a, "vel_" + a, "velocity_" + a}});
      names.push_back({"w" + a, {"omega" + a, "omega_" + a}});
    }
    return names;
  }();
  return all;
}
const Synonyms& synonyms_of_contacts() {
  static const Synonyms all{{"i", {"id1", "id_i", "particle1", "grain1"}},
                            {"j", {"id2", "id_j", "particle2", "grain2"}},
                            {"s1", {}},
                            {"s2", {}},
                            {"s3", {}},
                            {"kind", {}},
                            {"h", {"gap"}},
                            {"fx", {"f_x", "force_x"}},
                            {"fy", {"f_y", "force_y"}},
                            {"fz", {"f_z", "force_z"}},
                            {"N", {}},
                            {"T", {}},
                            {"Tx", {}},
                            {"Ty", {}},
                            {"Tz", {}},
                            {"M", {}},
                            {"Mx", {}},
                            {"My", {}},
                            {"Mz", {}}};
  return all;
}
const Synonyms& synonyms(TableKind kind) {
  return kind == TableKind::grains ? synonyms_of_grains() : synonyms_of_contacts();
}
const std::vector<std::string>* synonyms_of(TableKind kind, const std::string& name) {
  for (const auto& [ours, others] : synonyms(kind))
    if (ours == name) return &others;
  return nullptr;
}

bool is_small(const std::string& name) {
  return std::none_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c); });
}

// In small letters, without a unit: "X [px]" is x.
std::string plain(std::string_view column) {
  column = trimmed(column.substr(0, std::min(column.find(" ["), column.find(" ("))));
  std::string small(column);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

}  // namespace

ColumnNames parse_column_names(const std::string& option) {
  ColumnNames names;
  const auto refuse = [&](const std::string& rule) { throw InputError("command line", 0, "--columns", option, rule); };
  for (std::size_t at = 0; at <= option.size();) {
    const std::size_t end = std::min(option.find(',', at), option.size());
    const std::string part = option.substr(at, end - at);
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size())
      refuse("is OURS=THEIRS, with commas between several: x=pos1,y=pos2,d=size");
    const std::string ours = part.substr(0, equals);
    if (!is_column_of(TableKind::grains, ours) && !is_column_of(TableKind::contacts, ours)) {
      std::string list;
      for (const TableKind kind : {TableKind::grains, TableKind::contacts})
        for (const auto& [name, others] : synonyms(kind)) list += (list.empty() ? "" : " ") + name;
      refuse(ours + " is none of the columns that are read: " + list);
    }
    if (!names.emplace(ours, part.substr(equals + 1)).second) refuse(ours + " is named twice");
    at = end + 1;
  }
  return names;
}

std::optional<std::size_t> find_column(const TextTable& table, TableKind kind, const std::string& name,
                                       const ColumnNames& named) {
  if (const auto given = named.find(name); given != named.end()) {
    if (const auto found = table.column(given->second)) return found;
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      if (plain(table.columns[k]) == plain(given->second)) return k;
    throw InputError(table.path, table.header_line, "--columns", name + "=" + given->second,
                     "the table has no such column; it has " + list_of_columns(table));
  }
  if (const auto found = table.column(name)) return found;
  if (!is_small(name)) return std::nullopt;
  std::vector<std::string> wanted{name};
  if (const auto* others = synonyms_of(kind, name)) wanted.insert(wanted.end(), others->begin(), others->end());
  for (const std::string& other : wanted)
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      if (plain(table.columns[k]) == other) return k;
  return std::nullopt;
}

std::optional<std::string> first_force(const TextTable& table) {
  for (const std::string& column : table.columns)
    if (const std::string name = plain(column); name.starts_with("f") || name.find("force") != std::string::npos)
      return column;
  return std::nullopt;
}

bool is_column_of(TableKind kind, const std::string& name) { return synonyms_of(kind, name) != nullptr; }

std::string list_of_columns(const TextTable& table) {
  std::string list;
  for (const std::string& name : table.columns) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace isostat
