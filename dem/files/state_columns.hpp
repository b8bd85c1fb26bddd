// What the layouts of systems are written with (state_layout.hpp of each): lists of structs as columns of a state file,
// codes, neighbour lists. Io is StateWriter or StateReader of dem/files/state_io.hpp.
#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "dem/state/list_memory.hpp"

namespace isostat {

// Units of what all systems have, as they stand in their files.
struct FileUnits {
  const char *length, *time;
};

struct Column {
  const char *name, *unit;
};

namespace state_columns {

// Enumerators and truths lie in the file as bytes.
template <class T>
using Stored = std::conditional_t<std::is_enum_v<T> || std::is_same_v<T, bool>, std::uint8_t, T>;

template <class T>
T from_stored(const Stored<T>& value) {
  if constexpr (std::is_same_v<T, bool>)
    return value != 0;
  else
    return static_cast<T>(value);
}

template <std::size_t K, class Io, class Row, class Tie>
void transfer_column(Io& io, const std::string& path, std::vector<Row>& rows, Tie tie, std::size_t count,
                     const char* unit) {
  using T = std::remove_reference_t<std::tuple_element_t<K, decltype(tie(rows.front()))>>;
  std::vector<Stored<T>> values;
  if (io.writes)
    for (Row& row : rows) values.push_back(static_cast<Stored<T>>(std::get<K>(tie(row))));
  io.array(path, values, count, unit);
  if (io.writes) return;
  rows.resize(count);
  for (std::size_t k = 0; k < count; ++k) std::get<K>(tie(rows[k])) = from_stored<T>(values[k]);
}

}  // namespace state_columns

// A list of structs: one array for each member that `tie` names, in the order of the columns.
template <class Io, class Row, class Tie, std::size_t N>
void transfer_rows(Io& io, const std::string& group, std::vector<Row>& rows, Tie tie, const Column (&columns)[N]) {
  static_assert(std::tuple_size_v<decltype(tie(rows.front()))> == N, "a name and a unit for each member");
  const std::size_t count = io.count(group + "/" + columns[0].name, rows.size());
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (state_columns::transfer_column<K>(io, group + "/" + columns[K].name, rows, tie, count, columns[K].unit), ...);
  }
  (std::make_index_sequence<N>{});
}

// An array of enumerators.
template <class Io, class Enum>
void transfer_codes(Io& io, const std::string& path, std::vector<Enum>& values, std::size_t count) {
  std::vector<std::uint8_t> codes;
  if (io.writes)
    for (const Enum value : values) codes.push_back(static_cast<std::uint8_t>(value));
  io.array(path, codes, count, "");
  if (io.writes) return;
  values.clear();
  for (const std::uint8_t code : codes) values.push_back(static_cast<Enum>(code));
}

// An array that may be empty whatever the others are.
template <class Io, class T>
void transfer_memory_array(Io& io, const std::string& name, std::vector<T>& values, const char* unit) {
  io.array("/solver/" + name, values, io.count("/solver/" + name, values.size()), unit);
}

template <class Io, int D>
void transfer_lists(Io& io, ListMemory<D>& lists, const char* unit) {
  auto& [outer_position, inner_position, outer_length, inner_length, outer_tilt, inner_tilt, outer_skin, inner_skin,
         outer_travel, inner_travel] = lists;
  transfer_memory_array(io, "outer_position", outer_position, unit);
  transfer_memory_array(io, "inner_position", inner_position, unit);
  io.value("/solver", "outer_length", outer_length);
  io.value("/solver", "inner_length", inner_length);
  if (io.since(7)) io.value("/solver", "outer_tilt", outer_tilt), io.value("/solver", "inner_tilt", inner_tilt);
  io.value("/solver", "outer_skin", outer_skin);
  io.value("/solver", "inner_skin", inner_skin);
  io.value("/solver", "outer_travel", outer_travel);
  io.value("/solver", "inner_travel", inner_travel);
}

}  // namespace isostat
