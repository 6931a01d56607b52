#include "scree/simulation/setup_services.hpp"

#include <algorithm>

#include "scree/config/suggest.hpp"

namespace scree {
namespace {

[[noreturn]] void throw_unknown(const PartInfo& part, std::string_view what, std::string_view name,
                                const std::vector<std::string>& known) {
  throw Error{ErrorKind::usage, part.where,
              part.label() + " asks for the " + std::string{what} + " '" + std::string{name} + "', but the scene has " +
                  list_of(known) + suggestion(name, known)};
}

/// True for parts that write a column while the simulation runs, so that bodies need not bring a value.
bool is_running_part(const std::string& writer) {
  return writer.starts_with(ForceField::kKind) || writer.starts_with(Observer::kKind);
}

}  // namespace

void SetupServices::provide_from_scene() {
  check_attribute_units();
  Attributes& columns = context_.bodies.attributes();
  const Materials& materials = context_.model.materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m) {
    for (const auto& [name, value] : materials[m].attributes) {
      columns.declare({name, "1", "given by materials", 0.0, {"material '" + materials[m].name + "'"}});
    }
  }
  for (const SceneBody& body : context_.model.bodies) {
    if (!body.options.has("attributes")) continue;
    for (const std::string& name : body.options.table("attributes").names()) {
      columns.declare({name, "1", "given by bodies", 0.0, {"body '" + body.name + "'"}});
    }
  }
}

void SetupServices::check_attribute_units() const {
  const Attributes& columns = context_.bodies.attributes();
  const auto check = [&](const Options& options) {
    if (!options.has("attributes")) return;
    const Options& written = options.table("attributes");
    for (const std::string& name : written.names()) {
      if (columns.has(name)) (void)written.number_in(name, columns.info(columns.id(name)).unit);
    }
  };
  for (const NamedOptions& material : context_.model.material_options) check(material.options);
  for (const SceneBody& body : context_.model.bodies) check(body.options);
}

void SetupServices::check_attributes() {
  const Attributes& columns = context_.bodies.attributes();
  for (std::size_t r = 0; r < readers_.size(); ++r) {
    const Reader& reader = readers_[r];
    const AttributeId id = columns.id(reader.attribute);
    const std::vector<std::string>& writers = columns.info(id).writers;
    if (writers.empty()) {
      throw Error{ErrorKind::usage, reader.where,
                  reader.part + " reads the body attribute '" + reader.attribute + "' (" + reader.help +
                      "), which nothing in the scene provides; set it in a material's, a body's or a "
                      "source's `attributes`, or add the part that writes it"};
    }
    if (std::none_of(writers.begin(), writers.end(), is_running_part)) given_.emplace_back(id, r);
  }
}

SourceLocation SetupServices::place_of(const std::string& column) const {
  const auto gives = [&](const Options& options) {
    return options.has("attributes") && std::ranges::count(options.table("attributes").names(), column) > 0;
  };
  for (const NamedOptions& material : context_.model.material_options) {
    if (gives(material.options)) return material.options.table("attributes").location(column);
  }
  for (const SceneBody& body : context_.model.bodies) {
    if (gives(body.options)) return body.options.table("attributes").location(column);
  }
  return {};
}

void SetupServices::warn_of_unread() const {
  const Attributes& columns = context_.bodies.attributes();
  for (AttributeId id = 0; id < columns.count(); ++id) {
    const auto& [name, unit, help, initial, writers] = columns.info(id);
    if (writers.empty() || std::ranges::count(used_, name) > 0) continue;
    const std::string nearest = suggestion(name, used_);
    if (shows_all_ && nearest.empty()) continue;  // wanted for its picture
    const std::string sentence = "the body attribute '" + name + "', given by " + writers[0] + ", is read by no part";
    context_.warnings.emplace_back(Error{ErrorKind::usage, place_of(name), sentence + nearest}.what());
    context_.log.push_back("warning: " + context_.warnings.back());
  }
}

