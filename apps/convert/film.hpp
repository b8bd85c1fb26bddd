// Formats of one file for any number of frames: ParaView, LAMMPS dump, extended XYZ.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dem/systems.hpp"

namespace isostat {

inline constexpr std::array<std::string_view, 7> kConvertedFormats{".h5",  ".vtp", ".pvd", ".dump",
                                                                   ".xyz", ".net", ".csv"};

using WrittenFiles = std::vector<std::pair<std::string, std::string>>;  // path, content

// Of one system, in the order given. X.pvd: X.0001.vtp ... and the collection; X.dump: X.contacts.dump and the header
// of the last frame beside it; .vtp: one frame. Times (of a dump: steps) are those of the states if they increase from
// frame to frame, else frames are numbered from 0. Throws InputError where the format has no place for the system.
WrittenFiles film_files(const std::vector<AnyState>& frames, const std::string& path);

}  // namespace isostat
