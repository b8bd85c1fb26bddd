// isostat analyze INPUT... : what the report holds is analysis/report.hpp; here are only arguments and files.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "analysis/ensemble.hpp"
#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "analysis/report_text.hpp"
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
  Analysis(const AnalysisOptions& options, std::vector<std::string> only, bool with_tables)
      : options_(options), only_(std::move(only)), with_tables_(with_tables) {}

  void add(const std::string& path) {
    try {
      line_.begins(path + ": reading");
      options_.begins = [this, path](std::string_view section) { line_.begins(path + ": " + std::string(section)); };
      const AnalysisInput input = load_input(path, options_);
      reports_.push_back(analyze(input, options_, only_));
      if (with_tables_) add_tables(input);
    } catch (const InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
    }
  }
  nlohmann::ordered_json report() const {
    if (!faults_.empty()) throw InputError(faults_);
    return merge_reports(reports_);
  }
  const std::vector<std::pair<std::string, std::string>>& tables() const { return tables_; }

 private:
  void add_tables(const AnalysisInput& input) {
    const auto number = std::to_string(reports_.size());
    for (const Section& section : sections()) {
      if (!section.tables || !reports_.back().contains(std::string(section.name))) continue;
      for (const Table& table : section.tables(input, options_))
        tables_.emplace_back(std::string(section.name) + "." + table.name + "." + number + ".csv", table_as_csv(table));
    }
  }
  AnalysisOptions options_;
  std::vector<std::string> only_;
  bool with_tables_;
  std::vector<nlohmann::ordered_json> reports_;
  std::vector<std::pair<std::string, std::string>> tables_;
  std::vector<Fault> faults_;
  WorkLine line_;
};

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
       {"--law", "LAW", "friction, frictionless or rolling; default: the state's own (a network: friction)"},
       {"--cell", "fixed|free", "free adds the diagonal strains of the cell to the degrees of freedom"},
       {"--gap-tolerance", "LENGTH", "gap up to which grains touch (contacts of grain lists; closing of pores)"},
       {"--stiffness", "K_N[,K_T[,K_R]]", "stiffness, moduli, modes: of contacts, of a packing without a law"},
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

  const auto json_path = arguments.value("--json"), csv_directory = arguments.value("--csv");
  FileRule rule;
  for (const std::string& path : arguments.inputs()) rule.reads("INPUT", path);
  rule.writes("--json", json_path.value_or(""));
  rule.require();
  if (json_path && *json_path != "-") require_writable(*json_path);
  Analysis analysis(options, only, csv_directory.has_value());
  for (const std::string& path : arguments.inputs()) analysis.add(path);
  const nlohmann::ordered_json report = analysis.report();

  std::vector<std::pair<std::string, std::string>> files;
  if (json_path && *json_path != "-") files.emplace_back(*json_path, json_text(report, 1));
  if (csv_directory) {
    std::error_code error;
    std::filesystem::create_directories(*csv_directory, error);
    if (error) throw InputError(*csv_directory, 0, "--csv", "", "cannot be made: " + error.message());
    for (const auto& source : {report_as_csv(report), analysis.tables()})
      for (const auto& [name, content] : source)
        files.emplace_back((std::filesystem::path(*csv_directory) / name).string(), content);
  }
  for (const auto& [path, content] : files)
    if (path != json_path) rule.writes("--csv", path);
  rule.require();
  write_files_atomically(files);
  if (json_path == "-")
    std::cout << json_text(report, 1);
  else if (!json_path)
    std::cout << report_as_text(report);
  return exit_done;
}

}  // namespace isostat
