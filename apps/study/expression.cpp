#include "apps/study/expression.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace isostat {
namespace {

constexpr int kDeepest = 200;  // parentheses and signs inside each other

constexpr std::pair<std::string_view, double (*)(double)> kFunctions[] = {
    {"log", [](double x) { return std::log(x); }}, {"log10", [](double x) { return std::log10(x); }},
    {"exp", [](double x) { return std::exp(x); }}, {"sqrt", [](double x) { return std::sqrt(x); }},
    {"abs", [](double x) { return std::abs(x); }},
};

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_of_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '.'; }

}  // namespace

// Recursive descent: sum of products of signed powers.
class Expression::Reader {
 public:
  Reader(std::string_view text, Expression& into) : text_(text), into_(into) {}

  void read() {
    sum();
    if (at_ < text_.size()) fail("unexpected '" + std::string(1, text_[at_]) + "'");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(what + " at character " + std::to_string(at_ + 1));
  }
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void add(Op op) { into_.steps_.push_back({op}); }

  void sum() {
    if (++depth_ > kDeepest) fail("too many parentheses");
    product();
    while (true) {
      if (take('+'))
        product(), add(Op::add);
      else if (take('-'))
        product(), add(Op::subtract);
      else
        break;
    }
    --depth_;
  }
  void product() {
    sign();
    while (true) {
      if (take('*'))
        sign(), add(Op::multiply);
      else if (take('/'))
        sign(), add(Op::divide);
      else
        break;
    }
  }
  void sign() {
    bool negative = false;
    while (peek() == '-' || peek() == '+') negative ^= text_[at_++] == '-';
    power();
    if (negative) add(Op::negate);
  }
  void power() {
    operand();
    if (!take('^')) return;
    if (++depth_ > kDeepest) fail("too many powers");
    sign();  // from right to left, and 2^-1 is a half
    --depth_;
    add(Op::power);
  }
  void operand() {
    const char c = peek();
    if (take('(')) {
      sum();
      if (!take(')')) fail("')' is missing");
    } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      double value = 0;
      const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
      if (error != std::errc{}) fail("no number");
      at_ = static_cast<std::size_t>(end - text_.data());
      into_.steps_.push_back({Op::number, value});
    } else if (begins_name(c)) {
      name();
    } else {
      fail(c ? "unexpected '" + std::string(1, c) + "'" : "something is missing");
    }
  }
  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_of_name(text_[at_])) ++at_;
    const std::string word(text_.substr(begin, at_ - begin));
    if (take('(')) {
      const auto known =
          std::find_if(std::begin(kFunctions), std::end(kFunctions), [&](const auto& f) { return f.first == word; });
      if (known == std::end(kFunctions)) fail("no function " + word + "; there are log, log10, exp, sqrt, abs");
      sum();
      if (!take(')')) fail("')' is missing");
      into_.steps_.push_back({Op::call, 0, 0, known->second});
      return;
    }
    const auto found = std::find(into_.names_.begin(), into_.names_.end(), word);
    into_.steps_.push_back({Op::name, 0, static_cast<std::size_t>(found - into_.names_.begin())});
    if (found == into_.names_.end()) into_.names_.push_back(word);
  }

  std::string_view text_;
  Expression& into_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(std::string_view text) { Reader(text, *this).read(); }

double Expression::evaluate(const std::function<double(const std::string&)>& value) const {
  std::vector<double> stack;
  const auto pop = [&stack] {
    const double x = stack.back();
    stack.pop_back();
    return x;
  };
  for (const Step& step : steps_) {
    switch (step.op) {
      case Op::number:
        stack.push_back(step.number);
        break;
      case Op::name:
        stack.push_back(value(names_[step.name]));
        break;
      case Op::negate:
        stack.back() = -stack.back();
        break;
      case Op::call:
        stack.back() = step.function(stack.back());
        break;
      case Op::add:
      case Op::subtract:
      case Op::multiply:
      case Op::divide:
      case Op::power: {
        const double right = pop(), left = pop();
        stack.push_back(step.op == Op::add        ? left + right
                        : step.op == Op::subtract ? left - right
                        : step.op == Op::multiply ? left * right
                        : step.op == Op::divide   ? left / right
                                                  : std::pow(left, right));
        break;
      }
    }
  }
  return stack.back();
}

}  // namespace isostat
