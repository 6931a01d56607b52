#include "scree/geometry/ply_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <istream>
#include <optional>
#include <sstream>

#include "scree/base/error.hpp"

namespace scree {
namespace {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Format : std::uint8_t { text, little, big };

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> length;  // of a list
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

/// Reads one file.
class PlyReader {
 public:
  PlyReader(std::istream& in, const std::string& name, double scale) : in_{in}, name_{name}, scale_{scale} {}

  TriangleMesh read() {
    read_header();
    for (const Element& element : elements_) {
      if (element.properties.empty()) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) read_item(element);
    }
    for (const Triangle& t : mesh_.triangles) {
      if (std::ranges::max(t) >= mesh_.vertices.size()) fail("a face names a vertex that is not there");
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error{ErrorKind::io, "the mesh file '" + name_ + "' could not be read as a mesh (" + reason +
                                   "); export it again as STL, OBJ or PLY"};
  }
  [[nodiscard]] Type type_of(const std::string& word) const {
    static constexpr std::array<std::array<const char*, 2>, 8> kNames{{{"char", "int8"},
                                                                       {"uchar", "uint8"},
                                                                       {"short", "int16"},
                                                                       {"ushort", "uint16"},
                                                                       {"int", "int32"},
                                                                       {"uint", "uint32"},
                                                                       {"float", "float32"},
                                                                       {"double", "float64"}}};
    for (std::size_t k = 0; k < kNames.size(); ++k) {
      if (word == kNames[k][0] || word == kNames[k][1]) return static_cast<Type>(k);
    }
    fail("its header has the unknown type '" + word + "'");
  }
  void read_header() {
    std::string line;
    const auto next = [&] {
      if (!std::getline(in_, line)) fail("its header does not end");
      if (line.ends_with('\r')) line.pop_back();
    };
    next();
    if (line != "ply") fail("it does not begin with 'ply'");
    for (next(); line != "end_header"; next()) read_header_line(line);
  }
  void read_header_line(const std::string& line) {
    std::istringstream words{line};
    std::string word, name;
    words >> word >> name;
    if (word == "format") {
      if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian") {
        fail("its format '" + name + "' is unknown");
      }
      format_ = name == "ascii" ? Format::text : (name == "binary_big_endian" ? Format::big : Format::little);
    } else if (word == "element") {
      Element element{name, 0, {}};
      if (!(words >> element.count)) fail("an element of its header has no number");
      elements_.push_back(std::move(element));
    } else if (word == "property") {
      if (elements_.empty()) fail("a property of its header belongs to no element");
      Property property;
      std::string type = name;
      if (name == "list") {
        words >> name >> type;
        property.length = type_of(name);
      }
      property.type = type_of(type);
      words >> property.name;
      elements_.back().properties.push_back(std::move(property));
    }
  }

  template <class Number>
  double binary() {
    std::array<char, sizeof(Number)> bytes{};
    if (!in_.read(bytes.data(), sizeof(Number))) fail("it ends early");
    const bool turned = (format_ == Format::big) != (std::endian::native == std::endian::big);
    if (turned) std::ranges::reverse(bytes);
    Number value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
  }
  double number(Type type) {
    if (format_ == Format::text) {
      double value = 0.0;
      if (!(in_ >> value)) fail("it ends early, or has a word where a number belongs");
      return value;
    }
    switch (type) {
      case Type::int8:
        return binary<std::int8_t>();
      case Type::uint8:
        return binary<std::uint8_t>();
      case Type::int16:
        return binary<std::int16_t>();
      case Type::uint16:
        return binary<std::uint16_t>();
      case Type::int32:
        return binary<std::int32_t>();
      case Type::uint32:
        return binary<std::uint32_t>();
      case Type::float32:
        return binary<float>();
      case Type::float64:
        break;
    }
    return binary<double>();
  }
  /// A number that counts something.
  std::uint32_t whole(Type type) {
    const double value = number(type);
    if (!(value >= 0.0 && value < 4294967295.0)) fail("an index or a length is no whole number");
    return static_cast<std::uint32_t>(value);
  }

  void read_item(const Element& element) {
    Vec3 place;
    for (const Property& property : element.properties) {
      if (property.length) {
        read_list(property, element.name == "face" && property.name.starts_with("vertex_ind"));
        continue;
      }
      const double value = number(property.type);
      if (property.name == "x") place.x = value;
      if (property.name == "y") place.y = value;
      if (property.name == "z") place.z = value;
    }
    if (element.name == "vertex") mesh_.vertices.push_back(scale_ * place);
  }
  void read_list(const Property& property, bool is_face) {
    const std::uint32_t length = whole(*property.length);
    std::uint32_t first = 0, last = 0;
    for (std::uint32_t k = 0; k < length; ++k) {
      if (!is_face) {
        (void)number(property.type);
        continue;
      }
      const std::uint32_t corner = whole(property.type);
      if (k == 0) first = corner;
      if (k > 1) mesh_.triangles.push_back({first, last, corner});
      last = corner;
    }
  }

  std::istream& in_;
  const std::string& name_;
  double scale_;
  Format format_ = Format::text;
  std::vector<Element> elements_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_ply(std::istream& in, const std::string& name, double scale) {
  return PlyReader{in, name, scale}.read();
}

}  // namespace scree
