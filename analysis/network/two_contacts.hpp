// Grains with two loaded contacts: forces along the line through the contact points, and Eq. 20 of Gilabert 2007.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// One of the two contacts of such a grain. Without rolling moment both forces act along the line through the contact
// points (Fig. 16), so that |T/N| = cot(gamma/2), gamma the angle that the contacts span at the centre. If the two
// neighbours touch each other that is Eq. 20, sqrt(R (R1 + R2 + R)/(R1 R2)) (up to overlaps, which it does not know).
struct TwoContact {
  std::int32_t grain = 0, neighbour = 0, other = 0;  // bodies
  std::int32_t link = 0;                             // grain to neighbour
  bool touching = false;                             // the two neighbours touch
  double ratio = 0;                                  // |T/N|
  double predicted = 0;                              // Eq. 20 if touching, else cot(gamma/2)
};

// Two lines a grain, in order of the grains. Loaded is what bears a total force above `loaded`; grains with a loaded
// link that is no contact, with a wall, or with both contacts with one neighbour are left out.
template <int D>
std::vector<TwoContact> two_contacts(const Packing<D>& packing, double loaded);

}  // namespace isostat
