// SPDX-License-Identifier: Apache-2.0
#include "base/formula.h"

#include "base/text.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace brisance {

namespace {

enum What { constant, x_, y_, z_, plus, minus, times, over, power, negate, first_function };

struct Function {
    const char* name;
    int arguments;
    enum { plain, root, like_argument, comparison, angle } rule;  ///< of dimensions
    double (*f)(double, double);
};
const std::array<Function, 17> functions{{
    {"sqrt", 1, Function::root, [](double a, double) { return std::sqrt(a); }},
    {"exp", 1, Function::plain, [](double a, double) { return std::exp(a); }},
    {"log", 1, Function::plain, [](double a, double) { return std::log(a); }},
    {"sin", 1, Function::plain, [](double a, double) { return std::sin(a); }},
    {"cos", 1, Function::plain, [](double a, double) { return std::cos(a); }},
    {"tan", 1, Function::plain, [](double a, double) { return std::tan(a); }},
    {"sinh", 1, Function::plain, [](double a, double) { return std::sinh(a); }},
    {"cosh", 1, Function::plain, [](double a, double) { return std::cosh(a); }},
    {"tanh", 1, Function::plain, [](double a, double) { return std::tanh(a); }},
    {"besselj0", 1, Function::plain, [](double a, double) { return std::cyl_bessel_j(0, std::abs(a)); }},
    {"besselj1", 1, Function::plain, [](double a, double) { return std::copysign(std::cyl_bessel_j(1, std::abs(a)), a); }},
    {"abs", 1, Function::like_argument, [](double a, double) { return std::abs(a); }},
    {"min", 2, Function::like_argument, [](double a, double b) { return std::fmin(a, b); }},
    {"max", 2, Function::like_argument, [](double a, double b) { return std::fmax(a, b); }},
    {"atan2", 2, Function::angle, [](double a, double b) { return std::atan2(a, b); }},
    {"hypot", 2, Function::like_argument, [](double a, double b) { return std::hypot(a, b); }},
    {"step", 1, Function::comparison, [](double a, double) { return a >= 0 ? 1.0 : 0.0; }},
}};

Dimension scaled(Dimension d, int n) { return {n * d.mass, n * d.length, n * d.time, n * d.temperature}; }
Dimension sum(Dimension a, Dimension b) { return {a.mass + b.mass, a.length + b.length, a.time + b.time, a.temperature + b.temperature}; }

/// Recursive descent; every method returns the dimension of what it has read.
class Parser {
public:
    Parser(std::string_view text, std::vector<Formula::Step>& steps) : text_(text), steps_(steps) {}

    Dimension parse() {
        const Dimension d = terms();
        if (peek() != '\0') fail("'" + std::string(text_.substr(at_)) + "' is not understood");
        return d;
    }

private:
    [[noreturn]] void fail(const std::string& problem) const { throw std::invalid_argument("in the formula " + in_quotes(text_) + ": " + problem); }
    char peek() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    void emit(int what, double value = 0) { steps_.push_back({what, value}); }
    static bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
    static bool digit(char c) { return c >= '0' && c <= '9'; }

