#include "apps/study/study_faults.hpp"

#include <algorithm>
#include <utility>

namespace isostat {

bool StudyFaults::is_new(const Fault& f) { return told_.insert({f.file, f.line, f.key, f.value, f.rule}).second; }

void StudyFaults::add(int line, const std::string& key, const std::string& value, const std::string& rule) {
  Fault fault{path_, line, key, value, rule};
  if (is_new(fault)) faults_.push_back(std::move(fault));
}

void StudyFaults::add_of_scene(Fault fault, const std::string& set) {
  if (!is_new(fault)) return;
  fault.rule += " (in " + set + ")";
  faults_.push_back(std::move(fault));
}

void StudyFaults::raise() {
  if (none()) return;
  std::stable_sort(faults_.begin(), faults_.end(), [this](const Fault& a, const Fault& b) {
    return std::pair(a.file != path_, a.line) < std::pair(b.file != path_, b.line);
  });
  throw InputError(faults_);
}

}  // namespace isostat
