// MemoryState: a checkpoint held in memory, for tests of what parts save and load.
#pragma once

#include "scree/state/state_io.hpp"

namespace scree {

/// Writer and reader in one: what was written can be read at once.
///
///     MemoryState saved;
///     part.save(saved.writer());
///     fresh_part.load(saved.reader());
class MemoryState {
 public:
  MemoryState();
  ~MemoryState();
  MemoryState(const MemoryState&) = delete;
  MemoryState& operator=(const MemoryState&) = delete;

  [[nodiscard]] StateWriter& writer();
  [[nodiscard]] const StateReader& reader() const;

 private:
  struct Group;
  class Writer;
  class Reader;
  std::shared_ptr<Group> root_;
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<Reader> reader_;
};

}  // namespace scree
