#include "scree/config/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "scree/base/error.hpp"

namespace scree {
namespace {

struct UnitDeleter {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct ConverterDeleter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, UnitDeleter>;
using Converter = std::unique_ptr<cv_converter, ConverterDeleter>;

// UDUNITS keeps its status and its scanner in global variables: one lock for all of its calls.
std::mutex& library_lock() {
  static std::mutex lock;
  return lock;
}

// The unit system, read once; it lives until the process ends. Call under the lock.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  if (system == nullptr)
    throw Error{ErrorKind::io, "the unit database of UDUNITS cannot be read; install the package libudunits2-data"};
  return system;
}

// Words that UDUNITS does not know. Counted things have no dimension.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kAliases{{{"deg", "arc_degree"},
                                                                                  {"rev", "turn"},
                                                                                  {"revs", "turn"},
                                                                                  {"particle", "count"},
                                                                                  {"particles", "count"},
                                                                                  {"grain", "count"},
                                                                                  {"grains", "count"},
                                                                                  {"piece", "count"},
                                                                                  {"pieces", "count"},
                                                                                  {"Ohm", "ohm"},
                                                                                  {"hr", "hour"},
                                                                                  {"rps", "turn/s"}}};

// Part of a unit's name: a letter, '_', '%' or a byte of a UTF-8 character (degree sign, micro, Ohm, superscripts).
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%' || (c & 0x80) != 0;
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The unit as UDUNITS reads it, or nothing where it would find a number, a logarithm or a date in it.
std::optional<std::string> normalised(std::string_view text) {
  std::string result;
  std::size_t i = 0;
  if (text.starts_with("1/")) {
    result = "1/";
    i = 2;
  } else if (text == "1") {
    return "1";
  }
  while (i < text.size()) {
    const char c = text[i];
    if (is_word(c)) {
      const std::size_t begin = i;
      while (i < text.size() && is_word(text[i])) ++i;
      const std::string_view word = text.substr(begin, i - begin);
      const auto* alias = std::ranges::find(kAliases, word, &std::pair<std::string_view, std::string_view>::first);
      if (word == "since" || word == "after" || word == "from" || word == "ref" || word == "lg" || word == "ln")
        return {};
      result += alias == kAliases.end() ? std::string{word} : "(" + std::string{alias->second} + ")";
      // An exponent of one digit may follow: m2, m-2, m^2, m^-2.
      if (i < text.size() && text[i] == '^') result += text[i++];
      const bool negative = i + 1 < text.size() && text[i] == '-' && is_digit(text[i + 1]);
      if (negative) result += text[i++];
      if (i < text.size() && is_digit(text[i])) result += text[i++];
    } else if (c == ' ' || c == '.' || c == '*' || c == '/' || c == '(' || c == ')') {
      result += c;
      ++i;
    } else {
      return {};
    }
    if (result.size() > 200) return {};
  }
  return result;
}

Unit parse_unit(std::string_view text) {
  const std::optional<std::string> readable = normalised(text);
  if (!readable || readable->empty()) return {};
  return Unit{ut_parse(unit_system(), readable->c_str(), UT_UTF8)};
}

ut_status keep_unit(const ut_unit* unit, void* result) {
  *static_cast<Unit*>(result) = Unit{ut_clone(unit)};
  return UT_SUCCESS;
}
ut_status keep_product(const ut_unit* unit, int, const ut_unit* const*, const int*, void* result) {
  return keep_unit(unit, result);
}
ut_status keep_scaled(const ut_unit*, double, const ut_unit* underlying, double, void* result) {
  return keep_unit(underlying, result);
}
ut_status refuse_timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_NOT_SAME_SYSTEM; }
ut_status refuse_logarithm(const ut_unit*, double, const ut_unit*, void*) { return UT_NOT_SAME_SYSTEM; }

// The SI unit of the same dimension, without factor and offset: "m" for "mm", "s-1.rad" for "rpm"; null for dates.
Unit coherent(const ut_unit* unit) {
  static constexpr ut_visitor kVisitor{keep_unit, keep_product, keep_scaled, refuse_timestamp, refuse_logarithm};
  Unit result;
  if (ut_accept_visitor(unit, &kVisitor, &result) != UT_SUCCESS) return {};
  return result;
}

// UDUNITS takes radians for pure numbers and so converts Hz into rad/s; in the SI unit an angle shows.
bool same_dimension(const ut_unit* from, const ut_unit* to) {
  const Unit a = coherent(from);
  const Unit b = coherent(to);
  return a && b && ut_compare(a.get(), b.get()) == 0;
}

