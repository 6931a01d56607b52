// What every ContactLaw owes: the conformance suite of the interface, which scree-conformance instantiates for the laws of a
// plugin, with two materials that have elastic constants, all frictions and cohesion. A law's test may instantiate it for variants.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "conformance/contact_law_case.hpp"

namespace scree::test {

inline std::string contact_law_case_name(const testing::TestParamInfo<ContactLawCase>& info) { return info.param.name; }

class ContactLawConformance : public testing::TestWithParam<ContactLawCase> {
 protected:
  void SetUp() override {
    add_contact_materials(services);
    law = GetParam().make();
    law->setup(services);
  }
  [[nodiscard]] Vec3 torque(const ContactBatch& batch, std::size_t k) const {
    return law->resists_rolling() ? batch.torque[k] : Vec3{};
  }

  FakeSceneServices services;
  std::unique_ptr<ContactLaw> law;
};

TEST_P(ContactLawConformance, keeps_no_more_than_a_contact_has_room_for) {
  EXPECT_LE(law->history_size(), ContactBatch::kMostHistory);
  for (const double radius : {1e-6, 1e-3, 1.0}) {
    EXPECT_GE(law->reach(radius), 0.0);
    EXPECT_LT(law->reach(radius), radius);
  }
}

TEST_P(ContactLawConformance, has_a_stable_step_of_any_two_materials_that_does_not_grow_as_they_get_lighter) {
  for (std::uint32_t a = 0; a < kContactMaterials; ++a) {
    for (std::uint32_t b = 0; b < kContactMaterials; ++b) {
      for (const double speed : {0.0, 1e-3, 1.0, 100.0}) {
        double before = 0.0;
        for (double radius = 1e-5; radius < 1.0; radius *= 3.0) {
          const double step = law->stable_step({a, b, 1e4 * radius * radius * radius, radius, speed});
          EXPECT_TRUE(std::isfinite(step) && step > 0.0) << step;
          EXPECT_GE(step, before) << "radius " << radius << ", speed " << speed;
          before = step;
        }
      }
    }
  }
}

// Law: action and reaction. Which body is called a does not matter, to the last bit, for as long as contacts last.
TEST_P(ContactLawConformance, gives_opposite_forces_when_the_bodies_change_places) {
  const auto one = draw_batch(64, 1), other = std::make_unique<ContactBatch>(*one);
  swap_bodies(*other);
  for (int step = 0; step < 5; ++step) {
    law->forces(*one);
    law->forces(*other);
    for (std::size_t k = 0; k < one->count; ++k) {
      ASSERT_EQ(one->force[k], -other->force[k]) << "contact " << k << ", step " << step;
      ASSERT_EQ(torque(*one, k), -torque(*other, k)) << "contact " << k << ", step " << step;
    }
    move_on(*one);
    move_on(*other);
  }
}

TEST_P(ContactLawConformance, turns_with_the_world) {
  const auto one = draw_batch(64, 2), other = std::make_unique<ContactBatch>(*one);
  const Quat q = from_rotation_vector({0.3, -1.1, 2.0});
  turn(*other, q);
  for (int step = 0; step < 5; ++step) {
    law->forces(*one);
    law->forces(*other);
    for (std::size_t k = 0; k < one->count; ++k) {
      // A dozen roundings of each component, some of differences of a few times its size.
      EXPECT_LE(norm(rotate(q, one->force[k]) - other->force[k]), 1e-13 * norm(one->force[k])) << k;
      EXPECT_LE(norm(rotate(q, torque(*one, k)) - torque(*other, k)), 1e-13 * norm(torque(*one, k)) + 1e-25) << k;
    }
    move_on(*one);
    move_on(*other);
  }
}

// Law: the same bits for a contact alone and in any place of any batch.
TEST_P(ContactLawConformance, knows_nothing_of_the_other_contacts_of_a_batch) {
  const auto whole = draw_batch(ContactBatch::kMost, 3), given = std::make_unique<ContactBatch>(*whole);
  law->forces(*whole);
  for (const std::size_t count : {1U, 2U, 3U, 5U, 7U, 8U, 13U, 63U}) {
    auto part = std::make_unique<ContactBatch>();
    part->count = count, part->lead = given->lead;
    for (std::size_t first = 0; first + count <= ContactBatch::kMost; first += count) {
      for (std::size_t k = 0; k < count; ++k) copy_contact(*given, first + count - 1 - k, *part, k);
      law->forces(*part);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t there = first + count - 1 - k;
        ASSERT_EQ(part->force[k], whole->force[there]);
        ASSERT_EQ(torque(*part, k), torque(*whole, there));
        for (std::size_t slot = 0; slot < law->history_size(); ++slot)
          ASSERT_EQ(part->history[slot][k], whole->history[slot][there]);
      }
    }
  }
}

