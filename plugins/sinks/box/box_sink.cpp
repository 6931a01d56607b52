#include "box_sink.hpp"

#include <fmt/format.h>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

BoxSink::BoxSink(const Options& options)
    : box_{options.vector("lower"), options.vector("upper")}, remove_inside_{options.text("remove") == "inside"} {
  for (int axis = 0; axis < 3; ++axis) {
    if (box_.lower[axis] >= box_.upper[axis]) {
      throw options.error("upper", fmt::format("makes the box empty: along {}, {:g} m is not above {:g} m of 'lower'",
                                               "xyz"[axis], box_.upper[axis], box_.lower[axis]));
    }
  }
}

std::vector<Parameter> BoxSink::parameters() {
  return {Parameter::vector("lower", "m", "corner of the box with the smallest coordinates"),
          Parameter::vector("upper", "m", "corner of the box with the largest coordinates"),
          Parameter::choice("remove", {"outside", "inside"}, "which bodies are taken out").by_default("outside")};
}

void BoxSink::mark(const BodyView& bodies, double, std::span<char> remove) {
  SCREE_REQUIRE(remove.size() == bodies.size(), "box sink: one entry per body");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] == Motion::dynamic && contains(box_, bodies.position[i]) == remove_inside_) remove[i] = 1;
  }
}

std::string BoxSink::reason() const {
  return fmt::format("{} the box from ({:g}, {:g}, {:g}) m to ({:g}, {:g}, {:g}) m",
                     remove_inside_ ? "entered" : "left", box_.lower.x, box_.lower.y, box_.lower.z, box_.upper.x,
                     box_.upper.y, box_.upper.z);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Sink, scree::BoxSink>("box", "Takes out what leaves, or enters, a box.",
                                           scree::BoxSink::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("sink_box", "1.0.0", &list)};
