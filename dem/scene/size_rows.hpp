// The keys of sizes (SizesScene), for the tables of keys of the systems of round bodies.
#pragma once
#include <utility>

#include "dem/scene/key_rows.hpp"

namespace isostat::key_rows {

// Group: where the system's [grains] are in a scene; Drawn: whether sizes are drawn at all, in_words its words;
// largest: what the largest diameter is.
template <auto Group, bool (*Drawn)(const Scene&)>
std::vector<SceneKey> size_rows(std::string_view in_words, std::string_view largest) {
  using G = SizesScene;
  const SceneCondition drawn{Drawn, in_words};
  const SceneCondition ranged{[](const Scene& s) { return Drawn(s) && (s.*Group).law() != SizeLaw::table; },
                              "grains.sizes is not \"table\""};
  const SceneCondition power{[](const Scene& s) {
                               return Drawn(s) &&
                                      ((s.*Group).sizes == SizeLaw::power_law || (s.*Group).sizes == SizeLaw::uniform);
                             },
                             "grains.sizes is \"power-law\", or absent"};
  const SceneCondition bidisperse{[](const Scene& s) { return Drawn(s) && (s.*Group).sizes == SizeLaw::bidisperse; },
                                  "grains.sizes is \"bidisperse\""};
  const SceneCondition lognormal{[](const Scene& s) { return Drawn(s) && (s.*Group).sizes == SizeLaw::lognormal; },
                                 "grains.sizes is \"lognormal\""};
  return {
      {.name = "grains.sizes",
       .field = in<Group, &G::sizes>,
       .choices = names(kSizeLawNames),
       .condition = drawn,
       .meaning =
           "Law of the diameters: uniform between grains.diameter_min and grains.diameter_max; bidisperse, these "
           "two; lognormal or power-law, cut at them; table, as measured, in grains.size_table."},
      {.name = "grains.share_of",
       .field = in<Group, &G::share_of>,
       .choices = names(kShareOfNames),
       .condition = drawn,
       .meaning = "What the law and its shares count: grains by number, or their volume (in the plane their area), as "
                  "sieves do."},
      {.name = "grains.diameter_min",
       .field = in<Group, &G::diameter_min>,
       .unit = "a",
       .range = positive,
       .condition = ranged,
       .meaning = "Smallest diameter."},
      {.name = "grains.diameter_max",
       .field = in<Group, &G::diameter_max>,
       .unit = "a",
       .range = positive,
       .condition = random_start,
       .meaning = largest},
      {.name = "grains.exponent",
       .field = in<Group, &G::exponent>,
       .range = not_negative,
       .absent = "uniform diameters",
       .condition = power,
       .meaning =
           "b of the size distribution N(d) ~ d^-b between the two diameters; given without grains.sizes it makes "
           "them a power law (Eq. 1 of the soft-particles paper has 3.5)."},
      {.name = "grains.large_share",
       .field = in<Group, &G::large_share>,
       .range = from(0, 1),
       .condition = bidisperse,
       .meaning = "Share of the grains that have the larger diameter, to the nearest grain."},
      {.name = "grains.density_ratio",
       .field = in<Group, &G::density_ratio>,
       .range = positive,
       .condition = bidisperse,
       .meaning = "Density of the larger grains over that of the smaller ones."},
      {.name = "grains.log_deviation",
       .field = in<Group, &G::log_deviation>,
       .range = positive,
       .condition = lognormal,
       .meaning = "Standard deviation of ln d."},
      {.name = "grains.median",
       .field = in<Group, &G::median>,
       .unit = "a",
       .range = positive,
       .absent = "root of grains.diameter_min grains.diameter_max",
       .condition = lognormal,
       .meaning = "Median diameter of the log-normal law before it is cut."},
      {.name = "grains.size_table",
       .field = in<Group, &G::size_table>,
       .condition = drawn,
       .meaning =
           "CSV file of a measured distribution: columns diameter, ascending, and share, or passing, the share "
           "that is smaller; optional density, over that of other grains. Diameters in any one unit: the largest "
           "becomes grains.diameter_max. Relative to the directory in which the program runs."},
  };
}

inline constexpr SceneCondition from_file{[](const Scene& s) { return !grains_file(s).empty(); },
                                          "grains.file is given"};

// grains.file and grains.box.
template <auto Group, auto File, auto Box>
std::vector<SceneKey> file_rows() {
  return {
      {.name = "grains.file",
       .field = in<Group, File>,
       .meaning = "A packing to start from instead of random positions: a state, a plain-text network, a CSV or a "
                  "LAMMPS dump (docs/formats.md); relative to the directory in which the program runs. Empty: "
                  "random."},
      {.name = "grains.box",
       .field = in<Group, Box>,
       .unit = "a",
       .range = positive,
       .condition = from_file,
       .meaning = "Edges of the periodic cell of a file that has none, [L1, L2] (in space [L1, L2, L3]); empty: the "
                  "grains of such a file lie free."}};
}

}  // namespace isostat::key_rows
