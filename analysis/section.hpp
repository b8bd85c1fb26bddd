// A section of the report, and the tables that go with it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/input.hpp"

namespace isostat {

// A table of numbers that goes with a section into `--csv DIR` as DIR/NAME.csv.
struct Table {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

enum class Forces { not_needed, with_prestress, needed };

// Grains of triangles: not at all, any, or those whose overlaps have an energy (not the law `paper`), of which G and K
// are made.
enum class OfTriangles { none, any, with_energy };

// Which inputs a section takes. `analyze` refuses the others, so that no section has to.
struct Takes {
  bool plane = true;   // packings in the plane
  bool space = false;  // packings in space, too
  OfTriangles triangles = OfTriangles::none;
  std::string_view cell_for = {};  // why it needs a periodic cell; empty: it takes isolated packings, too
  Forces forces = Forces::not_needed;
  bool grains = false;     // needs at least one grain
  bool beams = false;      // needs grains that are held together by beams
  bool stiffness = false;  // needs a stiffness for every row of G that --law asks for
  bool strains = false;    // strains the cell: nothing in it may be held
};

// A section: name, and a function from an input that it takes to its JSON value. What cannot be known before it is
// computed (a grid too fine, say) it throws as InputError.
struct Section {
  using Json = nlohmann::ordered_json;
  std::string_view name;
  Takes takes;
  Json (*compute)(const AnalysisInput&, const AnalysisOptions&) = nullptr;
  // Rows too many for the report, computed only for --csv. What the JSON value holds becomes tables by itself.
  std::vector<Table> (*tables)(const AnalysisInput&, const AnalysisOptions&) = nullptr;
  // Curves whose length follows the size of the cell: brings the values of several inputs onto common bins before they
  // are merged entry by entry. False, with the values untouched: they do not line up.
  bool (*align)(std::vector<Json>& values) = nullptr;
  // What is computed from all inputs together and not by averaging: "pooled" of the merged section. Of aligned values.
  Json (*pooled)(const std::vector<Json>& aligned) = nullptr;
  // Long to compute or to read: left out unless it is named.
  bool only_when_named = false;
  // What a reader of the value has to know, in a sentence; empty: nothing. `warnings` of the report.
  std::string (*warning)(const AnalysisInput&) = nullptr;
};
}  // namespace isostat
