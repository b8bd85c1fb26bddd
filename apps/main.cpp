// isostat COMMAND ...: dispatch, and the one place where exceptions become exit codes.
#include <fcntl.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/version.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/suggestion.hpp"

namespace isostat {
namespace {

struct Command {
  std::string_view name;
  int (*run)(int argc, char** argv);
  std::string_view purpose;
};

const std::vector<Command>& commands() {
  static const std::vector<Command> list{
      {"pack", pack_command, "run a scene to its final state"},
      {"study", study_command, "parameter sets times seeds: states, and one ensemble row a set"},
      {"lab", lab_command, "few-body experiments against closed forms; speed of the step loop"},
      {"analyze", analyze_command, "counts, equilibrium, stress, forces, percolation, ... of packings"},
      {"compare", compare_command, "what changed from one state to another: contacts, displacements, rigid regions"},
      {"convert", convert_command, "state, network, CSV, LAMMPS dump, XYZ and ParaView files"},
      {"info", info_command, "what a state file is: hash, cell, scene, dimensionless numbers, provenance"},
      {"draw", draw_command, "picture of a packing: grains, forces, pores, clusters, modes; .svg, .pdf, .png"},
      {"plot", plot_command, "curves of a result or table: .svg, .pdf, .png"},
  };
  return list;
}

void print_help(std::ostream& out) {
  out << "Isostat " << version() << ": granular packings, and what holds them up.\n\nisostat COMMAND ...\n\n";
  for (const Command& c : commands()) {
    std::string head = "  " + std::string(c.name);
    head.resize(12, ' ');
    out << head << c.purpose << '\n';
  }
  out << "\nisostat COMMAND --help says more. Exit codes: 0 done, 2 bad input or usage, 3 a stage did not meet its "
         "end,\n"
         "4 internal error, 130 interrupted.\n";
}

int run(int argc, char** argv) {
  if (argc < 2) {
    print_help(std::cerr);
    return exit_bad_input;
  }
  const std::string_view name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    print_help(std::cout);
    return exit_done;
  }
  if (name == "--version") {
    std::cout << "isostat " << version() << '\n';
    return exit_done;
  }
  std::vector<std::string> names;
  for (const Command& c : commands()) {
    if (c.name == name) return c.run(argc - 1, argv + 1);
    names.emplace_back(c.name);
  }
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  const std::string hint = did_you_mean(name, names);
  throw InputError("command line", 0, "", std::string(name),
                   "unknown command; " + (hint.empty() ? std::string() : hint + " ") + "commands: " + list);
}

}  // namespace
}  // namespace isostat

namespace isostat {
namespace {

// Files that are opened must not get the numbers of standard streams that are closed: what is meant for those would go
// into them.
void open_standard_streams() {
  for (int number = 0; number <= 2; ++number)
    if (::fcntl(number, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) < 0) std::_Exit(exit_internal);
}

}  // namespace
}  // namespace isostat

int main(int argc, char** argv) {
  using namespace isostat;
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit is then an error of its writing
  try {
    const int code = run(argc, argv);
    std::cout.flush();
    if (code == exit_done && !std::cout) throw InputError("standard output", 0, "", "", "cannot be written");
    return code;
  } catch (const HelpRequest& help) {
    std::cout << help.text;
    return exit_done;
  } catch (const InputError& error) {
    std::cerr << "isostat: " << error.what() << '\n';
    return exit_bad_input;
  } catch (const std::bad_alloc&) {
    std::cerr << "isostat: not enough memory for this; fewer grains, or a machine with more\n";
    return exit_bad_input;
  } catch (const std::exception& error) {
    std::cerr << "isostat: internal error: " << error.what() << '\n';
    return exit_internal;
  }
}
