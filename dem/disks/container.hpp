// Containers made of disks.
#pragma once
#include <vector>

#include "dem/disks/disks.hpp"

namespace isostat {

struct WallDisk {
  Vec2 position;  // [a]
  GrainPart part;
};

// Disks of diameter container.wall_size that touch or overlap a little, outside the room of the container: its inner
// width, opening or radius is what is left free between their surfaces. A hopper's outlet is closed by a lid.
std::vector<WallDisk> wall_disks(const ContainerScene& container);

// They become the last bodies, with the next ids, at rest where the container is built. Smooth walls are no bodies.
void add_container(State<Disks>& state);

}  // namespace isostat
