#include "analysis/network/contact_tolerance.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/plain_number.hpp"
#include "dem/state/touching.hpp"

namespace isostat {
namespace {

constexpr int kFirstDecade = -9, kLastDecade = -1, kPerDecade = 2;
constexpr double kDoubtfulPart = 0.2, kDoubtfulChange = 0.1;
constexpr double kBestResolution = 1e-3;  // of the mean radius

template <int D>
ContactTolerance of_packing(Packing<D> packing, double used) {
  ContactTolerance result;
  result.used = used;
  double radius = 0;
  for (const double r : packing.bodies.radius) radius += r / static_cast<double>(packing.bodies.size());
  for (int k = kFirstDecade * kPerDecade; k <= kLastDecade * kPerDecade; ++k)
    result.tolerance.push_back(radius * std::pow(10.0, static_cast<double>(k) / kPerDecade));

  find_contacts(packing, std::max({3 * used, result.tolerance.back()}));
  std::vector<double> gap;
  for (const Link<D>& link : packing.links)
    if (link.kind != LinkKind::beam) gap.push_back(link.gap);
  std::sort(gap.begin(), gap.end());
  const auto within = [&](double tolerance) {
    return std::upper_bound(gap.begin(), gap.end(), tolerance) - gap.begin();
  };
  const auto z = [&](double tolerance) {
    return 2 * static_cast<double>(within(tolerance)) / static_cast<double>(packing.bodies.size());
  };
  for (const double t : result.tolerance) result.contacts.push_back(within(t)), result.z.push_back(z(t));

  double squares = 0;
  const auto found = within(used);
  for (std::ptrdiff_t k = 0; k < found; ++k)
    squares += gap[static_cast<std::size_t>(k)] * gap[static_cast<std::size_t>(k)];
  const double spread = found > 0 ? std::sqrt(squares / static_cast<double>(found)) : 0;
  result.low = used / 3, result.high = std::max({3 * used, used + spread, kBestResolution * radius});
  result.z_used = z(used), result.z_low = z(result.low), result.z_high = z(result.high);
  return result;
}

}  // namespace

bool ContactTolerance::in_doubt() const { return z_high - z_low > std::max(kDoubtfulPart * z_used, kDoubtfulChange); }

ContactTolerance contact_tolerance(const AnalysisInput& input) {
  return input.packing_3d ? of_packing(*input.packing_3d, *input.touching_tolerance)
                          : of_packing(input.packing(), *input.touching_tolerance);
}

std::string contact_warning(const AnalysisInput& input) {
  if (!input.touching_tolerance || input.grains() == 0) return "";
  const ContactTolerance c = contact_tolerance(input);
  if (!c.in_doubt()) return "";
  return "contacts were found by touching, and their number hangs on the gap that still touches: z = " +
         plain_number(c.z_used) + " with --gap-tolerance " + plain_number(c.used) + ", " + plain_number(c.z_low) +
         " with " + plain_number(c.low) + ", " + plain_number(c.z_high) + " with " + plain_number(c.high) +
         "; see counts.z_of_tolerance, and trust only a plateau";
}

}  // namespace isostat