void SetupServices::check_body(const NewBody& body, std::span<const std::pair<AttributeId, double>> values) const {
  if (body.motion != Motion::dynamic) return;
  for (const auto& [id, reader] : given_) {
    const auto is_it = [column = id](const std::pair<AttributeId, double>& value) { return value.first == column; };
    if (std::any_of(values.begin(), values.end(), is_it)) continue;
    throw Error{ErrorKind::usage, "a body of material '" + context_.model.materials[body.material].name +
                                      "' has no value for the attribute '" + readers_[reader].attribute + "', which " +
                                      readers_[reader].part +
                                      " reads; set it in the `attributes` of that material, of the body, or of every "
                                      "family of its source"};
  }
}

const ElectricField& SetupServices::electric_field(std::string_view name) const {
  std::vector<std::string> known;
  for (const Part<ElectricField>& field : context_.parts.electric) {
    if (field.info.name == name) return *field.plugin;
    known.push_back(field.info.name);
  }
  throw_unknown(*part_, "electric_field", name, known);
}

NamedBody SetupServices::body(std::string_view name) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < context_.model.bodies.size(); ++i) {
    const SceneBody& body = context_.model.bodies[i];
    if (!body.name.empty()) known.push_back(body.name);
    // Bodies of the scene are added first and in order, so that their ids are known before they exist.
    if (body.name == name)
      return {static_cast<BodyId>(i), body.body.pose, std::string{context_.model.shapes.name(body.body.shape)}};
  }
  throw_unknown(*part_, "body", name, known);
}

std::vector<std::string> SetupServices::body_names() const {
  std::vector<std::string> names;
  for (const SceneBody& body : context_.model.bodies) names.push_back(body.name);
  return names;
}

std::uint32_t SetupServices::material(std::string_view name) const {
  const std::int64_t index = context_.model.materials.find(name);
  if (index < 0) throw_unknown(*part_, "material", name, context_.model.materials.names());
  return static_cast<std::uint32_t>(index);
}

AttributeId SetupServices::provide_attribute(const AttributeInfo& info) {
  Attributes& columns = context_.bodies.attributes();
  if (columns.has(info.name) && part_->kind == ForceField::kKind) {
    for (const std::string& writer : columns.info(columns.id(info.name)).writers) {
      if (writer.rfind(ForceField::kKind, 0) != 0) continue;
      throw Error{ErrorKind::usage, part_->where,
                  part_->label() + " and " + writer + " both write the body attribute '" + info.name +
                      "'; only one force field may"};
    }
  }
  if (is_running_part(part_->label())) used_.push_back(info.name);
  AttributeInfo signed_info = info;
  signed_info.writers = {part_->label()};
  return columns.declare(signed_info);
}

AttributeId SetupServices::require_attribute(std::string_view name, std::string_view unit, std::string_view help) {
  used_.emplace_back(name);
  readers_.push_back({part_->label(), std::string{name}, std::string{help}, part_->where});
  return context_.bodies.attributes().declare({std::string{name}, std::string{unit}, std::string{help}, 0.0, {}});
}

AttributeId SetupServices::optional_attribute(const AttributeInfo& info) {
  used_.push_back(info.name);
  return context_.bodies.attributes().declare(info);
}

RandomStream SetupServices::random_stream(std::string_view purpose) const {
  const auto seed = static_cast<std::uint64_t>(context_.model.simulation.integer("seed"));
  return {seed, part_->kind + ":" + part_->name + "/" + std::string{purpose}};
}

void SetupServices::claim_result(const std::string& file) {
  // Only a name that the scene wrote itself has a place of its own, and faults.
  const Options* options = nullptr;
  for (const Part<Observer>& observer : context_.parts.observers) {
    const Options::Entry* entry = observer.options.find("file");
    const auto* text = entry == nullptr ? nullptr : std::get_if<std::string>(&entry->value);
    if (&observer.info == part_ && text != nullptr && *text == file) options = &observer.options;
  }
  const auto refuse = [&](const std::string& sentence) {
    if (options != nullptr) throw options->error("file", "is '" + file + "', " + sentence + "; give another `file`");
    throw Error{ErrorKind::usage, part_->where,
                part_->label() + " would write the file '" + file + "', " + sentence + "; give it another `name`"};
  };
  if (const std::string fault = ResultClaims::fault_of(file); !fault.empty()) refuse("which " + fault);
  const std::string other = claims_.claim(part_->label(), file);
  if (!other.empty()) refuse("which " + other + " writes too");
}

void SetupServices::log(std::string_view line) const {
  context_.log.push_back(part_->label() + ": " + std::string{line});
}

}  // namespace scree
