// The time series of a run: one CSV row an observation. docs/formats.md lists the columns.
#pragma once
#include <string>

#include "dem/state/state.hpp"

namespace isostat {

std::string series_header(bool energies);
std::string series_row(const State& state, bool energies);  // with its newline, 17 significant digits

}  // namespace isostat
