// isostat lab EXPERIMENT ...: few-body experiments against closed forms, and the speed of the step loop.
#include <string>
#include <string_view>

#include "apps/commands.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/input_error.hpp"

namespace isostat {

int lab_command(int argc, char** argv) {
  struct Experiment {
    std::string_view name;
    int (*run)(int, char**);
  };
  constexpr Experiment experiments[] = {{"pair", lab_pair},
                                        {"cluster", lab_cluster},
                                        {"grain", lab_grain},
                                        {"collide-squares", lab_collide_squares},
                                        {"overlap", lab_overlap},
                                        {"throughput", lab_throughput},
                                        {"soft-particle", lab_soft_particle},
                                        {"soft-laws", lab_soft_laws},
                                        {"soft-packing", lab_soft_packing}};
  std::string list;
  for (const Experiment& e : experiments) {
    if (argc > 1 && e.name == argv[1]) return e.run(argc - 1, argv + 1);
    list += (list.empty() ? "" : ", ") + std::string(e.name);
  }
  if (argc > 1 && std::string_view(argv[1]) == "--help")
    throw HelpRequest{"isostat lab EXPERIMENT ...\n\nFew-body experiments against closed forms: " + list +
                      ".\nisostat lab EXPERIMENT --help says more.\n"};
  throw InputError("command line", 0, "lab", argc > 1 ? argv[1] : "", "one of " + list);
}

}  // namespace isostat
