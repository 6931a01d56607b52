// MemoryState: a checkpoint in memory, for unit tests of save() and load().
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/state/state_io.hpp"

namespace scree::test {

/// What a part wrote, by name.
struct MemoryState {
  std::map<std::string, std::vector<double>> doubles;
  std::map<std::string, std::vector<std::uint64_t>> integers;
  std::map<std::string, std::string> texts;
};

class MemoryWriter final : public StateWriter {
 public:
  explicit MemoryWriter(MemoryState& state, std::string prefix = {}) : state_{state}, prefix_{std::move(prefix)} {}
  using StateWriter::write;
  void write(std::string_view name, std::span<const double> values) override {
    state_.doubles[prefix_ + std::string{name}].assign(values.begin(), values.end());
  }
  void write(std::string_view name, std::span<const std::uint64_t> values) override {
    state_.integers[prefix_ + std::string{name}].assign(values.begin(), values.end());
  }
  void write(std::string_view name, std::string_view text) override {
    state_.texts[prefix_ + std::string{name}] = std::string{text};
  }
  std::unique_ptr<StateWriter> group(std::string_view name) override {
    return std::make_unique<MemoryWriter>(state_, prefix_ + std::string{name} + "/");
  }

 private:
  MemoryState& state_;
  std::string prefix_;
};

class MemoryReader final : public StateReader {
 public:
  explicit MemoryReader(const MemoryState& state, std::string prefix = {})
      : state_{state}, prefix_{std::move(prefix)} {}
  [[nodiscard]] bool has(std::string_view name) const override {
    const std::string key = prefix_ + std::string{name};
    return state_.doubles.count(key) + state_.integers.count(key) + state_.texts.count(key) > 0;
  }
  [[nodiscard]] std::vector<double> doubles(std::string_view name) const override { return of(state_.doubles, name); }
  [[nodiscard]] std::vector<std::uint64_t> integers(std::string_view name) const override {
    return of(state_.integers, name);
  }
  [[nodiscard]] std::string text(std::string_view name) const override { return of(state_.texts, name); }
  [[nodiscard]] std::unique_ptr<StateReader> group(std::string_view name) const override {
    return std::make_unique<MemoryReader>(state_, prefix_ + std::string{name} + "/");
  }

 private:
  template <class Values>
  Values of(const std::map<std::string, Values>& map, std::string_view name) const {
    const auto found = map.find(prefix_ + std::string{name});
    if (found == map.end()) throw Error{ErrorKind::io, "the checkpoint has no '" + std::string{name} + "'"};
    return found->second;
  }
  const MemoryState& state_;
  std::string prefix_;
};

}  // namespace scree::test
