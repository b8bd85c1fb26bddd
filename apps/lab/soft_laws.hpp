#pragma once

namespace isostat {

// Share of the volume, soft-particles counted as they are filled, that soft-particles have beside grains of one decade
// of sizes (largest over smallest: ratio) of the law N(r) ~ r^-exponent, if they hold the grains of `below` more
// decades.
double soft_share_of(double ratio, double exponent, int below, double solid_fraction);

}  // namespace isostat
