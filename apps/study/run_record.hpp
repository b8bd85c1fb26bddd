// What became of a run, kept beside its state as NAME.SEED.run.json: the state does not know what its making cost, nor
// why it ended where it did.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "dem/disks/disks.hpp"
#include "dem/spheres/spheres.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

enum class RunStatus {
  ok,          // every stage met its own end
  unfinished,  // a stage did not; the state is kept
  failed,      // blew up (the last sane state is kept), or could not be run
  pending      // not yet run, or interrupted
};
std::string_view status_name(RunStatus status);

struct RunRecord {
  RunStatus status = RunStatus::pending;
  std::string reason;                 // one line; empty for ok
  std::optional<double> cpu_seconds;  // [s] of stepping, all parts of an interrupted run; none: not known
  std::int64_t steps = 0;
  double time = 0;                       // [T0], triangles [s]
  bool certified = false;                // in equilibrium by the criteria of Sec. II.D
  std::optional<double> solid_fraction;  // Phi
  std::optional<double> z;               // both as in `analyze`; none for triangles
  std::string hash;                      // of the state that it tells of
};

// What can be read off the state itself.
RunRecord record_of(const State<Disks>& state);
RunRecord record_of(const State<TriangleGrains>& state);
RunRecord record_of(const State<Spheres>& state);

void write_record(const RunRecord& record, const std::string& path);
// None if there is no such file, or none that can be understood (a record is no loss: the state is what counts).
std::optional<RunRecord> read_record(const std::string& path);

}  // namespace isostat
