#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>

#include "plot/axis_map.hpp"
#include "plot/figure.hpp"
#include "plot/heat_map.hpp"
#include "scree/base/error.hpp"

namespace scree::plot {
namespace {

namespace fs = std::filesystem;

std::vector<double> values(const std::vector<Tick>& ticks) {
  std::vector<double> list;
  for (const Tick& tick : ticks) list.push_back(tick.value);
  return list;
}

std::string read(const fs::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

class FigureFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_plot_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    figure.title = "Title & <more>";
    figure.x = {"x [m]"};
    figure.y = {"y [1]"};
    figure.series = {{"a < b", SeriesStyle::line, {0, 1, 2, 3}, {1, NAN, 3, 4}},
                     {"bars", SeriesStyle::steps, {0, 1, 3}, {2, 1}}};
    figure.lines = {{1.5, "splitter"}};
    figure.regions = {{0, 1.5, "left"}, {1.5, 3, "right"}};
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
  Figure figure;
};

TEST(linear_ticks, are_multiples_of_one_two_or_five) {
  // Exact values: small multiples of a step that is itself rounded once.
  const std::vector<double> quarter = values(linear_ticks(-0.25, 0.55, 7));
  ASSERT_EQ(quarter.size(), 8u);
  for (std::size_t k = 0; k < quarter.size(); ++k) EXPECT_NEAR(quarter[k], -0.2 + 0.1 * static_cast<double>(k), 1e-15);
  EXPECT_EQ(values(linear_ticks(0, 10, 5)), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(linear_ticks(-0.25, 0.55, 7)[2].text, "0.0");
  EXPECT_EQ(linear_ticks(0, 3e6, 3)[1].text, "1e+06");
}

TEST(range_of, shows_all_values_and_is_never_empty) {
  EXPECT_EQ(range_of({}, Scale::linear, false), (std::pair{0.0, 1.0}));
  EXPECT_EQ(range_of({2, 2}, Scale::linear, false), (std::pair{1.0, 3.0}));
  EXPECT_EQ(range_of({0, 0}, Scale::linear, true), (std::pair{0.0, 1.0}));
  EXPECT_EQ(range_of({-1, NAN, 4}, Scale::linear, true), (std::pair{-1.0, 4.0}));
  const auto [low, high] = range_of({3e-4, 0.0, 20.0}, Scale::logarithmic, false);
  EXPECT_NEAR(low, 1e-4, 1e-18);
  EXPECT_NEAR(high, 100.0, 1e-12);
}

TEST(range_with, is_the_least_range_or_one_that_shows_all_values) {
  EXPECT_EQ(range_with({0.0, 1.1}, {0.3, NAN, 1.0}), (std::pair{0.0, 1.1}));
  const auto [low, high] = range_with({0.0, 1.1}, {-2.0, 0.5, 1.4, INFINITY});
  EXPECT_LT(low, -2.0);
  EXPECT_GT(high, 1.4);
  EXPECT_LT(high, 1.5);
}

TEST(axis_map, maps_the_ends_and_the_middle) {
  const AxisMap linear{Scale::linear, {2.0, 4.0}, 100.0, 300.0};
  EXPECT_DOUBLE_EQ(linear(3.0), 200.0);
  const AxisMap decades{Scale::logarithmic, {1e-4, 1.0}, 300.0, 100.0};
  EXPECT_NEAR(decades(1e-2), 200.0, 1e-9);
  EXPECT_FALSE(decades.can_show(0.0));
  EXPECT_EQ(decades.ticks().size(), 5u);
}

TEST_F(FigureFilesTest, are_a_png_of_the_right_size_and_an_svg_that_is_xml) {
  write_figure(figure, folder / "test");
  const std::string png = read(folder / "test.png");
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(png[at + i]);
    return value;
  };
  EXPECT_EQ(number(16), figure.width);
  EXPECT_EQ(number(20), figure.height);
  const std::string command =
      "/usr/bin/python3 -c \"import sys, xml.etree.ElementTree as tree\n"
      "assert tree.parse(sys.argv[1]).getroot().tag.endswith('svg')\" " +
      (folder / "test.svg").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

// Six colours, each with three strokes; the legend shows each once more.
TEST_F(FigureFilesTest, tell_eighteen_series_apart) {
  figure.series.clear();
  for (int k = 0; k < 18; ++k) figure.series.push_back({std::to_string(k), SeriesStyle::line, {0, 1}, {0, 1.0 * k}});
  write_figure(figure, folder / "many");
  const std::string svg = read(folder / "many.svg");
  std::set<std::string> pens;
  const std::string line = "style=\"fill:none;stroke-width:1.8;";
  for (std::size_t at = 0; (at = svg.find(line, at)) != std::string::npos; ++at) {
    pens.insert(svg.substr(at, svg.find('"', at + line.size()) - at));
  }
  EXPECT_EQ(pens.size(), 18u);
}

TEST_F(FigureFilesTest, are_the_same_for_the_same_figure) {
  write_figure(figure, folder / "one");
  write_figure(figure, folder / "two");
  EXPECT_TRUE(read(folder / "one.svg") == read(folder / "two.svg"));
  EXPECT_TRUE(read(folder / "one.png") == read(folder / "two.png"));
}

TEST_F(FigureFilesTest, name_the_file_that_could_not_be_written) {
  try {
    write_figure(figure, folder / "missing" / "test");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(std::string{error.what()}.find("missing/test.svg"), std::string::npos);
  }
}

TEST_F(FigureFilesTest, refuse_a_histogram_without_its_last_edge) {
  figure.series[1].x.pop_back();
  EXPECT_THROW(write_figure(figure, folder / "test"), std::logic_error);
}

// A page of 1 x 1 cells, one at the lowest value, one at the highest and one without: dark, bright and white.
TEST_F(FigureFilesTest, colours_of_a_heat_map_follow_its_values) {
  HeatMap map;
  map.x_range = map.y_range = {0.0, 1.0};
  map.columns = 2;
  map.values = {0.0, 1.0, 2.0, std::nan("")};
  write_heat_map(map, folder / "map");
  const std::string svg = read(folder / "map.svg");
  EXPECT_NE(svg.find("26.7%,0.5%,32.9%"), std::string::npos) << "the lowest is the first colour of viridis";
  EXPECT_NE(svg.find("99.3%,90.6%,14.4%"), std::string::npos) << "the highest is the last";
  map.columns = 3;
  EXPECT_THROW(write_heat_map(map, folder / "map"), std::logic_error);
}

}  // namespace
}  // namespace scree::plot
