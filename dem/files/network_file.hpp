// Plain-text networks (`.net`): bodies and links of one packing, one item a line, '#' starts a comment.
//
//   cell L1 L2 [L3]               periodic cell; optional, at most once
//   grain ID X Y [Z] R            ID any distinct integer; the centre may lie outside the cell
//   contact I J TYPE [S1 S2 [S3]] TYPE c closed, s sliding, r rolling yielded, sr both, d distant; S the image shift of
//                                 J; without S in a cell the nearest image of J is meant
//   beam I J [S1 S2]              elastic beam between the centres, in the plane; without load as it stands, with the
//                                 stiffnesses of beam_at_rest() (dem/state/beam.hpp)
//
// Lines may come in any order. Contact and beam lines are taken as they stand, touching or not; several images of one
// pair are allowed, the same image twice is a fault (but a beam and a contact may join the same pair). With no contact
// line, contacts are found by touching, between grains that no beam joins.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "dem/state/packing.hpp"

namespace isostat {

template <int D>
struct NetworkFile {
  Packing<D> packing;        // lengths as in the file; mass of the largest grain 1 and equal densities; forces zero
  bool links_given = false;  // the file has contact lines; false: contacts were found by touching
};

// Throws InputError listing the faults with file and line (the first kMaxFaults of them).
// gap_tolerance [length of the file]: grains with a gap up to it touch; none: 1e-9 of the largest radius.
template <int D>
NetworkFile<D> read_network(const std::string& path, std::optional<double> gap_tolerance = std::nullopt);
template <int D>
NetworkFile<D> parse_network(std::string_view text, const std::string& path,
                             std::optional<double> gap_tolerance = std::nullopt);
inline constexpr std::size_t kMaxFaults = 1000;

// What a network is of: says the first line of a grain (by its number of coordinates) or triangle; plane if there is
// none. Networks of triangles: dem/triangles/network_file.hpp.
enum class NetworkKind { plane, space, triangles };
NetworkKind network_kind(const std::string& path);

// Grains and links with 17 significant digits. write_network writes to a temporary name and renames it. Both throw
// InputError if a beam is not that of a network (no column says its stiffness or load), write_network also if the path
// cannot be written.
template <int D>
std::string network_text(const Packing<D>& packing);
template <int D>
void write_network(const std::string& path, const Packing<D>& packing);

}  // namespace isostat
