#include "age_sink.hpp"

#include <fmt/format.h>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

AgeSink::AgeSink(const Options& options) : limit_{options.number("age")} {}

std::vector<Parameter> AgeSink::parameters() {
  return {Parameter::number("age", "s", "time after which a body is taken out").above(0.0)};
}

void AgeSink::mark(const BodyView& bodies, double time, std::span<char> remove) {
  SCREE_REQUIRE(remove.size() == bodies.size(), "age sink: one entry per body");
  next_id_.assign(bodies.id.begin(), bodies.id.end());
  next_since_.resize(bodies.size());
  std::size_t known = 0;  // both lists ascend, so that one walk meets every body
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    while (known < id_.size() && id_[known] < bodies.id[i]) ++known;
    next_since_[i] = known < id_.size() && id_[known] == bodies.id[i] ? since_[known] : time;
    // Time is a multiple of the step up to rounding: a body is not kept a step longer because of the last bit.
    const bool old = time - next_since_[i] >= limit_ * (1.0 - 1e-12);
    if (old && bodies.motion[i] == Motion::dynamic) remove[i] = 1;
  }
  id_.swap(next_id_);
  since_.swap(next_since_);
}

std::string AgeSink::reason() const { return fmt::format("older than {:g} s", limit_); }

void AgeSink::save(StateWriter& out) const {
  out.write("id", id_);
  out.write("since", since_);
}

void AgeSink::load(const StateReader& in) {
  id_ = in.integers("id");
  since_ = in.doubles("since");
  if (id_.size() != since_.size()) {
    throw Error{ErrorKind::io, "the checkpoint of the age sink is damaged: its columns differ in length."};
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Sink, scree::AgeSink>("age", "Takes out what has been in the simulation for too long.",
                                           scree::AgeSink::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("sink_age", "1.0.0", &list)};
