#include "conformance/subject.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>

#include "scree/config/parameter_text.hpp"
#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "scree/interfaces/force_field.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/sink.hpp"
#include "scree/interfaces/source.hpp"
#include "scree/interfaces/time_stepper.hpp"

namespace scree::test {
namespace {

std::vector<Subject>& all() {
  static std::vector<Subject> list;
  return list;
}

void say(const PluginEntry& entry, const std::string& sentence) {
  std::printf("%s:%s: %s\n", entry.kind.c_str(), entry.name.c_str(), sentence.c_str());
}

// A table with the example of each setting that has to be set.
std::string example_table(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& parameter : parameters) {
    if (has_to_be_set(parameter)) text += example_line(parameter) + "\n";
  }
  return text;
}

// Settings under which the entry can be made.
void find_options(Subject& subject) {
  const std::vector<Parameter>& parameters = subject.entry.parameters;
  const std::string text = example_table(parameters);
  try {
    subject.options = options_from_text(text, parameters);
    const std::unique_ptr<Plugin> plugin = subject.make();
  } catch (const Error& problem) {
    if (text.empty()) {
      subject.options = default_options(parameters);
      subject.failure = problem.what();
      return;
    }
    subject.options.reset();
    say(subject.entry,
        std::string{"no example of its required settings makes it, so only its description is checked: "} +
            problem.what());
  }
}

void try_setup(Subject& subject) {
  try {
    FakeSceneServices services;
    const std::unique_ptr<Plugin> plugin = subject.make();
    set_up(*plugin, subject.entry.kind, services);
  } catch (const Error& problem) {
    subject.needs_scene = true;
    say(subject.entry, std::string{"it needs more of a scene, so it is made, but not set up: "} + problem.what());
  } catch (const std::exception& problem) {
    subject.failure = std::string{"setup() threw what is no scree::Error: "} + problem.what();
  }
}

template <class Interface>
void set_up_as(Plugin& plugin, SceneServices& services) {
  static_cast<Interface&>(plugin).setup(services);
}

}  // namespace

bool has_to_be_set(const Parameter& parameter) {
  if (parameter.kind == ValueKind::table && parameter.required)
    return std::ranges::any_of(parameter.members, has_to_be_set);
  return parameter.required;
}

void set_up(Plugin& plugin, std::string_view kind, FakeSceneServices& services) {
  if (kind == ContactLaw::kKind) set_up_as<ContactLaw>(plugin, services);
  if (kind == ElectricField::kKind) set_up_as<ElectricField>(plugin, services);
  if (kind == ForceField::kKind) set_up_as<ForceField>(plugin, services);
  if (kind == Source::kKind) set_up_as<Source>(plugin, services);
  if (kind == Sink::kKind) set_up_as<Sink>(plugin, services);
  if (kind == TimeStepper::kKind) set_up_as<TimeStepper>(plugin, services);
  if (kind == Observer::kKind) static_cast<Observer&>(plugin).setup(services, {});
}

void load_subjects(const std::string& file) {
  PluginHost host;
  host.load(file);
  for (const PluginEntry* entry : host.entries()) {
    Subject subject{*entry, {}, false, {}};
    find_options(subject);
    if (subject.options && subject.failure.empty()) try_setup(subject);
    all().push_back(std::move(subject));
  }
}

const std::vector<Subject>& subjects() { return all(); }

std::vector<Subject> living_subjects() {
  std::vector<Subject> living;
  for (const Subject& subject : all()) {
    if (subject.options && !subject.needs_scene && subject.failure.empty()) living.push_back(subject);
  }
  return living;
}

std::vector<Subject> living_subjects(std::string_view kind) {
  std::vector<Subject> living = living_subjects();
  std::erase_if(living, [&](const Subject& subject) { return subject.entry.kind != kind; });
  return living;
}

}  // namespace scree::test
