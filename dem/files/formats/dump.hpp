// LAMMPS dump files (LAMMPS, OVITO): grains as `dump custom`, links as `dump local` (docs/formats.md).
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dem/files/formats/column_names.hpp"
#include "dem/files/formats/text_table.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// One frame. Columns id type x y z radius vx vy vz omegax omegay omegaz mass; in 2D z = vz = omegax = omegay = 0.
template <int D>
std::string grains_dump(const Packing<D>& packing, std::int64_t step);
// Columns i j s1 s2 (s3) kind h N T M (3D Tx Ty Tz Mx My Mz); kind 0 c, 1 s, 2 r, 3 sr, 4 d.
template <int D>
std::string links_dump(const Packing<D>& packing, std::int64_t step);

// "X.dump" -> "X.contacts.dump".
std::string links_dump_path(std::string_view path);

// The last frame of a dump. Positions are x, y, z, or xu, yu, zu, or the scaled xs, ys, zs (xsu, ysu, zsu). `box`:
// edges along the axes with a periodic boundary ("pp"), of the cell itself where LAMMPS gives the box around a tilted
// one; a cell periodic along some of the packing's axes only, or tilted otherwise than by xy, is refused.
struct DumpFrame {
  TextTable table;
  std::optional<std::int64_t> step;
  std::optional<std::vector<double>> box;  // [length] three edges
  double tilt = 0;                         // xy
};
DumpFrame parse_dump(std::string text, const std::string& path, const ColumnNames& named = {});

}  // namespace isostat
