#include "apps/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "dem/input_error.hpp"
#include "dem/scene/suggestion.hpp"

namespace isostat {
namespace {

constexpr const char* kPlace = "command line";

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number x{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return x;
}

[[noreturn]] void refuse(std::string_view name, const std::string& value, const std::string& rule) {
  throw InputError(kPlace, 0, std::string(name), value, rule);
}

}  // namespace

Arguments::Arguments(int argc, char** argv, std::vector<OptionSpec> options, Usage usage)
    : command_(argv[0]), options_(std::move(options)), usage_(usage) {
  std::vector<Fault> faults;
  const auto fault = [&](const std::string& name, const std::string& value, const std::string& rule) {
    faults.push_back({kPlace, 0, name, value, rule});
  };
  bool only_inputs = false;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (only_inputs || word.size() < 2 || word[0] != '-') {
      inputs_.push_back(word);
      continue;
    }
    if (word == "--help" || word == "-h") throw HelpRequest{help()};
    if (word == "--") {
      only_inputs = true;
      continue;
    }
    const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    const std::string name = word.substr(0, equals);
    const auto spec = std::find_if(options_.begin(), options_.end(), [&](const auto& o) { return o.name == name; });
    if (spec == options_.end()) {
      std::vector<std::string> names;
      for (const OptionSpec& o : options_) names.emplace_back(o.name);
      const std::string hint = did_you_mean(name, names);
      fault(name, "", "unknown option; " + (hint.empty() ? "isostat " + command_ + " --help lists them" : hint));
      continue;
    }
    if (!spec->repeats && has(name)) fault(name, "", "given twice");
    std::string value;
    if (equals != std::string::npos) {
      value = word.substr(equals + 1);
      if (spec->value.empty()) fault(name, value, "takes no value");
    } else if (!spec->value.empty()) {
      if (k + 1 == argc)
        fault(name, "", "needs a value");
      else
        value = argv[++k];
    }
    given_.push_back({name, value});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

std::string Arguments::help() const {
  constexpr std::size_t kColumn = 30;
  std::string text =
      "isostat " + command_ + " " + std::string(usage_.operands) + "\n\n" + std::string(usage_.purpose) + "\n";
  if (!options_.empty()) text += "\nOptions:\n";
  for (const OptionSpec& o : options_) {
    std::string head = "  " + std::string(o.name) + (o.value.empty() ? "" : " " + std::string(o.value));
    head.resize(std::max(head.size() + 2, kColumn), ' ');
    text += head + std::string(o.help) + "\n";
  }
  return text;
}

void Arguments::require_inputs(std::size_t low, std::size_t high, std::string_view what) const {
  if (inputs_.size() >= low && inputs_.size() <= high) return;
  refuse("", inputs_.size() > high ? inputs_[high] : "", "isostat " + command_ + " takes " + std::string(what));
}

std::optional<std::string> Arguments::value(std::string_view name) const {
  const auto last = std::find_if(given_.rbegin(), given_.rend(), [&](const Given& g) { return g.name == name; });
  return last == given_.rend() ? std::nullopt : std::optional(last->value);
}

std::vector<std::string> Arguments::values(std::string_view name) const {
  std::vector<std::string> all;
  for (const Given& g : given_)
    if (g.name == name) all.push_back(g.value);
  return all;
}

std::string Arguments::required(std::string_view name) const {
  const auto given = value(name);
  if (!given) refuse(name, "", "is required");
  return *given;
}

std::optional<double> Arguments::number(std::string_view name) const {
  const auto text = value(name);
  if (!text) return std::nullopt;
  const std::optional<double> x = parse<double>(*text);
  if (!x || !std::isfinite(*x)) refuse(name, *text, "must be a finite number");
  return x;
}

std::optional<std::pair<double, double>> Arguments::two_numbers(std::string_view name, const std::string& rule) const {
  const auto text = value(name);
  if (!text) return std::nullopt;
  const std::size_t comma = text->find(',');
  const auto first = parse<double>(text->substr(0, comma));
  const auto second = comma == std::string::npos ? std::nullopt : parse<double>(text->substr(comma + 1));
  if (!first || !second || !std::isfinite(*first) || !std::isfinite(*second)) refuse(name, *text, rule);
  return std::pair(*first, *second);
}

std::optional<long long> Arguments::integer(std::string_view name, long long low, long long high) const {
  const auto text = value(name);
  if (!text) return std::nullopt;
  const std::optional<long long> x = parse<long long>(*text);
  if (!x || *x < low || *x > high)
    refuse(name, *text, "must be an integer from " + std::to_string(low) + " to " + std::to_string(high));
  return x;
}

std::optional<std::string> Arguments::choice(std::string_view name, std::span<const std::string_view> choices) const {
  auto text = value(name);
  if (!text || std::find(choices.begin(), choices.end(), *text) != choices.end()) return text;
  std::string list;
  for (const std::string_view c : choices) list += (list.empty() ? "" : ", ") + std::string(c);
  refuse(name, *text, "must be one of " + list);
}

}  // namespace isostat