// Multiplies by the factor, or divides by its inverse where that is a whole number: "0.7 mm" becomes the double next to
// 0.0007, as if the scene had said so.
double convert(const cv_converter* converter, double value) {
  const double offset = cv_convert_double(converter, 0.0);
  const double factor = cv_convert_double(converter, 1.0) - offset;
  const double inverse = std::round(1.0 / factor);
  if (offset == 0.0 && factor < 1.0 && std::abs(factor * inverse - 1.0) < 1e-15) return value / inverse;
  return cv_convert_double(converter, value);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

[[noreturn]] void refuse(std::string_view text, const std::string& why, std::string_view unit) {
  throw Error{ErrorKind::usage, "\"" + std::string{text.substr(0, 80)} + "\" " + why + "; write for example \"" +
                                    quantity_example(unit) + "\""};
}

// "0,1 s" can only mean one number, "1,234.5 m" and "1,2,3 m" not.
[[noreturn]] void refuse_comma(std::string_view text, std::string_view unit) {
  std::string point{text};
  point[point.find(',')] = '.';
  const std::size_t end = point.find_first_not_of("+-.0123456789");
  const bool plain = std::ranges::count(point.substr(0, end), '.') == 1 && (end == point.npos || point[end] != ',');
  if (!plain) refuse(text, "has a comma, which numbers have not; a point stands before decimals", unit);
  throw Error{ErrorKind::usage,
              "\"" + std::string{text.substr(0, 80)} + "\" has a decimal comma; write \"" + point.substr(0, 80) + "\""};
}

// "a length in m" has no name here: the SI unit names the dimension.
std::string in_unit(std::string_view unit) {
  if (unit == kAnyUnit) return "a quantity";
  return unit == "1" ? std::string{"a number without a dimension"} : "a quantity in " + std::string{unit};
}

}  // namespace

std::string quantity_example(std::string_view unit) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kExamples{{{"m", "3 mm"},
                                                                                            {"s", "0.25 ms"},
                                                                                            {"kg", "5 g"},
                                                                                            {"V", "35 kV"},
                                                                                            {"rad/s", "44.8 rpm"},
                                                                                            {"rad", "30 deg"},
                                                                                            {"1", "50 %"},
                                                                                            {"kg/m3", "2.5 g/cm3"},
                                                                                            {"m/s", "20 cm/s"},
                                                                                            {"N", "5 mN"},
                                                                                            {"Pa", "70 GPa"},
                                                                                            {"C", "2 nC"},
                                                                                            {"V/m", "30 kV/cm"},
                                                                                            {"1/s", "10000 1/s"},
                                                                                            {"kg/s", "36 kg/h"},
                                                                                            {"C/m2", "26 uC/m2"}}};
  if (unit == kAnyUnit) return "2 nC";
  const auto* known = std::ranges::find(kExamples, unit, &std::pair<std::string_view, std::string_view>::first);
  return known == kExamples.end() ? "1.5 " + std::string{unit} : std::string{known->second};
}

double parse_quantity(std::string_view text, std::string_view unit) {
  const std::string_view whole = trimmed(text);
  const std::string_view digits = whole.starts_with('+') ? whole.substr(1) : whole;
  double value = 0.0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (failure == std::errc::result_out_of_range) refuse(whole, "is too large or too small for a number", unit);
  if (failure != std::errc{}) refuse(whole, "is not " + in_unit(unit), unit);
  if (!std::isfinite(value)) refuse(whole, "is not a finite number", unit);
  const std::string_view rest = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  if (rest.size() > 1 && rest[0] == ',' && is_digit(rest[1])) refuse_comma(whole, unit);
  if (rest.empty() && unit != "1" && unit != kAnyUnit)
    refuse(whole, "has no unit where " + in_unit(unit) + " is needed", unit);
  if (rest.empty()) return value;

  const std::lock_guard lock{library_lock()};
  const Unit from = parse_unit(rest);
  if (!from) refuse(whole, "has the unknown unit '" + std::string{rest.substr(0, 80)} + "'", unit);
  const Unit to = unit == kAnyUnit ? coherent(from.get()) : parse_unit(unit);
  if (!to) throw std::logic_error{"a parameter was described with the unknown unit '" + std::string{unit} + "'"};
  if (!same_dimension(from.get(), to.get()))
    refuse(whole,
           "is in " + std::string{rest} + ", which cannot be converted to " +
               (unit == "1" ? std::string{"a number without a dimension"} : std::string{unit}),
           unit);
  const Converter converter{ut_get_converter(from.get(), to.get())};
  const double result = converter ? convert(converter.get(), value) : std::nan("");
  if (!std::isfinite(result)) refuse(whole, "is not a finite number in " + std::string{unit}, unit);
  return result;
}

bool is_unit(std::string_view unit) {
  if (unit == kAnyUnit) return true;
  const std::lock_guard lock{library_lock()};
  return parse_unit(unit) != nullptr;
}

}  // namespace scree
