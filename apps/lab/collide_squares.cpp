// isostat lab collide-squares: energies and spins after the collision of two squares.
#include <nlohmann/json.hpp>
#include <string>

#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/input_error.hpp"
#include "dem/run_error.hpp"
#include "dem/triangles/lab/collide.hpp"

namespace isostat {
namespace {

constexpr double kLeastSpeed = 0.1, kMostSpeed = 500;  // [cm/s] below it takes minutes, above squares pass through

void require(bool good, const char* option, double value, const std::string& rule) {
  if (!good) throw InputError("command line", 0, option, nlohmann::json(value).dump(), rule);
}

lab::CollisionSetup setup_of(const Arguments& args) {
  lab::CollisionSetup setup;
  args.required("--speed");
  setup.speed = *args.number("--speed");
  setup.side = args.number("--side").value_or(setup.side);
  setup.offset = args.number("--offset").value_or(setup.offset);
  setup.damping = args.number("--damping").value_or(setup.damping);
  if (args.choice("--law", kContactLawNames) == "overlap-energy") setup.law = ContactLaw::overlap_energy;
  if (args.choice("--integrator", kIntegratorNames) == "gear") setup.integrator = Integrator::gear;
  setup.step = args.number("--step");
  require(setup.speed >= kLeastSpeed && setup.speed <= kMostSpeed, "--speed", setup.speed, "in [0.1, 500] cm/s");
  require(setup.side >= 0.01 && setup.side <= 10, "--side", setup.side, "in [0.01, 10] cm");
  require(setup.offset > -1 && setup.offset < 1, "--offset", setup.offset,
          "in (-1, 1) sides: beyond, the squares miss each other");
  require(setup.damping >= 0, "--damping", setup.damping, "not negative");
  if (setup.step) {
    const double most = lab::largest_fraction(setup);
    require(*setup.step >= 1e-4 && *setup.step < most, "--step", *setup.step,
            "in [1e-4, " + nlohmann::json(most).dump() + "), where the square is stable");
  }
  return setup;
}

}  // namespace

int lab_collide_squares(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"--speed", "V", "[cm/s] of the left square, along +x; the other rests"},
       {"--law", "paper|overlap-energy", "contact law (default paper)"},
       {"--side", "S", "[cm] (default 0.14)"},
       {"--offset", "O", "[S] by which the left square is higher (default 0.5)"},
       {"--damping", "G", "[g/s] gamma of the beams (default 9)"},
       {"--step", "C", "time step c in dt = c/omega_max; default: halved until the numbers stay, to 1e-3"},
       {"--integrator", "verlet|gear", "default verlet"},
       kJsonOption},
      {"", "Energies and spins after the collision of two squares (Poeschel and Buchholtz 1995, Sec. 6.1)."});
  args.require_inputs(0, 0, "no operand: the speed is --speed V");
  const lab::CollisionSetup setup = setup_of(args);
  lab::Collision c;
  try {
    c = lab::collide_squares(setup);
  } catch (const RunError& error) {
    throw InputError("command line", 0, "--speed", nlohmann::json(setup.speed).dump(),
                     std::string("no result with these arguments: ") + error.what());
  }
  write_json(args, {{"translation", c.translation},
                    {"rotation", c.rotation},
                    {"dissipated", 1 - c.translation - c.rotation},
                    {"omega_first", c.spin_first},
                    {"omega_final", c.spin_final},
                    {"stored", c.stored},
                    {"step", c.step},
                    {"step_change", c.change},
                    {"steps", c.steps},
                    {"cpu_seconds", c.cpu_seconds}});
  return exit_done;
}

}  // namespace isostat
