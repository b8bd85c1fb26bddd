// Grains and links from tables of text (docs/formats.md has their columns).
#pragma once
#include <optional>
#include <vector>

#include "dem/files/formats/column_names.hpp"
#include "dem/files/formats/text_table.hpp"
#include "dem/input_error.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// Dimension of a table of grains: 3 if it has a column z that is not zero throughout, else 2.
int grain_dimension(const TextTable& grains, const ColumnNames& named);

// What the table has. densities: a column density, and no m, which says the same in other words.
struct GrainColumns {
  bool ids = false, sizes = false, velocities = false, spins = false, densities = false;
};

// A column of finite numbers by exactly this name; empty if there is none. Cells that are no such numbers become
// faults.
std::vector<double> real_column(const TextTable& table, std::string_view name, std::vector<Fault>& faults);

// Columns x, y(, z), r or d; optional id, vx, vy(, vz), omega (3D wx, wy, wz), and m, or density (over that of a grain
// of diameter and mass 1). Other columns are ignored. Without id grains are numbered by rows from 1; without m and
// density the largest has mass 1 and all the same density; without r and d all have the radius given here. Throws
// InputError listing the faults with their lines.
template <int D>
Bodies<D> read_grains(const TextTable& grains, const ColumnNames& named, std::optional<double> radius = std::nullopt,
                      GrainColumns* columns = nullptr);

// Mass 1 for the largest grain: what a file without masses is taken to mean.
template <int D>
void set_equal_densities(Bodies<D>& bodies);

// Columns i, j (ids of grains); optional s1, s2(, s3), kind (letters or their number), h, M (3D Mx, My, Mz), and N, T
// (3D Tx, Ty, Tz) or fx, fy(, fz), to which Tx, Ty(, Tz) are added if they stand beside: the force on j, split along
// and across the branch vector. Without shifts the nearest image is meant, without h the gap of the positions, without
// kind c, without forces zero.
template <int D>
std::vector<Link<D>> read_links(const TextTable& links, const Packing<D>& grains, const ColumnNames& named);

}  // namespace isostat
