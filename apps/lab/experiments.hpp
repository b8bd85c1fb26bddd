// The experiments of `isostat lab`, one file each. Each gets the arguments from its own name on and returns the exit
// code. A new one: a file here, its function, and a line in the table of lab.cpp.
#pragma once
#include "apps/arguments.hpp"

namespace isostat {

int lab_pair(int argc, char** argv);
int lab_cluster(int argc, char** argv);
int lab_throughput(int argc, char** argv);
int lab_grain(int argc, char** argv);
int lab_collide_squares(int argc, char** argv);
int lab_overlap(int argc, char** argv);
int lab_soft_particle(int argc, char** argv);
int lab_soft_laws(int argc, char** argv);
int lab_soft_packing(int argc, char** argv);

inline constexpr OptionSpec kJsonOption{"--json", "FILE|-", "where the JSON goes (default -)"};

}  // namespace isostat