    Dimension terms() {
        if (++depth_ > 50) fail("too many brackets");
        Dimension d = factors();
        for (char c = peek(); c == '+' || c == '-'; c = peek()) {
            ++at_;
            alike(d, factors(), c == '+' ? "added" : "subtracted");
            emit(c == '+' ? plus : minus);
        }
        --depth_;
        return d;
    }
    Dimension factors() {
        Dimension d = sign();
        for (char c = peek(); c == '*' || c == '/'; c = peek()) {
            ++at_;
            d = sum(d, scaled(sign(), c == '*' ? 1 : -1));
            emit(c == '*' ? times : over);
        }
        return d;
    }
    Dimension sign() {
        if (++depth_ > 50) fail("too many signs and brackets");
        const bool minus_sign = take('-');
        if (!minus_sign) take('+');
        const Dimension d = minus_sign ? sign() : raised();
        if (minus_sign) emit(negate);
        --depth_;
        return d;
    }
    Dimension raised() {
        const Dimension base = atom();
        if (!take('^')) return base;
        const std::size_t first = steps_.size();
        if (sign() != dimension::none) fail("an exponent has to be a number without unit");
        Dimension result;
        if (base != dimension::none) {
            const double n = steps_.back().value;
            if (steps_.size() != first + 1 || steps_.back().what != constant || n != std::round(n) || std::abs(n) > 9)
                fail("a quantity with a unit can only be raised to a whole number");
            result = scaled(base, static_cast<int>(n));
        }
        emit(power);
        return result;
    }
    Dimension atom() {
        const char c = peek();
        if (take('(')) {
            const Dimension d = terms();
            if (!take(')')) fail("a bracket is not closed");
            return d;
        }
        if (digit(c) || c == '.') return quantity();
        if (letter(c)) return name();
        fail(c == '\0' ? "it ends too early" : "'" + std::string(text_.substr(at_)) + "' is not understood");
    }
    /// A number and, as far as what follows is one, its unit.
    Dimension quantity() {
        const std::size_t begin = at_;
        while (digit(look(at_)) || look(at_) == '.') ++at_;
        if ((look(at_) == 'e' || look(at_) == 'E') && (digit(look(at_ + 1)) || ((look(at_ + 1) == '-' || look(at_ + 1) == '+') && digit(look(at_ + 2))))) {
            at_ += 2;
            while (digit(look(at_))) ++at_;
        }
        std::size_t end = at_;
        std::optional<Quantity> best = read(begin, end);
        if (!best) fail("'" + std::string(text_.substr(begin, end - begin)) + "' is no number");
        std::size_t next = at_;
        while (look(next) == ' ') ++next;
        while (letter(look(next)) || look(next) == '%') {
            while (letter(look(next)) || look(next) == '%') ++next;
            while (digit(look(next))) ++next;
            const std::optional<Quantity> longer = look(next) == '(' ? std::nullopt : read(begin, next);
            if (!longer) break;
            best = longer;
            end = next;
            if (look(next) == '*' || look(next) == '/') ++next;
        }
        at_ = end;
        emit(constant, best->value);
        return best->dimension;
    }
    char look(std::size_t at) const { return at < text_.size() ? text_[at] : '\0'; }
    std::optional<Quantity> read(std::size_t begin, std::size_t end) const {
        try {
            return read_quantity(text_.substr(begin, end - begin));
        } catch (const std::invalid_argument&) {
            return {};
        }
    }
    Dimension name() {
        const std::size_t begin = at_;
        while (letter(look(at_)) || digit(look(at_))) ++at_;
        const std::string word(text_.substr(begin, at_ - begin));
        if (word == "x" || word == "y" || word == "z") {
            emit(word == "x" ? x_ : word == "y" ? y_ : z_);
            return dimension::length;
        }
        if (word == "pi") {
            emit(constant, std::numbers::pi);
            return dimension::none;
        }
        std::vector<std::string> known{"x", "y", "z", "pi"};
        for (std::size_t f = 0; f < functions.size(); ++f) {
            known.emplace_back(functions[f].name);
            if (word == functions[f].name) return call(static_cast<int>(f));
        }
        try {  // a unit alone: "y/us"
            const Quantity unit = read_quantity("1 " + word);
            emit(constant, unit.value);
            return unit.dimension;
        } catch (const std::invalid_argument&) {
        }
        fail("unknown name '" + word + "'" + did_you_mean(word, known) + "; there are: " + joined(known));
    }
    Dimension call(int f) {
        const Function& function = functions[static_cast<std::size_t>(f)];
        const std::string name = function.name;
        if (!take('(')) fail(name + " needs its argument in brackets");
        Dimension d = terms();
        if (function.arguments == 2) {
            if (!take(',')) fail(name + " takes two arguments, with a comma between them");
            alike(d, terms(), "given to " + name);
        }
        if (!take(')')) fail("the bracket of " + name + " is not closed");
        emit(first_function + f);
        if (function.rule == Function::plain && d != dimension::none) fail(name + " takes a number without unit, and this is a " + dimension_name(d));
        if (function.rule == Function::root) {
            if (d.mass % 2 || d.length % 2 || d.time % 2 || d.temperature % 2) fail("there is no root of a " + dimension_name(d));
            return {d.mass / 2, d.length / 2, d.time / 2, d.temperature / 2};
        }
        return function.rule == Function::like_argument ? d : dimension::none;
    }
    void alike(Dimension a, Dimension b, const std::string& how) const {
        if (a != b) fail("a " + dimension_name(a) + " and a " + dimension_name(b) + " can not be " + how);
    }

    std::string_view text_;
    std::vector<Formula::Step>& steps_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

Formula::Formula(std::string_view text, Dimension wanted) {
    const Dimension have = Parser(text, steps_).parse();
    if (have != wanted)
        throw std::invalid_argument("the formula " + in_quotes(text) + " is a " + dimension_name(have) + "; wanted is a " + dimension_name(wanted) + " such as \"" +
                                    dimension_example(wanted) + "\"");
}

double Formula::operator()(double x, double y, double z) const {
    std::vector<double> stack;
    stack.reserve(steps_.size());
    const auto pop = [&] {
        const double top = stack.back();
        stack.pop_back();
        return top;
    };
    for (const Step& s : steps_) {
        if (s.what == constant) stack.push_back(s.value);
        else if (s.what == x_) stack.push_back(x);
        else if (s.what == y_) stack.push_back(y);
        else if (s.what == z_) stack.push_back(z);
        else if (s.what == negate) stack.back() = -stack.back();
        else if (s.what >= first_function) {
            const Function& f = functions[static_cast<std::size_t>(s.what - first_function)];
            const double b = f.arguments == 2 ? pop() : 0.0;
            stack.back() = f.f(stack.back(), b);
        } else {
            const double b = pop(), a = stack.back();
            stack.back() = s.what == plus ? a + b : s.what == minus ? a - b : s.what == times ? a * b : s.what == over ? a / b : std::pow(a, b);
        }
    }
    return stack.back();
}

}  // namespace brisance
