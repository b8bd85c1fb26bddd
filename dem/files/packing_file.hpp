// Any file that holds a packing, told apart by its content: a state (HDF5), a network, a LAMMPS dump, a table of
// grains.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dem/files/formats/column_names.hpp"
#include "dem/state/packing.hpp"
#include "dem/systems.hpp"
#include "geometry/triangle_signs.hpp"

namespace isostat {

enum class PackingFormat { state, network, dump, csv };

struct PackingFile {
  PackingFormat format = PackingFormat::state;
  State<Disks> state;                              // of a planar file; of another format than a state: foreign_state()
  std::optional<SpherePacking> packing_3d;         // of a 3D file; `state` then has no grains
  std::optional<State<Spheres>> spheres;           // of spheres with a state or header, beside packing_3d
  std::optional<State<TriangleGrains>> triangles;  // of a file of triangles; `state` then has no grains
  std::vector<Triangle> corners;                   // of the triangles, anticlockwise: of a network as its file has them
  bool links_given = false;                        // the file lists its links; false: found by touching
  bool ids_given = false, sizes_given = true, velocities_given = false, spins_given = false,
       densities_given = false;  // of a table: it has the columns
};

struct PackingReading {
  std::optional<double> gap_tolerance;  // [length of the file] for finding contacts; none: see dem/state/touching.hpp
  std::optional<std::vector<double>> box;  // edges of the cell of a file that has none
  std::string box_name = "--box";          // by which the user gave it
  ColumnNames columns;                     // of tables and dumps (--columns)
  std::string contacts;                    // file of the contacts of a table or dump (--contacts); empty: looked for
  double length = 1, force = 1;            // of the file, that become the units (--length, --force)
  // Of the state that a moved packing is put into (--from): what a table has no column for.
  std::optional<double> radius;                 // of all grains, until the state says it
  std::optional<std::vector<double>> own_cell;  // where neither the file nor --box has one
  double own_tilt = 0;                          // of that cell
};

// Throws InputError if the file cannot be read, is of no known format, is faulty, or has a cell and is given another.
// Beside X.grains.csv (or X.csv) the contacts are looked for in X.contacts.csv, beside X.dump in X.contacts.dump; and
// in X.csv.toml and X.dump.toml what the columns do not say (dem/files/formats/packing_header.hpp).
PackingFile read_packing(const std::string& path, const PackingReading& reading = {});

// What the file is, by its first bytes. Throws InputError for an unknown one; where columns are named it is a table.
PackingFormat sniff_packing_format(const std::string& path, bool columns_named = false);

// A state for a foreign packing: no law, no history, time 0; kinds, gaps and forces of the links as given.
State<Disks> foreign_state(Packing<2> packing);
// The same in space.
State<Spheres> foreign_state(Packing<3> packing);
// The same for triangles, with the law of a network of triangles.
State<TriangleGrains> foreign_state(TrianglePacking packing);

}  // namespace isostat
