// Which column of a foreign table is meant by which of our names.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/files/formats/text_table.hpp"

namespace isostat {

enum class TableKind { grains, contacts };

// Ours and theirs, of convert --columns. Else a column goes by our name or one of its synonyms, in capitals or not,
// with or without a unit in brackets behind it; the forces N, T, M by these capitals alone.
using ColumnNames = std::map<std::string, std::string>;

// "x=a,y=b,r=c". Throws InputError for anything else, and for names that are not ours.
ColumnNames parse_column_names(const std::string& option);

// Throws InputError if the table lacks a column that was named.
std::optional<std::size_t> find_column(const TextTable& table, TableKind kind, const std::string& name,
                                       const ColumnNames& named);

// A column that by its name is a force: begins with f, or has the word in it.
std::optional<std::string> first_force(const TextTable& table);

// Whether a name of ours is one of this kind of table.
bool is_column_of(TableKind kind, const std::string& name);

// "A, B, C", for messages.
std::string list_of_columns(const TextTable& table);

}  // namespace isostat
