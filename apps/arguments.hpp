// Command line of one subcommand: options declared once, from which parsing, checking and --help follow.
#pragma once
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isostat {

struct OptionSpec {
  std::string_view name;             // with its dashes: "--json", "-o"
  std::string_view value = "VALUE";  // placeholder of its value; empty: a switch
  std::string_view help{};           // one line
  bool repeats = false;              // may be given several times
};

struct Usage {
  std::string_view operands;  // "INPUT... -o FILE"
  std::string_view purpose;   // one sentence
};

// --help was asked for: main prints the text on stdout and exits 0. Nothing else has been checked.
struct HelpRequest {
  std::string text;
};

// Options may stand anywhere, as `--name value` or `--name=value`; after `--` everything is an input; so is a lone `-`.
class Arguments {
 public:
  // argv[0] is the subcommand's own name. Throws InputError listing unknown options, missing values, repeated options,
  // and HelpRequest.
  Arguments(int argc, char** argv, std::vector<OptionSpec> options, Usage usage = {});

  const std::vector<std::string>& inputs() const { return inputs_; }  // what is not an option
  // Throws InputError unless there are low to high inputs; `what` names them: "one state file".
  void require_inputs(std::size_t low, std::size_t high, std::string_view what) const;

  bool has(std::string_view name) const { return value(name).has_value(); }
  std::optional<std::string> value(std::string_view name) const;  // of the last time it was given
  std::vector<std::string> values(std::string_view name) const;
  std::string required(std::string_view name) const;  // InputError if absent

  // InputError if the value is not a finite number / not an integer in range / not one of the choices.
  std::optional<double> number(std::string_view name) const;
  // Two finite numbers with a comma between them; `rule` says in a fault what they are.
  std::optional<std::pair<double, double>> two_numbers(std::string_view name, const std::string& rule) const;
  std::optional<long long> integer(std::string_view name, long long low, long long high) const;
  std::optional<std::string> choice(std::string_view name, std::span<const std::string_view> choices) const;
  std::optional<std::string> choice(std::string_view name, std::initializer_list<std::string_view> choices) const {
    return choice(name, std::span(choices.begin(), choices.size()));
  }

 private:
  struct Given {
    std::string name, value;
  };
  std::string help() const;

  std::string command_;
  std::vector<OptionSpec> options_;
  Usage usage_;
  std::vector<Given> given_;
  std::vector<std::string> inputs_;
};

}  // namespace isostat
