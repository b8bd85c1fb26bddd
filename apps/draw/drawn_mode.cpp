#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/picture_pen.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "apps/analysis_options.hpp"
#include "apps/draw/subjects.hpp"
#include "dem/input_error.hpp"

namespace isostat {

DrawnMode drawn_mode(const Arguments& arguments, const AnalysisInput& input, const RichText& frequency_unit) {
  const auto number = static_cast<int>(arguments.integer("--mode", 1, 1000).value_or(1));
  const auto refuse = [&](const std::string& why) { throw InputError(input.path, 0, "--what", "modes", why); };
  VibrationModes modes;
  try {
    const AnalysisOptions options = reading_options(arguments);
    if (input.has_law() && !options.stiffness.empty())
      throw InputError(input.path, 0, "--stiffness", *arguments.value("--stiffness"),
                       "is for packings without a law, and this one has its own");
    modes = vibration_modes(input.network(), input.network_law({}), law_of(input, options), number, true);
  } catch (const std::length_error& error) {
    refuse(error.what());
  } catch (const FactorisationFailed& error) {
    refuse(error.what());
  }
  if (modes.displacement.size() < static_cast<std::size_t>(number))
    refuse("has " + std::to_string(modes.displacement.size()) + " vibration modes above its " +
           std::to_string(modes.zero_modes) + " zero modes");
  const std::vector<double>& u = modes.displacement.back();
  const std::size_t bodies = input.packing().bodies.size(), per_body = static_cast<std::size_t>(modes.per_body);
  DrawnMode mode{std::vector<Vec2>(bodies), std::vector<double>(bodies), {}};
  for (std::size_t i = 0; i < bodies && (i + 1) * per_body <= u.size(); ++i) {  // those that are held come last
    const std::size_t at = i * per_body;
    mode.displacement[i] = {{u[at], u[at + 1]}};
    if (per_body > 2) mode.rotation[i] = u[at + 2];
  }
  mode.note = rich("`ω`_{" + std::to_string(number) + "} = ") +
              number_with_unit(modes.omega[static_cast<std::size_t>(number - 1)], frequency_unit);
  return mode;
}

}  // namespace isostat
