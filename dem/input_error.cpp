#include "dem/input_error.hpp"

namespace isostat {
namespace {

// One line a fault: FILE:LINE: key = value: rule.
std::string message(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) {
    if (!text.empty()) text += '\n';
    text += f.file;
    if (f.line > 0) text += ":" + std::to_string(f.line);
    text += ": ";
    if (!f.key.empty()) text += f.key;
    if (!f.value.empty()) text += (f.key.empty() ? "" : " = ") + f.value;
    if (!f.key.empty() || !f.value.empty()) text += ": ";
    text += f.rule;
  }
  return text;
}

}  // namespace

InputError::InputError(std::vector<Fault> faults) : std::runtime_error(message(faults)), faults_(std::move(faults)) {}

}  // namespace isostat
