// isostat analyze INPUT... : what the report holds is analysis/report.hpp; here are only arguments and files.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "analysis/conditions.hpp"
#include "analysis/ensemble.hpp"
#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "analysis/report_text.hpp"
#include "analysis/stiffness/matrix_files.hpp"
#include "apps/analysis_options.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/file_rule.hpp"
#include "apps/json_output.hpp"
#include "apps/work_line.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

// One report an input, and the rows of its long tables, one file for each; faults of all inputs are listed together.
class Analysis {
 public:
  Analysis(const AnalysisOptions& options, std::vector<std::string> only, bool with_tables, bool with_matrices)
      : options_(options), only_(std::move(only)), with_tables_(with_tables), with_matrices_(with_matrices) {}

  void add(const std::string& path) {
    try {
      line_.begins(path + ": reading");
      options_.begins = [this, path](std::string_view section) { line_.begins(path + ": " + std::string(section)); };
      const AnalysisInput input = load_input(path, options_);
      reports_.push_back(analyze(input, options_, only_));
      if (with_tables_) add_tables(input);
      if (with_matrices_) add_matrices(input);
      compare(input);
    } catch (const InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
    }
  }
  nlohmann::ordered_json report(bool averages) const {
    if (!faults_.empty()) throw InputError(faults_);
    auto merged = merge_reports(reports_);
    if (averages && !mixed_.empty()) merged["warnings"].push_back(mixed_);
    return merged;
  }
  std::string table() const { return reports_as_table(reports_); }
  const std::vector<std::pair<std::string, std::string>>& tables() const { return tables_; }
  const std::vector<std::pair<std::string, std::string>>& matrices() const { return matrices_; }

 private:
  void add_tables(const AnalysisInput& input) {
    const auto number = std::to_string(reports_.size());
    for (const Section& section : sections()) {
      if (!section.tables || !reports_.back().contains(std::string(section.name))) continue;
      for (const Table& table : section.tables(input, options_))
        tables_.emplace_back(std::string(section.name) + "." + table.name + "." + number + ".csv", table_as_csv(table));
    }
  }
  // Under their names, of the k-th input from the second on under k/NAME: programs look for a G.mtx.
  void add_matrices(const AnalysisInput& input) {
    if (const auto why = refusal_of("stiffness", input, options_))
      throw InputError(input.path, 0, "--matrices", "", *why);
    const bool modes = reports_.back().contains("modes") && !reports_.back()["modes"]["omega"].is_null();
    const std::string folder = reports_.size() == 1 ? "" : std::to_string(reports_.size()) + "/";
    for (auto& [name, content] : matrix_files(input, options_, modes))
      matrices_.emplace_back(folder + name, std::move(content));
  }
  void compare(const AnalysisInput& input) {
    const Conditions conditions(input);
    if (!first_) first_ = conditions;
    const std::string difference = first_->difference(conditions);
    if (!difference.empty() && mixed_.empty())
      mixed_ = "the mean is over states of different " + difference + ": " + input.path +
               " is not like the first input; --table gives a row for each";
  }
  AnalysisOptions options_;
  std::vector<std::string> only_;
  bool with_tables_, with_matrices_;
  std::optional<Conditions> first_;
  std::string mixed_;
  std::vector<nlohmann::ordered_json> reports_;
  std::vector<std::pair<std::string, std::string>> tables_, matrices_;
  std::vector<Fault> faults_;
  WorkLine line_;
};

// Of FOLDER, and of folders in it, which are made.
void add_files(std::vector<std::pair<std::string, std::string>>& files, const char* option, const std::string& folder,
               const std::vector<std::pair<std::string, std::string>>& contents) {
  for (const auto& [name, content] : contents) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) throw InputError(folder, 0, option, "", "cannot be made: " + error.message());
    files.emplace_back(path.string(), content);
  }
}

}  // namespace

