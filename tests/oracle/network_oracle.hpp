// Slow, obvious references for the network analysis: forces act at contact points, stress is summed pair by pair,
// percolation is decided by walking replicas of the cell.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat::oracle {

struct NetLoad {
  Vec2 force{};
  double moment = 0;
};
// Static force and moment on every body: each link pushes at its contact point, moments by the cross product.
std::vector<NetLoad> net_loads(const Packing<2>& packing);

// Random periodic (or isolated) packing with random links, forces, moments and shifts; nothing balances.
Packing<2> random_packing(std::uint64_t seed, std::size_t grains, std::size_t links, bool periodic);

// Every pair and image with gap <= tolerance, by trying all shifts within `reach` cells. Sorted by (i, j, shift).
std::vector<Link<2>> touching_pairs(const Packing<2>& packing, double tolerance, int reach);

// Do links with force >= threshold percolate along an axis? Tiles (2 reach + 1)^2 copies of the cell, floods from each
// body of the middle copy and looks whether the flood meets another copy of that body displaced along the axis.
std::array<bool, 2> percolates(const Packing<2>& packing, double threshold, int reach);

}  // namespace isostat::oracle
