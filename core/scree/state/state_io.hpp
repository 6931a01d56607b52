// StateWriter and StateReader: how a part of the simulation puts its state into
// a checkpoint and takes it out again.
//
// Names are local to the part: the host opens a group for each one. Everything
// that decides the next step and is not in the scene has to go in, so that
// run(2N) equals run(N), restart, run(N) bit for bit.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scree/math/quat.hpp"

namespace scree {

/// Writes named arrays and texts into one group of a checkpoint.
class StateWriter {
 public:
  virtual ~StateWriter();
  virtual void write(std::string_view name, std::span<const double> values) = 0;
  virtual void write(std::string_view name, std::span<const std::uint64_t> values) = 0;
  virtual void write(std::string_view name, std::string_view text) = 0;
  /// A sub-group, for a part made of parts.
  virtual std::unique_ptr<StateWriter> group(std::string_view name) = 0;

  void write(std::string_view name, std::span<const Vec3> values);
  void write(std::string_view name, std::span<const Quat> values);
  void write(std::string_view name, double value);
  void write(std::string_view name, std::uint64_t value);
};

/// Reads what a StateWriter wrote. @throws Error (io) when a name is missing or
/// of another kind.
class StateReader {
 public:
  virtual ~StateReader();
  [[nodiscard]] virtual bool has(std::string_view name) const = 0;
  [[nodiscard]] virtual std::vector<double> doubles(std::string_view name) const = 0;
  [[nodiscard]] virtual std::vector<std::uint64_t> integers(std::string_view name) const = 0;
  [[nodiscard]] virtual std::string text(std::string_view name) const = 0;
  [[nodiscard]] virtual std::unique_ptr<StateReader> group(std::string_view name) const = 0;

  [[nodiscard]] std::vector<Vec3> vectors(std::string_view name) const;
  [[nodiscard]] std::vector<Quat> quaternions(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] std::uint64_t integer(std::string_view name) const;
};

}  // namespace scree
