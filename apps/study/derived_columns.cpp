#include "apps/study/derived_columns.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

#include "dem/scene/keys.hpp"
#include "dem/scene/suggestion.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

class ColumnMaker {
 public:
  ColumnMaker(const StudyFile& file, Study& study, StudyFaults& faults) : file_(file), study_(study), faults_(faults) {}

  void make() {
    for (const DerivedText& text : file_.derived) {
      const std::string key = "derived." + text.name;
      check_name(text.name, key, text.line);
      if (auto of = expression(text.of, key, text.line)) study_.derived.push_back({text.name, std::move(*of)});
    }
    for (const SlopeText& text : file_.slopes) {
      check_name(text.name, "slope.name", text.line);
      auto x = expression(text.x, "slope.x", text.line), y = expression(text.y, "slope.y", text.line);
      if (text.stages.size() == 1) faults_.add(text.line, "slope.stages", "", "two stages at least");
      for (const std::size_t stage : text.stages)
        for (const ParameterSet& set : study_.sets)
          if (std::find(set.stages.begin(), set.stages.end(), stage) == set.stages.end())
            faults_.add(text.line, "slope.stages", std::to_string(stage), "is not among the stages that are analysed");
      if (x && y) study_.slopes.push_back({text.name, std::move(*x), std::move(*y), text.stages});
    }
    for (const CurveText& text : file_.curves) make_curve(text);
  }

 private:
  void make_curve(const CurveText& text) {
    check_name(text.name, "curve.name", text.line);
    for (const SeriesCurve& c : study_.curves)
      if (c.name == text.name) faults_.add(text.line, "curve.name", quoted_text(text.name), "given twice");
    for (const ParameterSet& set : study_.sets) {
      if (set.scene.output.series.empty())
        faults_.add(text.line, "curve", quoted_text(text.name),
                    "is of the time series, and output.series of row " + set.name + " asks for none");
      if (text.stage >= set.scene.stages.size())
        faults_.add(text.line, "curve.stage", std::to_string(text.stage),
                    "row " + set.name + " has " + std::to_string(set.scene.stages.size()) + " stages, counted from 0");
    }
    auto x = read(text.x, "curve.x", text.line), y = read(text.y, "curve.y", text.line);
    if (x && y) study_.curves.push_back({text.name, text.x, std::move(*x), std::move(*y), text.step, text.stage});
  }

  void check_name(const std::string& name, const std::string& key, int line) {
    const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    if (name.empty()) return;  // missing, told already
    if (!std::all_of(name.begin(), name.end(), allowed) || std::isdigit(static_cast<unsigned char>(name.front())))
      faults_.add(line, key, quoted_text(name), "names a column: letters, digits and _, no digit first");
  }

  std::optional<Expression> expression(const std::string& text, const std::string& key, int line) {
    auto of = read(text, key, line);
    if (of)
      for (const std::string& name : of->names()) check_column(name, key, line);
    return of;
  }
  std::optional<Expression> read(const std::string& text, const std::string& key, int line) {
    if (text.empty()) return std::nullopt;  // missing, told already
    try {
      return Expression(text);
    } catch (const std::invalid_argument& error) {
      faults_.add(line, key, quoted_text(text), error.what());
      return std::nullopt;
    }
  }

  // Which keys a section will have is known when it is computed.
  void check_column(const std::string& name, const std::string& key, int line) {
    std::vector<std::string> known;
    for (const DerivedColumn& c : study_.derived) known.push_back(c.name);
    for (const SceneKey& k : scene_keys()) known.emplace_back(k.name);
    const std::string section = name.substr(0, name.find('.'));
    const auto& sections = study_.analysis.sections;
    if (std::find(known.begin(), known.end(), name) != known.end() ||
        std::find(sections.begin(), sections.end(), section) != sections.end())
      return;
    const std::string hint = did_you_mean(name, known);
    faults_.add(line, key, name,
                "is no column: SECTION.KEY of a section in analyze, a scene key (stage.pressure: of the stage that is "
                "analysed) or a derived column further up" +
                    (hint.empty() ? "" : "; " + hint));
  }

  const StudyFile& file_;
  Study& study_;
  StudyFaults& faults_;
};

}  // namespace

void make_derived_columns(const StudyFile& file, Study& study, StudyFaults& faults) {
  ColumnMaker(file, study, faults).make();
}

}  // namespace isostat
