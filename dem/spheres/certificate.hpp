// The criteria of equilibrium of spheres (Gilabert 2007, Sec. II.D, in space), from positions, velocities and static
// link forces. F1 = max(F0, a^2 P).
#pragma once
#include "dem/spheres/spheres.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/certificate.hpp"

namespace isostat {

// [F0] largest of the law's attraction and the imposed stress; 1 if neither acts.
double force_scale(const SphereLaw& law, const ImposedStress<3>& imposed);

// Of links and wall links: what a body bears.
std::vector<BodyLoad3> net_loads(const SpherePacking& packing);

// `finishing` is left at "none". There is no weight of spheres: gravity is 0.
Certificate evaluate_certificate(const SpherePacking& packing, const SphereLaw& law, const ImposedStress<3>& imposed,
                                 const EquilibriumScene& tolerance, double gravity = 0);
Certificate evaluate_certificate(const State<Spheres>& state);  // keeps the state's record of its finishing

// Contacts that carry a force, or with cohesion all of them.
std::size_t loaded_contacts(const State<Spheres>& state);

}  // namespace isostat
