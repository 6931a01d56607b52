#include "scree/model/attributes.hpp"

#include <algorithm>
#include <stdexcept>

#include "scree/base/require.hpp"

namespace scree {

AttributeId Attributes::declare(const AttributeInfo& info) {
  for (AttributeId id = 0; id < infos_.size(); ++id) {
    AttributeInfo& known = infos_[id];
    if (known.name != info.name) continue;
    for (const std::string& writer : info.writers) {
      if (std::find(known.writers.begin(), known.writers.end(), writer) == known.writers.end()) {
        known.writers.push_back(writer);
      }
    }
    return id;
  }
  infos_.push_back(info);
  columns_.emplace_back(bodies_, info.initial);
  return infos_.size() - 1;
}

bool Attributes::has(std::string_view name) const {
  return std::any_of(infos_.begin(), infos_.end(), [&](const AttributeInfo& info) { return info.name == name; });
}

AttributeId Attributes::id(std::string_view name) const {
  for (AttributeId id = 0; id < infos_.size(); ++id) {
    if (infos_[id].name == name) return id;
  }
  throw std::out_of_range{"no body attribute '" + std::string{name} + "' was declared"};
}

void Attributes::reserve(std::size_t bodies) {
  for (std::vector<double>& column : columns_) column.reserve(bodies);
}

void Attributes::append_body() {
  for (AttributeId id = 0; id < infos_.size(); ++id) columns_[id].push_back(infos_[id].initial);
  ++bodies_;
}

void Attributes::compact(std::span<const char> keep) {
  SCREE_REQUIRE(keep.size() == bodies_, "Attributes::compact needs one flag per body");
  for (std::vector<double>& column : columns_) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (keep[i] != 0) column[next++] = column[i];
    }
    column.resize(next);
  }
  bodies_ = static_cast<std::size_t>(std::count_if(keep.begin(), keep.end(), [](char k) { return k != 0; }));
}

void Attributes::resize(std::size_t bodies) {
  for (AttributeId id = 0; id < infos_.size(); ++id) columns_[id].resize(bodies, infos_[id].initial);
  bodies_ = bodies;
}

}  // namespace scree