TEST_P(ContactLawConformance, gives_the_same_bits_on_several_threads) {
  std::vector<std::unique_ptr<ContactBatch>> alone, together;
  for (unsigned seed = 0; seed < 32; ++seed) {
    alone.push_back(draw_batch(64, seed));
    together.push_back(std::make_unique<ContactBatch>(*alone.back()));
    law->forces(*alone.back());
  }
  const auto share = [&](std::size_t first) {
    for (std::size_t k = first; k < together.size(); k += 2) law->forces(*together[k]);
  };
  std::thread other{share, 1};
  share(0);
  other.join();
  for (std::size_t k = 0; k < alone.size(); ++k)
    for (std::size_t c = 0; c < 64; ++c) ASSERT_EQ(alone[k]->force[c], together[k]->force[c]);
}

// Law: a stepper may ask again without a step, with ahead = -lead.
TEST_P(ContactLawConformance, gives_the_same_forces_when_asked_again_without_a_step) {
  const auto batch = draw_batch(64, 5);
  for (int step = 0; step < 3; ++step) {
    law->forces(*batch);
    const auto before = std::make_unique<ContactBatch>(*batch);
    for (std::size_t k = 0; k < batch->count; ++k) batch->ahead[k] = -batch->lead;
    law->forces(*batch);
    for (std::size_t k = 0; k < batch->count; ++k) {
      EXPECT_LE(norm(batch->force[k] - before->force[k]), 1e-12 * norm(before->force[k])) << "contact " << k;
      EXPECT_LE(norm(torque(*batch, k) - torque(*before, k)), 1e-12 * norm(torque(*before, k)) + 1e-25)
          << "contact " << k;
      batch->ahead[k] = batch->lead;
    }
    move_on(*batch);
  }
}

// Law: surfaces that have not touched do not act on each other.
TEST_P(ContactLawConformance, says_nothing_of_bodies_that_are_apart_and_were_not_together) {
  const auto batch = draw_batch(64, 6);
  for (std::size_t k = 0; k < batch->count; ++k)
    batch->overlap[k] = -0.01 * batch->radius[k] * static_cast<double>(k + 1);
  for (int step = 0; step < 2; ++step) {
    law->forces(*batch);
    for (std::size_t k = 0; k < batch->count; ++k) {
      ASSERT_EQ(batch->force[k], Vec3{});
      ASSERT_EQ(torque(*batch, k), Vec3{});
    }
  }
}

// Law: contacts do not give energy to a slip: the force opposes it when the contact is new, and pushes bodies apart when they
// approach, unless they attract each other.
TEST_P(ContactLawConformance, opposes_slip_and_approach) {
  const auto batch = draw_batch(64, 7);
  law->forces(*batch);
  for (std::size_t k = 0; k < batch->count; ++k) {
    const Vec3 n = batch->normal[k], v = batch->velocity[k], slip = v - dot(v, n) * n;
    EXPECT_LE(dot(batch->force[k], slip), 1e-14 * norm(batch->force[k]) * norm(v))
        << k;  // rounding of the normal force
    if (!law->coheres() && dot(v, n) <= 0.0) {
      EXPECT_GE(dot(batch->force[k], n), 0.0) << k;
    }
    EXPECT_LE(dot(torque(*batch, k), batch->spin[k]), 1e-14 * norm(torque(*batch, k)) * norm(batch->spin[k])) << k;
  }
}

TEST_P(ContactLawConformance, stays_finite_for_contacts_of_any_size_and_speed) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    for (const double faster : {0.0, 1e-6, 1.0, 1e4}) {
      for (const double deeper : {0.0, 1e-12, 1.0, 50.0}) {
        const auto batch = draw_batch(64, 8, scale);
        for (std::size_t k = 0; k < batch->count; ++k) {
          batch->overlap[k] *= deeper;
          batch->velocity.set(k, faster * batch->velocity[k]);
          batch->spin.set(k, faster * batch->spin[k]);
        }
        for (int step = 0; step < 3; ++step) {
          law->forces(*batch);
          for (std::size_t k = 0; k < batch->count; ++k) {
            ASSERT_TRUE(is_finite(batch->force[k]) && is_finite(torque(*batch, k)));
            for (std::size_t slot = 0; slot < law->history_size(); ++slot)
              ASSERT_TRUE(std::isfinite(batch->history[slot][k]));
          }
        }
      }
    }
  }
}

}  // namespace scree::test
