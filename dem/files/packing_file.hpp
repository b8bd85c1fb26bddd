// Any file that holds a packing, told apart by its content: a state (HDF5), a network, a LAMMPS dump, a CSV of grains.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dem/state/packing.hpp"
#include "dem/systems.hpp"
#include "geometry/triangle_signs.hpp"

namespace isostat {

enum class PackingFormat { state, network, dump, csv };

struct PackingFile {
  PackingFormat format = PackingFormat::state;
  State<Disks> state;                              // of a planar file; of another format than a state: foreign_state()
  std::optional<SpherePacking> packing_3d;         // of a 3D file; `state` then has no grains
  std::optional<State<Spheres>> spheres;           // of a state of spheres, beside packing_3d
  std::optional<State<TriangleGrains>> triangles;  // of a file of triangles; `state` then has no grains
  std::vector<Triangle> corners;                   // of the triangles, anticlockwise: of a network as its file has them
  bool links_given = false;                        // the file lists its links; false: found by touching
  bool densities_given = false;                    // the file has a column density
};

struct PackingReading {
  std::optional<double> gap_tolerance;  // [length of the file] for finding contacts; none: see dem/state/touching.hpp
  std::optional<std::vector<double>> box;  // edges of the cell of a file that has none
  std::string box_name = "--box";          // by which the user gave it
};

// Throws InputError if the file cannot be read, is of no known format, is faulty, or has a cell and is given another.
// Beside X.grains.csv (or X.csv) the contacts are looked for in X.contacts.csv, beside X.dump in X.contacts.dump.
PackingFile read_packing(const std::string& path, const PackingReading& reading = {});

// What the file is, by its first bytes. Throws InputError for an unknown one.
PackingFormat sniff_packing_format(const std::string& path);

// A state for a foreign packing: no law, no history, time 0; kinds, gaps and forces of the links as given.
State<Disks> foreign_state(Packing<2> packing);
// The same in space.
State<Spheres> foreign_state(Packing<3> packing);
// The same for triangles, with the law of a network of triangles.
State<TriangleGrains> foreign_state(TrianglePacking packing);

}  // namespace isostat
