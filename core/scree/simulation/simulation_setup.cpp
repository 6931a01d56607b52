// How a simulation is put together from its scene.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scree/config/scene_document.hpp"
#include "scree/simulation/scene_filter.hpp"
#include "scree/simulation/scene_machine.hpp"
#include "scree/simulation/simulation_state.hpp"
#include "scree/simulation/stepper_needs.hpp"

namespace scree {
namespace {

SceneModel read_checked(const SceneDocument& document) {
  check_section_names(document);
  return read_scene_model(document);
}

std::string name_of(const SceneModel& model, BodyIndex index) {
  const std::string& name = model.bodies[index].name;
  return name.empty() ? "body " + std::to_string(index) + " (of shape '" + model.bodies[index].shape + "')"
                      : "body '" + name + "'";
}

}  // namespace

Simulation::State::State(const SceneDocument& document, const PluginCatalog& catalog, const SimulationSettings& wanted)
    : settings{wanted}, executor{wanted.threads}, model{read_checked(document)}, parts{make_parts(document, catalog)} {
  time_step = model.simulation.number("time_step");
  end_time = wanted.end_time.value_or(model.simulation.number("end_time"));
  max_speed = model.simulation.number("max_speed");
  count_steps();
  tell_of_shapes();
  feed.fed.resize(model.materials.size());
  feed.removed.resize(model.materials.size());

  for (const Part<Source>& source : parts.sources) source_groups.push_back(find_collision_group(model, source.core));

  services.emplace(SetupContext{model, bodies, parts, executor, time_step, end_time, log, warnings});
  setup_parts();
  assemble_machine(model, log);
  add_scene_bodies();
  machine.emplace(model.machine);
  machine->start(bodies.view());

  std::vector<NarrowPhase*> chain;
  for (const Part<NarrowPhase>& narrow : parts.narrow) chain.push_back(narrow.plugin.get());
  pipeline.emplace(model.shapes, *parts.broad.plugin, std::move(chain), executor);
  fill_filter(model, pipeline->filter());
  exclude_joined(model, pipeline->filter());
  host.emplace(parts, *pipeline, *machine, model.materials, executor, timer);
  host->on_motion([this] { backup.keep(bodies, executor); });
  if (!model.simulation.boolean("allow_overlap")) host->watch_births(births, model.bodies, model.shapes);
  check_stepper_needs(parts, model, *pipeline, bodies.view());
  check_overlap();
}

void Simulation::State::tell_of_shapes() {
  log.insert(log.end(), model.remarks.notes.begin(), model.remarks.notes.end());
  for (const std::string& sentence : model.remarks.warnings) {
    if (std::ranges::find(warnings, sentence) != warnings.end()) continue;  // of a fixed and a moving body of one shape
    warnings.push_back(sentence);
    log.push_back("warning: " + sentence);
  }
}

void Simulation::State::count_steps() {
  constexpr double kMostSteps = 1e12;
  const auto refuse = [&](const char* sentence) {
    char text[160];
    std::snprintf(text, sizeof text, "is %.6g s, %s; the run ends at %.6g s", time_step, sentence, end_time);
    throw model.simulation.error("time_step", text);
  };
  const double wanted = end_time / time_step;
  if (wanted < 1.0 - 1e-9) refuse("longer than the whole run");
  if (!(wanted <= kMostSteps)) refuse("so short that the run would take more than 1e12 steps");
  // The first step that ends at or after the end, to a billionth of a step and the rounding of the quotient: 5 s at
  // 1 ms are 5000 steps.
  last_step = static_cast<std::uint64_t>(std::ceil(wanted - std::max(1e-9, 1e-15 * wanted)));
}

void Simulation::State::setup_parts() {
  const auto setup = [&](const auto& part) {
    services->serve(part.info);
    guarded(part.info, ErrorKind::usage, [&] { part.plugin->setup(*services); });
  };
  for (const auto& part : parts.electric) setup(part);
  for (const auto& part : parts.forces) setup(part);
  for (const auto& part : parts.sources) setup(part);
  for (const auto& part : parts.sinks) setup(part);
  if (parts.law) setup(*parts.law);
  setup(parts.stepper);
  for (const auto& part : parts.observers) {
    services->serve(part.info);
    guarded(part.info, ErrorKind::usage, [&] { part.plugin->setup(*services, settings.results); });
  }
  // After the parts, so that a column has the unit and the initial value that its reader states.
  services->provide_from_scene();
  services->check_attributes();
  services->warn_of_unread();
}

void Simulation::State::add(NewBody body) {
  // What the body says about itself wins over what its material says.
  std::vector<std::pair<AttributeId, double>> values;
  for (const auto& [name, value] : model.materials[body.material].attributes) {
    values.emplace_back(bodies.attributes().id(name), value);
  }
  values.insert(values.end(), body.attributes.begin(), body.attributes.end());
  services->check_body(body, values);
  body.attributes = std::move(values);
  if (body.motion == Motion::dynamic) feed.fed[body.material].add(body.mass);
  bodies.add(body);
}

void Simulation::State::add_scene_bodies() {
  for (const SceneBody& scene_body : model.bodies) {
    NewBody body = scene_body.body;
    if (scene_body.options.has("attributes")) {
      const Options& attributes = scene_body.options.table("attributes");
      for (const std::string& name : attributes.names()) {
        body.attributes.emplace_back(bodies.attributes().id(name), attributes.number(name));
      }
    }
    add(std::move(body));
  }
}

void Simulation::State::check_overlap() {
  if (model.simulation.boolean("allow_overlap")) return;
  const BodyView view = bodies.view();
  const std::vector<Vec3> still(view.size());
  for (const Contact& contact : pipeline->find(view, still, still, 0.0)) {
    // Bodies that are written as touching overlap by rounding; a thousandth of the radius is the solver's own size.
    double radius = 0.0;
    for (const BodyIndex body : {contact.a, contact.b}) {
      if (view.motion[body] == Motion::dynamic)
        radius = radius == 0.0 ? view.radius[body] : std::min(radius, view.radius[body]);
    }
    if (contact.gap >= -1e-3 * radius) continue;
    char depth[32];
    std::snprintf(depth, sizeof depth, "%.3g", -contact.gap);
    throw Error{ErrorKind::usage, model.bodies[contact.b].options.location(),
                name_of(model, contact.a) + " and " + name_of(model, contact.b) + " overlap by " + depth +
                    " m at the start; move one of them, or set simulation.allow_overlap = true"};
  }
}

}  // namespace scree