int analyze_command(int argc, char** argv) {
  std::string names;
  for (const Section& s : sections()) names += (names.empty() ? "" : ",") + std::string(s.name);
  const std::string only_help =
      "sections to compute, among " + names + "; default: all that apply, without modes, bases and dacf";
  const Arguments arguments(
      argc, argv,
      {{"--only", "LIST", only_help},
       {"--json", "FILE", "write the report as JSON; - for stdout (then nothing else is printed)"},
       {"--csv", "DIR", "write the report and the tables behind it as CSV files"},
       {"--table", "FILE.csv", "a row for each input with the numbers of its report, in place of an ensemble"},
       {"--matrices", "DIR", "write G, K and M (and with --only modes the modes) as Matrix Market files"},
       {"--law", "LAW", "friction, frictionless or rolling; default: the state's own (a network: friction)"},
       {"--cell", "fixed|free", "free adds the diagonal strains of the cell to the degrees of freedom"},
       {"--gap-tolerance", "LENGTH", "gap up to which grains touch (contacts of grain lists; closing of pores)"},
       {"--box", "L1,L2[,L3]", "edges of the periodic cell of a file that has none"},
       {"--stiffness", "K_N[,K_T[,K_R]]", "stiffness, moduli, modes: of contacts, of a packing without a law"},
       {"--modes", "N|all", "modes: how many, from the lowest; all: at most 10000 degrees of freedom; default 20"},
       {"--density-of-states", "BINS", "modes: their density in at most so many bins, of packings of any size"},
       {"--moments", "N", "Chebyshev moments of the density of states: its resolution; default 8 a bin"},
       {"--random-vectors", "N", "random vectors of the density of states: its noise; default 16"},
       {"--bins", "WIDTH", "forces: of the bins of N in F1 (default .02), and of N over its mean (default .1)"},
       {"--prestress", "", "modes: those of the full tangent too, geometric term included (not symmetric)"},
       {"--near-null", "", "rigidity: the smallest nonzero singular values also above 20000 degrees of freedom"},
       {"--vectors", "N", "bases: at most N floppy modes and N self-stress states; default 20"},
       {"--k-max", "K", "largest wave number of the scattering intensity"},
       {"--k-window", "K1,K2",
        "scattering: wave numbers that Eqs. 26 and 28 are fitted to; default 2 pi/a at the most"},
       {"--fit-constant", "free|nonnegative|zero", "scattering: the constant of Eq. 28; default free"},
       {"--r-window", "R1,R2", "dacf: distances that Eq. 27 and the mass-radius relation are fitted to"},
       {"--window-scan", "", "scattering, dacf: the fits in other windows, too"},
       {"--pore-size", "R", "pores: whose share of the void is told, those with a radius below R; default a"},
       {"--pore-window", "R1,R2",
        "pores: radii that the exponent of their distribution is fitted to; default from a/2"},
       {"--threshold", "F", "stressed: least force of a stressed link; default F1/100"},
       {"--force", "total|normal", "stressed: of what the threshold is; default total"}},
      {"INPUT...", "Measures what a packing is and what holds it up; several inputs make one ensemble."});
  if (arguments.inputs().empty())
    throw InputError("command line", 0, "INPUT", "", "at least one state, network or foreign packing is needed");
  const AnalysisOptions options = analysis_options(arguments);
  const auto only_text = arguments.value("--only");
  const std::vector<std::string> only = parse_section_names(only_text.value_or(""));
  if (only_text && only.empty())
    throw InputError("command line", 0, "--only", *only_text, "names no section: " + names);

  refuse_options_of_other_sections(arguments, only);

  const auto json_path = arguments.value("--json"), csv_directory = arguments.value("--csv"),
             table_path = arguments.value("--table"), matrices_directory = arguments.value("--matrices");
  if (table_path && (json_path || csv_directory))
    throw InputError("command line", 0, "--table", *table_path,
                     std::string("stands in place of the report; leave out ") + (json_path ? "--json" : "--csv"));
  if (table_path == "-") throw InputError("command line", 0, "--table", "-", "names a file");
  FileRule rule;
  for (const std::string& path : arguments.inputs()) rule.reads("INPUT", path);
  rule.writes("--json", json_path.value_or(""));
  rule.writes("--table", table_path.value_or(""));
  rule.require();
  if (json_path && *json_path != "-") require_writable(*json_path);
  if (table_path) require_writable(*table_path);
  Analysis analysis(options, only, csv_directory.has_value(), matrices_directory.has_value());
  for (const std::string& path : arguments.inputs()) analysis.add(path);
  const nlohmann::ordered_json report = analysis.report(!table_path);

  std::vector<std::pair<std::string, std::string>> files;
  if (table_path) files.emplace_back(*table_path, analysis.table());
  if (json_path && *json_path != "-") files.emplace_back(*json_path, json_text(report, 1));
  if (csv_directory)
    for (const auto& source : {report_as_csv(report), analysis.tables()})
      add_files(files, "--csv", *csv_directory, source);
  const auto own = files.size();
  if (matrices_directory) add_files(files, "--matrices", *matrices_directory, analysis.matrices());
  for (std::size_t k = 0; k < files.size(); ++k)
    if (files[k].first != json_path && files[k].first != table_path)
      rule.writes(k < own ? "--csv" : "--matrices", files[k].first);
  rule.require();
  write_files_atomically(files);
  for (const auto& warning : report.value("warnings", nlohmann::ordered_json::array()))
    std::cerr << "isostat analyze: " << warning.get<std::string>() << '\n';
  if (json_path == "-")
    std::cout << json_text(report, 1);
  else if (!json_path && !table_path)
    std::cout << report_as_text(report);
  return exit_done;
}

}  // namespace isostat
