// Parameter: the description of one setting, as data.
//
// A plugin states its settings once, as a list of Parameters. Parsing, unit conversion, range checks, messages about
// unknown keys, `scree plugins show`, the JSON Schema and the printed defaults all come from that list.
//
//     Parameter::number("radius", "m", "outer radius of the roll").above(0.0)
//     Parameter::vector("acceleration", "m/s2", "of free fall").by_default(Vec3{0, 0, -9.81})
//     Parameter::choice("law", {"stokes", "schiller_naumann"}, "drag coefficient").by_default("stokes")
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "scree/math/vec3.hpp"

namespace scree {

/// What a setting holds.
enum class ValueKind {
  boolean,
  integer,
  number,  ///< a TOML number in SI, or a string with a unit such as "35 kV"
  text,
  choice,    ///< one of a list of words
  path,      ///< a file, relative to the scene that names it
  vector,    ///< three numbers with one unit
  numbers,   ///< a list of numbers with one unit
  texts,     ///< a list of strings
  table,     ///< a nested table with members of its own
  tables,    ///< a list of such tables
  variant,   ///< a table whose `type` chooses the members, for example a size distribution
  variants,  ///< a list of such tables
  columns,   ///< a table of free keys, each a variant or a number: for example body attributes by name
};

struct Variant;

/// One setting: name, kind, unit, default, range and a line of help.
class Parameter {
 public:
  using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3, std::vector<double>,
                             std::vector<std::string>>;

  static Parameter boolean(std::string name, std::string help);
  static Parameter integer(std::string name, std::string help);
  static Parameter number(std::string name, std::string unit, std::string help);
  static Parameter text(std::string name, std::string help);
  static Parameter choice(std::string name, std::vector<std::string> words, std::string help);
  static Parameter path(std::string name, std::string help);
  static Parameter vector(std::string name, std::string unit, std::string help);
  static Parameter numbers(std::string name, std::string unit, std::string help);
  static Parameter texts(std::string name, std::string help);
  static Parameter table(std::string name, std::vector<Parameter> members, std::string help);
  static Parameter tables(std::string name, std::vector<Parameter> members, std::string help);
  static Parameter variant(std::string name, std::vector<Variant> variants, std::string help);
  static Parameter variants(std::string name, std::vector<Variant> variants, std::string help);
  static Parameter columns(std::string name, std::vector<Variant> variants, std::string unit, std::string help);

  /// The value that holds when the scene is silent; without one, and not optional, the setting is required. A table
  /// whose members all have defaults may be left out. The default of a variant is its shorthand's value or a `type`.
  /// @throws std::logic_error when the value is of another kind.
  Parameter by_default(Value value) &&;
  Parameter by_default(double value) &&;
  Parameter by_default(int value) &&;
  Parameter by_default(bool value) &&;
  Parameter by_default(const char* value) &&;
  /// The setting may be absent; Options::has() tells.
  Parameter optional() &&;
  /// Smallest and largest valid value, in the parameter's SI unit.
  Parameter at_least(double smallest) &&;
  Parameter at_most(double largest) &&;
  /// Values must be strictly greater than `bound`, in the parameter's SI unit.
  Parameter above(double bound) &&;
  /// A list must have exactly this many entries.
  Parameter with_count(int entries) &&;
  /// A list must have this many entries or more.
  Parameter with_at_least_count(int entries) &&;
  /// A plain number stands for the variant `type` with its member `member` set: `size = "3 mm"`.
  Parameter with_shorthand(std::string type, std::string member) &&;

  std::string name;
  ValueKind kind = ValueKind::number;
  std::string unit = "1";  ///< SI unit of numbers, vectors and lists; "1" for none
  std::string help;
  Value default_value;  ///< monostate: none
  bool required = true;
  double minimum = -std::numeric_limits<double>::infinity();  ///< [unit of the parameter]
  double maximum = std::numeric_limits<double>::infinity();   ///< [unit of the parameter]
  bool minimum_excluded = false;
  int count = -1;                     ///< required length of a list, -1 for any
  int minimum_count = 0;              ///< smallest length of a list
  std::vector<std::string> words;     ///< of a choice
  std::vector<Parameter> members;     ///< of a table
  std::vector<Variant> alternatives;  ///< of a variant
  std::string shorthand_type;         ///< variant that a plain number stands for, or empty
  std::string shorthand_member;
};

/// One alternative of a variant: the value of `type`, and the members that go with it.
struct Variant {
  std::string type;
  std::string help;
  std::vector<Parameter> members;
};

// Here, and not in the class: a Parameter is complete only once Variant is.
inline Parameter Parameter::by_default(double value) && { return std::move(*this).by_default(Value{value}); }
inline Parameter Parameter::by_default(int value) && { return std::move(*this).by_default(Value{std::int64_t{value}}); }
inline Parameter Parameter::by_default(bool value) && { return std::move(*this).by_default(Value{value}); }
inline Parameter Parameter::by_default(const char* value) && {
  return std::move(*this).by_default(Value{std::string{value}});
}

}  // namespace scree
