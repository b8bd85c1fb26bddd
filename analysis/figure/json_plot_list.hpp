// Plots of JSON results by topic; json_plots() lists them all.
#pragma once
#include <vector>

#include "analysis/figure/plot.hpp"

namespace isostat {

const std::vector<JsonPlot>& structure_plots();
const std::vector<JsonPlot>& network_plots();
const std::vector<JsonPlot>& modes_plots();

}  // namespace isostat
