#include "apps/study/curve_tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/report_text.hpp"
#include "dem/files/atomic_file.hpp"

namespace isostat {
namespace {

using Points = std::vector<CurvePoint>;

std::string number(double x) { return std::isfinite(x) ? csv_field(nlohmann::ordered_json(x)) : ""; }
std::string fields(const Statistic& s) { return number(s.mean) + "," + number(s.sd) + "," + number(s.se); }
std::string with_errors(const std::string& name) { return name + "," + name + "_sd," + name + "_se"; }

// The scene keys that the study sets, as study.csv has them.
std::string header(const Study& study) {
  std::string text;
  for (const std::string& key : study.keys) text += csv_field(key) + ",";
  return text;
}
std::string settings(const Study& study, const ParameterSet& set) {
  std::string text;
  for (const std::string& key : study.keys) text += csv_field(value_of(set, key)) + ",";
  return text;
}

// The columns before `runs` tell curves apart; x is one of them, so that a plot joins the points of a curve. Only an x
// that all samples have reached counts: the mean of those that went furthest would jump where another ends.
std::string lines(const Study& study, const ParameterSet& set, const std::vector<Points>& samples) {
  std::map<double, std::vector<double>> at;
  for (const Points& points : samples)
    for (const CurvePoint& p : points) at[p.x].push_back(p.y);
  std::string text;
  for (const auto& [x, values] : at)
    if (values.size() == samples.size())
      text += csv_field(set.name) + "," + settings(study, set) + number(x) + "," + std::to_string(set.seeds.size()) +
              "," + std::to_string(values.size()) + "," + fields(statistic(values)) + "\n";
  return text;
}

std::string peak_line(const Study& study, const ParameterSet& set, const SeriesCurve& curve,
                      const std::vector<Points>& samples) {
  std::vector<double> peak, place;
  for (const Points& points : samples) {
    if (points.empty()) continue;
    const auto highest = std::max_element(points.begin(), points.end(),
                                          [](const CurvePoint& a, const CurvePoint& b) { return a.y < b.y; });
    peak.push_back(highest->y), place.push_back(highest->x);
  }
  return csv_field(set.name) + "," + curve.name + "," + settings(study, set) + std::to_string(set.seeds.size()) + "," +
         std::to_string(peak.size()) + "," + fields(statistic(peak)) + "," + fields(statistic(place)) + "\n";
}

bool is_name(const std::string& text) {
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.") ==
         std::string::npos;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> curve_tables(const Study& study, const std::vector<StudyRun>& runs,
                                                              const std::vector<RunRecord>& records) {
  std::vector<std::pair<std::string, std::string>> tables;
  if (study.curves.empty()) return tables;
  std::string peaks = "row,curve," + header(study) + "runs,n," + with_errors("peak") + "," + with_errors("at") + "\n";
  for (const SeriesCurve& curve : study.curves)
    tables.emplace_back("curve." + curve.name + ".csv", "row," + header(study) +
                                                            (is_name(curve.x_text) ? curve.x_text : "x") + ",runs,n," +
                                                            with_errors(curve.name) + "\n");
  for (const ParameterSet& set : study.sets) {
    std::vector<std::vector<Points>> samples(study.curves.size());  // a curve, a sample
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (runs[k].set != &set || records[k].status != RunStatus::ok) continue;
      const DataTable series = parse_table(read_whole_file(runs[k].series()), runs[k].series());
      for (std::size_t c = 0; c < samples.size(); ++c) samples[c].push_back(curve_of_sample(study.curves[c], series));
    }
    for (std::size_t c = 0; c < samples.size(); ++c) {
      tables[c].second += lines(study, set, samples[c]);
      peaks += peak_line(study, set, study.curves[c], samples[c]);
    }
  }
  tables.emplace_back("peaks.csv", std::move(peaks));
  return tables;
}

}  // namespace isostat
