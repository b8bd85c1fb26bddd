// One run of a scene with one seed, from its files to its files: start or resume, series, snapshots, checkpoints, the
// final state. What `pack` and `study` are made of.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/commands.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/scene.hpp"
#include "dem/systems.hpp"

namespace isostat {

struct SampleJob {
  Scene scene;
  std::uint64_t seed = 1;
  std::string output;   // the final state, NAME.h5
  std::string series;   // CSV of the time series; empty: none
  std::string command;  // provenance: what makes this state again
  int threads = 1;
  double max_time = 0;  // [T0], triangles [s]; 0: no limit
  bool resume = false;  // go on from the partial file if there is one
};

struct SampleOutcome {
  ExitCode code = exit_done;          // done, unfinished or interrupted
  bool blew_up = false;               // unfinished by a RunError: the state is the last sane one
  RunOutcome run;                     // empty if the state was there already
  std::vector<std::string> messages;  // for people: what was not met, where to resume
};

// What the caller sees of the run and says to it; any of them may be empty.
struct SampleWatch {
  std::function<bool()> interrupted;
  std::function<void(const Progress&)> progress;
  // The run has ended as `outcome` says; the state is about to be written, as final or (interrupted) as partial.
  std::function<void(const AnyState&, const SampleOutcome&)> ended;
};

// NAME.h5 -> NAME.h5.partial: where a run that has not ended goes on from.
std::string partial_name(const std::string& output);

// NAME.h5 -> NAME.stageK.h5: the state after a stage that is not the last (output.stages).
std::string stage_name(const std::string& output, std::size_t stage);
// What would be lost if this run replaced the file, in words: a finished state that this run does not make again, or
// what is no state. Empty: nothing.
std::string lost_with(const std::string& path, const Scene& scene, std::uint64_t seed, double max_time);

// Throws InputError if a file cannot be read or written, or (resume) if the files there are of another scene or seed.
SampleOutcome run_sample(const SampleJob& job, const SampleWatch& watch);

}  // namespace isostat
