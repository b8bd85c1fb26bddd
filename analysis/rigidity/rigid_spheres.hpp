// Exact contraction of spheres into rigid bodies, before the elimination of the whole. Glue only:
//
//   a contact with rolling resistance glues its two grains;
//   two bodies that share three contact points with friction, not on a line, are one rigid body;
//   what is rigid in a part of the network, with fewer links, is rigid in the whole: patches of a few dozen
//   neighbouring bodies are eliminated by themselves, and those of their bodies that move alike in two random null
//   vectors are glued.
//
// All of it modulo a prime: points that differ there differ, and bodies that move apart in some null vector move alike
// in two random ones with a chance of p^-2. The parts grow: bodies made by one pass are bodies of the next one's
// patches. Image shifts are carried along; in a patch only links between the images at hand take part.
#pragma once
#include "analysis/input.hpp"
#include "analysis/rigidity/rigid_bodies.hpp"
#include "analysis/sphere_network.hpp"

namespace isostat {

// Frictionless spheres are points and stay bodies of their own. Held bodies are one body.
RigidBodiesOf<3> contract_rigid_bodies(const SphereNetwork& network, NetworkLaw law);

}  // namespace isostat
