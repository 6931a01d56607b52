// A step that fails leaves no trace, wherever it fails.
#include <gtest/gtest.h>

#include <stdexcept>

#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using testing_parts::Catalog;

/// Which of the parts below throws; set by a test between two steps.
std::string guilty;

/// Counts the steps of every body in a column; throws after it has counted.
class Counter final : public ForceField {
 public:
  void setup(SceneServices& services) override {
    column_ = services.provide_attribute({"counted", "1", "steps seen", 0.0, {}});
  }
  void add_forces(const BodyView&, double, WrenchView) const override {}
  void advance(const BodyView&, const ContactView&, Attributes& attributes, double, double) override {
    for (double& count : attributes.column(column_)) count += 1.0;
    if (guilty == "counter") throw std::runtime_error{"the counter jammed"};
  }

 private:
  AttributeId column_ = 0;
};

class Eye final : public Observer {
 public:
  void observe(const Observation&, Attributes&) override {
    if (guilty == "eye") throw std::runtime_error{"the eye closed"};
  }
};

class Hole final : public Sink {
 public:
  void mark(const BodyView&, double, std::span<char>) override {
    if (guilty == "hole") throw std::runtime_error{"the hole is full"};
  }
  [[nodiscard]] std::string reason() const override { return "fell in"; }
};

/// The second step of a scene fails in `part`, with `sentence`.
void expect_no_trace(const char* part, const char* sentence) {
  Catalog catalog;
  catalog.list().add<ForceField, Counter>("counter", "");
  catalog.list().add<Observer, Eye>("eye", "");
  catalog.list().add<Sink, Hole>("hole", "");
  guilty.clear();
  const SceneDocument document = SceneDocument::parse(testing_parts::scene(
      "[[force_field]]\ntype = 'push'\n[[force_field]]\ntype = 'counter'\n[[body]]\nshape = 'ball'\nmaterial = "
      "'stone'\nmotion = 'dynamic'\n[[sink]]\ntype = 'gate'\nlimit = 0.02\n[[sink]]\ntype = 'hole'\n"
      "[[observer]]\ntype = 'eye'\n"));
  Simulation simulation{document, catalog, {}};
  simulation.step();  // to x = a h^2 = 0.01; the next is to 0.03
  const Vec3 place = simulation.bodies().view().position[0];
  const Vec3 velocity = simulation.bodies().view().velocity[0];
  guilty = part;
  try {
    simulation.step();
    ADD_FAILURE() << "the step has to fail";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 3);
    EXPECT_NE(std::string{error.what()}.find(sentence), std::string::npos) << error.what();
  }
  EXPECT_EQ(simulation.steps(), 1u);
  EXPECT_EQ(simulation.bodies().view().position[0], place);
  EXPECT_EQ(simulation.bodies().view().velocity[0], velocity);
  const Attributes& columns = simulation.bodies().attributes();
  EXPECT_EQ(columns.column(columns.id("counted"))[0], 1.0);
  EXPECT_EQ(simulation.feed().removed[0].count, 0u);
}

TEST(Simulation, a_field_that_throws_while_it_advances_undoes_the_step) {
  expect_no_trace("counter", "the counter jammed");
}

TEST(Simulation, an_observer_that_throws_undoes_the_step) { expect_no_trace("eye", "the eye closed"); }

// Another sink has marked the body by then: it passed x = 0.02.
TEST(Simulation, a_sink_that_throws_undoes_the_step) { expect_no_trace("hole", "the hole is full"); }

}  // namespace
}  // namespace scree
