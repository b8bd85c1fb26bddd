// Arithmetic on the columns of a study: + - * / ^, parentheses, numbers, names (moduli.shear), and log, log10, exp,
// sqrt, abs of an expression. Read once, evaluated for many samples.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

class Expression {
 public:
  // Throws std::invalid_argument saying what is wrong and where.
  explicit Expression(std::string_view text);

  const std::vector<std::string>& names() const { return names_; }  // that it needs, each once
  // value: of a name; NaN makes the result one.
  double evaluate(const std::function<double(const std::string&)>& value) const;

 private:
  enum class Op { number, name, negate, add, subtract, multiply, divide, power, call };
  struct Step {  // in reverse Polish order
    Op op;
    double number = 0;
    std::size_t name = 0;
    double (*function)(double) = nullptr;
  };
  class Reader;

  std::vector<Step> steps_;
  std::vector<std::string> names_;
};

}  // namespace isostat
