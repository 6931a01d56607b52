// AgeSink: takes out what has been in the simulation for too long.
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/sink.hpp"

namespace scree {

/// Removes the dynamic bodies that it has seen for a given time. A body's age counts from the end of the step in which
/// the sink saw it first.
class AgeSink final : public Sink {
 public:
  explicit AgeSink(const Options& options);
  static std::vector<Parameter> parameters();

  void mark(const BodyView& bodies, double time, std::span<char> remove) override;
  [[nodiscard]] std::string reason() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  double limit_;               ///< [s]
  std::vector<BodyId> id_;     ///< known bodies, ascending
  std::vector<double> since_;  ///< time at which each was first seen [s]
  std::vector<BodyId> next_id_;
  std::vector<double> next_since_;
};

}  // namespace scree
