#include "picture_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/results/output_file.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

namespace {

Projection projection_of(const Options& options) {
  if (options.has("right") != options.has("up")) {
    throw options.error("`right` and `up` belong together; give both, or a named `view`");
  }
  if (options.has("right")) {
    const Vec3 right = options.vector("right"), up = options.vector("up");
    // A direction written with three digits is meant to be a unit vector.
    constexpr double kRounded = 2e-3;
    const bool unit = std::abs(norm(right) - 1.0) < kRounded && std::abs(norm(up) - 1.0) < kRounded;
    if (!unit || std::abs(dot(right, up)) > kRounded) {
      throw options.error("right", "and 'up' must be unit vectors at a right angle");
    }
    const Vec3 exact = normalized(right);
    return {exact, normalized(up - dot(up, exact) * exact)};
  }
  const std::string& view = options.text("view");
  const auto axis = [](char letter) {
    return Vec3{letter == 'x' ? 1.0 : 0.0, letter == 'y' ? 1.0 : 0.0, letter == 'z' ? 1.0 : 0.0};
  };
  return {axis(view[0]), axis(view[1])};
}

std::optional<Window> window_of(const Options& options) {
  if (options.has("lower") != options.has("upper")) {
    throw options.error("`lower` and `upper` belong together; give both corners of the window, or none");
  }
  if (!options.has("lower")) return std::nullopt;
  const std::vector<double>&lower = options.numbers("lower"), &upper = options.numbers("upper");
  const Window window{{lower[0], lower[1]}, {upper[0], upper[1]}};
  constexpr double kMostSlender = 10.0;
  if (!(window.width() > 0.0 && window.height() > 0.0)) {
    throw options.error("upper", "must be greater than 'lower' in both coordinates");
  }
  if (std::max(window.width(), window.height()) > kMostSlender * std::min(window.width(), window.height())) {
    throw options.error("upper", "makes the window too slender; its edges may differ by a factor of 10 at most");
  }
  return window;
}

std::vector<Mark> marks_of(const Options& options, const Projection& projection) {
  std::vector<Mark> marks;
  for (const Options& line : options.tables("line")) {
    marks.push_back({projection(line.vector("from")), projection(line.vector("to")),
                     static_cast<int>(line.integer("divisions")), line.text("label")});
  }
  return marks;
}

}  // namespace

PictureObserver::PictureObserver(const Options& options)
    : options_{options},
      view_{projection_of(options), window_of(options), {}, options.number("velocity_arrows")},
      width_{static_cast<int>(options.integer("width"))},
      at_end_{options.boolean("at_end")},
      svg_{options.boolean("svg")},
      labels_{options.boolean("labels")},
      title_{options.text("title")},
      marks_{marks_of(options, view_.projection)} {
  if (options.has("interval")) interval_ = options.number("interval");
}

std::vector<Parameter> PictureObserver::parameters() {
  std::vector<Parameter> line{Parameter::vector("from", "m", "beginning of the line"),
                              Parameter::vector("to", "m", "end of the line"),
                              Parameter::integer("divisions", "parts that ticks divide the line into; 1: a dashed line")
                                  .at_least(1)
                                  .by_default(1),
                              Parameter::text("label", "written at its beginning").by_default("")};
  std::vector<Parameter> list{
      Parameter::choice("view", {"xy", "xz", "yz"}, "world axes that point to the right and up").by_default("xy"),
      Parameter::vector("right", "1", "unit vector that points to the right, instead of `view`").optional(),
      Parameter::vector("up", "1", "unit vector that points up, at a right angle to `right`").optional(),
      Parameter::numbers("lower", "m",
                         "lower left corner of what is seen, along right and up; all that is bounded when left out")
          .with_count(2)
          .optional(),
      Parameter::numbers("upper", "m", "upper right corner").with_count(2).optional(),
      Parameter::integer("width", "of the picture [px]").at_least(300).at_most(8000).by_default(1200),
      Parameter::number("interval", "s", "simulated time between two pictures; rounded to whole steps")
          .above(0.0)
          .optional(),
      Parameter::boolean("at_end", "draw the end of the run").by_default(true),
      Parameter::boolean("svg", "write each picture as SVG, too").by_default(false),
      Parameter::boolean("labels", "write the names of walls").by_default(true),
      Parameter::text("title", "of the picture; the observer's name when left out").by_default(""),
      Parameter::number("velocity_arrows", "s",
                        "arrows show where each particle would be after this time; 0: no arrows")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::tables("line", std::move(line), "lines that mark places, such as bins").optional(),
  };
  for (Parameter& parameter : CutView::parameters()) list.push_back(std::move(parameter));
  return list;
}

void PictureObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  name_ = services.part_name().empty() ? "scene" : services.part_name();
  stem_ = "picture_" + lower_snake(name_);
  for (const char* ending : {".png", ".svg"}) {
    if (ending[1] == 's' && !svg_) continue;
    if (interval_) claim_results(services, stem_ + "_*", {ending});
    if (at_end_) claim_results(services, stem_, {ending});
  }
  results_ = results;
  view_.cut.setup(options_, services);
  words_.emplace(SceneWords{services.shapes(), services.materials(),
                            labels_ ? services.body_names() : std::vector<std::string>{}});
  if (interval_) {
    steps_between_ = static_cast<std::uint64_t>(std::max(1.0, std::round(*interval_ / services.time_step())));
  }
}

void PictureObserver::observe(const Observation& now, Attributes&) {
  if (steps_between_ > 0 && now.step % steps_between_ == 0) write(now, fmt::format("{}_{:08}", stem_, now.step));
}

void PictureObserver::finish(const Observation& last) {
  if (at_end_) write(last, stem_);
}

void PictureObserver::write(const Observation& now, const std::string& stem) const {
  if (results_.empty()) return;
  SCREE_REQUIRE(words_.has_value(), "picture: setup() comes before the first look");
  Picture picture = scene_picture(now, *words_, view_);
  picture.width = width_;
  picture.title = title_.empty() ? name_ : title_;
  picture.marks = marks_;
  const int height = height_of(picture);
  const auto paint = [&](plot::Canvas& canvas) { draw(picture, canvas); };
  const std::string png = plot::Canvas::as_png(width_, height, paint);
  replace_file(results_ / (stem + ".png"), std::string_view{png});
  if (!svg_) return;
  const std::string svg = plot::Canvas::as_svg(width_, height, paint);
  replace_file(results_ / (stem + ".svg"), std::string_view{svg});
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::PictureObserver>("picture", "Orthographic pictures of the scene, as PNG and SVG.",
                                                       scree::PictureObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("picture", "1.0.0", &list)};
