// PackedProblem: a CcpProblem laid out for passes of gradient methods over all its units.
//
// A pass reads each contact's record once (120 bytes), four contacts at a time, and sees the bodies through slots, so that
// runs of units need no locks and give the same bits on any number of threads. Blocks follow the contacts in the same runs,
// one at a time. A problem with an explicit matrix has no slots: its product is made by the DelassusOperator.
//
// Memory [bytes]: 136 a contact, 56 + 4 a body, 96 a slot (1 to 1.5 of them a body in spatial order); 72 a row of a block's
// cone or less. Each Impulses takes 24 a contact.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/delassus.hpp"
#include "scree/ccp/packed/lane_contacts.hpp"

namespace scree::packed {

/// What the metric of a unit is made of: the diagonal of N_ii, normal and tangents apart; its mean; the mean of all units.
enum class Scaling { block, unit, none };

/// One vector of impulses [N s]: contacts as Group has them, in the world, and the rows of the blocks.
struct Impulses {
  std::vector<Lanes3> contacts;
  std::vector<double> rows;
  void swap(Impulses& o) {
    contacts.swap(o.contacts);
    rows.swap(o.rows);
  }
};

/// What a look at impulses x finds.
struct Look {
  double residual = 0.0;  ///< the judge's [m/s]
  double linear = 0.0;    ///< r^T x [J]
};

/// The units of a run: groups of contacts first_group .. last_group - 1, then blocks first_block .. last_block - 1.
struct Run {
  std::size_t index = 0;
  std::size_t first_group = 0, last_group = 0;
  std::size_t first_block = 0, last_block = 0;
};

/// Refers to the operator that it was built from and its problem; keeps its memory between problems.
class PackedProblem {
 public:
  void build(const DelassusOperator& delassus, Scaling scaling);
  void release_memory();

  [[nodiscard]] const CcpProblem& problem() const { return delassus_->problem(); }
  [[nodiscard]] bool has_matrix() const { return !problem().matrix.empty(); }
  [[nodiscard]] bool compliant() const { return !problem().compliance.empty(); }

  [[nodiscard]] const Group& group(std::size_t at) const { return groups_[at]; }
  /// E of the group's contacts, when there is any in the problem.
  [[nodiscard]] const GroupCompliance& compliance(std::size_t at) const { return compliance_[at]; }
  [[nodiscard]] Slot* slots() { return slots_.data(); }
  [[nodiscard]] const Slot* slots() const { return slots_.data(); }

  /// The inverse metric of a block, row by row [kg].
  [[nodiscard]] std::span<const double> block_masses(std::size_t block) const {
    const CcpBlock& b = problem().blocks[block];
    return {row_mass_.data() + b.first_row, b.rows};
  }
  /// Moves g to the nearest impulse of the block in that metric.
  void project(std::size_t block, std::span<double> g) const;
  /// u of a block for the velocities of its slots and the impulse x that goes with them, r included [m/s].
  void block_velocity(std::size_t block, std::span<const double> x, std::span<double> u) const;
  /// N x of a block, for the velocities of x in its slots [m/s].
  void block_product(std::size_t block, std::span<const double> x, std::span<double> product) const;
  /// d^T E d of a block [J].
  [[nodiscard]] double block_compliance(std::size_t block, std::span<const double> d) const;
  /// Puts the impulse g on the slots of the block.
  void add_impulse(std::size_t block, std::span<const double> g);

  /// Size of `x` and its numbers from `gamma`.
  void pack(std::span<const double> gamma, Impulses& x) const;
  /// Both of the size that pack() gives.
  void copy(const Impulses& from, Impulses& to) const;
  /// Back to `gamma`, onto the cones to the last bit; units that no impulse moves keep what they have.
  void unpack(const Impulses& x, std::span<double> gamma) const;

  /// The judge's residual of the contacts of a group, and of a block, with velocity u [m/s]; infinite for no number.
  [[nodiscard]] double group_residual(std::size_t at, const Lanes3& x, const Lanes3& u) const {
    return greatest(natural_map(groups_[at], scale_[at], x, u));
  }
  [[nodiscard]] double block_residual(std::size_t block, std::span<const double> x, std::span<const double> u) const;
  /// What there is to say of x when the slots have its velocities, or `product` is N x.
  Look look(const Impulses& x, std::span<const double> product);

  /// x^T E x [J].
  [[nodiscard]] double compliance(const Impulses& x) const;

  /// Puts x on the slots.
  void load(const Impulses& x);

  /// Runs body(run) for every run of units.
  template <class Body>
  void for_runs(const Body& body) const {
    const std::size_t contacts = problem().contacts.size();
    delassus_->for_chunks(problem().units(), [&](std::size_t first, std::size_t last) {
      const std::size_t end = std::min(last, contacts), begin = std::min(first, contacts);
      body(Run{first / kRun, begin / 4, begin / 4 + (end - begin + 3) / 4, std::max(first, contacts) - contacts,
               std::max(last, contacts) - contacts});
    });
  }
  [[nodiscard]] std::size_t runs() const { return Executor::chunk_count(problem().units(), kRun); }

  /// Runs body(first, last) over groups of four bodies.
  template <class Body>
  void for_body_groups(const Body& body) const {
    delassus_->for_chunks(problem().bodies(),
                          [&](std::size_t first, std::size_t last) { body(first / 4, (last + 3) / 4); });
  }
  /// Of body chunks, for what each of them sums up.
  [[nodiscard]] std::size_t body_chunks() const { return Executor::chunk_count(problem().bodies(), kRun); }
  [[nodiscard]] static std::size_t chunk_of_group(std::size_t first_group) { return 4 * first_group / kRun; }
  [[nodiscard]] std::size_t body_groups() const { return bodies_.size(); }
  [[nodiscard]] const BodyGroup& body_group(std::size_t at) const { return bodies_[at]; }
  /// First slots of four bodies, and the end of those of the last.
  [[nodiscard]] const std::uint32_t* first_slots(std::size_t at) const { return first_slot_.data() + 4 * at; }
  /// Forgets what was put on immovable bodies.
  void clear_sinks();

 private:
  static constexpr std::size_t kRun = DelassusOperator::kGrain;
  static_assert(kRun % 4 == 0);

  void build_bodies();
  void build_run(std::size_t first, std::size_t last, Scaling scaling, double mean);
  void put_contact(std::size_t contact, std::size_t at, std::size_t lane, Scaling scaling, double mean);
  void build_block(std::size_t block, Scaling scaling, double mean);
  Look look_at(const Run& run, const Impulses& x, std::span<const double> product) const;

  const DelassusOperator* delassus_ = nullptr;
  std::vector<Group> groups_;
  std::vector<GroupCompliance> compliance_;  ///< empty without compliance
  std::vector<Lanes> scale_;                 ///< 3 / trace(N_ii) [kg]; 0: no impulse changes anything
  std::vector<BodyGroup> bodies_;
  std::vector<std::uint32_t> first_slot_;  ///< as in ContactPartition, for whole groups of bodies
  std::vector<Slot> slots_;
  std::vector<double> row_mass_;  ///< of blocks [kg]
  std::vector<BlockMetric> block_metric_;
  std::vector<Look> looks_;  ///< per run
};

}  // namespace scree::packed
