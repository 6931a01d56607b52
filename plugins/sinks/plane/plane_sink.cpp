#include "plane_sink.hpp"

#include <fmt/format.h>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

PlaneSink::PlaneSink(const Options& options)
    : point_{options.vector("point")}, normal_{normalized(options.vector("normal"))} {
  if (norm(normal_) == 0.0) {
    throw options.error("normal",
                        "is the zero vector; give the direction in which bodies leave, for example "
                        "[0, 0, -1]");
  }
}

std::vector<Parameter> PlaneSink::parameters() {
  return {Parameter::vector("point", "m", "a point of the plane"),
          Parameter::vector("normal", "1", "of the plane, towards the side where bodies leave; any length")};
}

void PlaneSink::mark(const BodyView& bodies, double, std::span<char> remove) {
  SCREE_REQUIRE(remove.size() == bodies.size(), "plane sink: one entry per body");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] == Motion::dynamic && dot(normal_, bodies.position[i] - point_) > 0.0) remove[i] = 1;
  }
}

std::string PlaneSink::reason() const {
  return fmt::format("left through the plane at ({:g}, {:g}, {:g}) m towards ({:g}, {:g}, {:g})", point_.x, point_.y,
                     point_.z, normal_.x, normal_.y, normal_.z);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Sink, scree::PlaneSink>("plane", "Takes out what crosses a plane.",
                                             scree::PlaneSink::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("sink_plane", "1.0.0", &list)};
