#include "scree/state/memory_state.hpp"

#include <map>
#include <variant>

#include "scree/base/error.hpp"

namespace scree {

/// One group: values by name, and groups by name.
struct MemoryState::Group {
  using Value = std::variant<std::vector<double>, std::vector<std::uint64_t>, std::string>;
  std::map<std::string, Value, std::less<>> values;
  std::map<std::string, std::shared_ptr<Group>, std::less<>> groups;
};

class MemoryState::Writer final : public StateWriter {
 public:
  explicit Writer(std::shared_ptr<Group> group) : group_{std::move(group)} {}
  using StateWriter::write;

  void write(std::string_view name, std::span<const double> values) override {
    put(name, std::vector<double>(values.begin(), values.end()));
  }
  void write(std::string_view name, std::span<const std::uint64_t> values) override {
    put(name, std::vector<std::uint64_t>(values.begin(), values.end()));
  }
  void write(std::string_view name, std::string_view text) override { put(name, std::string{text}); }
  std::unique_ptr<StateWriter> group(std::string_view name) override {
    const auto child = std::make_shared<Group>();
    if (!group_->groups.emplace(name, child).second) written_twice(name);
    return std::make_unique<Writer>(child);
  }

 private:
  [[noreturn]] static void written_twice(std::string_view name) {
    throw Error{ErrorKind::io, "\"" + std::string{name} + "\" was written twice into one group of a checkpoint."};
  }
  void put(std::string_view name, Group::Value value) {
    if (!group_->values.emplace(name, std::move(value)).second) written_twice(name);
  }
  std::shared_ptr<Group> group_;
};

class MemoryState::Reader final : public StateReader {
 public:
  explicit Reader(std::shared_ptr<const Group> group) : group_{std::move(group)} {}

  bool has(std::string_view name) const override {
    return group_->values.contains(name) || group_->groups.contains(name);
  }
  std::vector<double> doubles(std::string_view name) const override { return get<std::vector<double>>(name); }
  std::vector<std::uint64_t> integers(std::string_view name) const override {
    return get<std::vector<std::uint64_t>>(name);
  }
  std::string text(std::string_view name) const override { return get<std::string>(name); }
  std::unique_ptr<StateReader> group(std::string_view name) const override {
    const auto found = group_->groups.find(name);
    if (found == group_->groups.end()) missing(name);
    return std::make_unique<Reader>(found->second);
  }

 private:
  [[noreturn]] static void missing(std::string_view name) {
    throw Error{ErrorKind::io, "the checkpoint holds no \"" + std::string{name} + "\"."};
  }
  template <class Value>
  Value get(std::string_view name) const {
    const auto found = group_->values.find(name);
    if (found == group_->values.end()) missing(name);
    const Value* value = std::get_if<Value>(&found->second);
    if (value == nullptr) {
      throw Error{ErrorKind::io, "\"" + std::string{name} + "\" in the checkpoint is of another kind than expected."};
    }
    return *value;
  }
  std::shared_ptr<const Group> group_;
};

MemoryState::MemoryState()
    : root_{std::make_shared<Group>()},
      writer_{std::make_unique<Writer>(root_)},
      reader_{std::make_unique<Reader>(root_)} {}
MemoryState::~MemoryState() = default;

StateWriter& MemoryState::writer() { return *writer_; }
const StateReader& MemoryState::reader() const { return *reader_; }

}  // namespace scree
