// Rows of fields under named columns, as in CSV and LAMMPS dumps, and their reading into grains and links.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/input_error.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct TextTable {
  std::string path;
  int first_line = 0;  // line number of the first row
  std::vector<std::string> columns;
  std::vector<std::string_view> cells;  // row by row; views into the file's text
  std::size_t rows() const { return columns.empty() ? 0 : cells.size() / columns.size(); }
  std::optional<std::size_t> column(std::string_view name) const;
  std::string_view cell(std::size_t row, std::size_t col) const { return cells[row * columns.size() + col]; }
};

// Header line of names and comma-separated rows. Throws InputError for rows of another length.
TextTable parse_csv(std::string_view text, const std::string& path);

// A column of finite numbers; empty if there is none of this name. Cells that are no such numbers become faults.
std::vector<double> real_column(const TextTable& table, std::string_view name, std::vector<Fault>& faults);

// Dimension of a table of grains: 3 if it has a column z that is not zero throughout, else 2.
int grain_dimension(const TextTable& grains);

// Columns id, x, y(, z), r; optional vx, vy(, vz), omega (3D wx, wy, wz), and m, or density. Other columns are ignored.
// A density is over that of a grain of diameter and mass 1; without either the largest grain gets mass 1 and all the
// same density. Throws InputError listing the faults with their lines.
template <int D>
Bodies<D> read_grains(const TextTable& grains);

// Columns i, j (ids of grains); optional s1, s2(, s3), kind (letters or their number), h, N, T (3D Tx, Ty, Tz), M (3D
// Mx, My, Mz). Without shifts the nearest image is meant, without h the gap of the positions, without kind c.
template <int D>
std::vector<Link<D>> read_links(const TextTable& links, const Packing<D>& grains);

}  // namespace isostat
