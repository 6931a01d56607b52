// Picture: what a picture shows, as data in metres of its plane, and how it is drawn.
#pragma once

#include <string>
#include <vector>

#include "plot/canvas.hpp"
#include "silhouette.hpp"

namespace scree {

/// A fixed or kinematic body.
struct WallPicture {
  std::string label;              ///< empty: none
  std::vector<Silhouette> parts;  ///< back to front
  double depth = 0.0;             ///< of its place [m]
};

/// A piece of a particle: a sphere of a cluster, or the whole of a simple one.
struct Grain {
  Silhouette shape;
  std::size_t material = 0;
};

/// A plane seen from the side.
struct PlaneEdge {
  Point2 point;   ///< [m]
  Point2 normal;  ///< out of the solid, unit [1]
};

/// A cylinder seen along its axis that turns.
struct Turn {
  Point2 centre;                  ///< [m]
  double radius = 0.0;            ///< of the cylinder [m]
  bool counterclockwise = false;  ///< as the viewer sees it
};

/// A line from a point to another with a head.
struct Arrow {
  Point2 from, to;  ///< [m]
};

/// A line that marks a place, with ticks between its parts.
struct Mark {
  Point2 from, to;  ///< [m]
  int divisions = 1;
  std::string label;
};

/// A material that particles are made of.
struct LegendEntry {
  std::string label;
  std::size_t material = 0;
};

/// Everything that one picture shows. Lists are in the order of drawing.
struct Picture {
  std::string title, note;
  std::string x_label, y_label;  ///< with the unit
  Window window;                 ///< what is seen
  int width = 1200;              ///< of the page [px]; the height follows from the window
  std::vector<PlaneEdge> edges;
  std::vector<WallPicture> walls;
  std::vector<Turn> turns;
  std::vector<Mark> marks;
  std::vector<Grain> grains;
  std::vector<Arrow> arrows;
  std::vector<LegendEntry> legend;
  std::vector<std::size_t> colours;  ///< by material: index of its colour
};

/// Height of the page [px].
[[nodiscard]] int height_of(const Picture& picture);

void draw(const Picture& picture, plot::Canvas& canvas);

}  // namespace scree
