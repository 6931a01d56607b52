// Gives the memory of buffers back between the phases of a step.
//
// A step goes through phases that need large buffers of their own: collision, the contact problem, its solver. In a large
// scene each phase frees what nobody reads any more, so that the next one takes the same memory; buffers are then made at
// their exact length each time, without the slack of a buffer that grew. In a small scene buffers are kept instead: nothing is
// allocated in a step, and there is nothing to gain.
#pragma once

#include <algorithm>
#include <cstddef>

namespace scree {

/// From so many bodies or contacts on, buffers are freed between phases: megabytes, for which the allocator costs little.
inline constexpr std::size_t kManyRecords = std::size_t{1} << 14;

/// Frees the memory of containers, not just their items.
template <class... Buffers>
void release(Buffers&... buffers) {
  (Buffers{}.swap(buffers), ...);
}

/// Frees those of the workspaces that lack room for `count` items, and gives them that room exactly: the old memory and the new
/// are never held at once, and nothing is doubled, as a vector that grows by itself is. Their items are lost.
template <class... Buffers>
void make_room(std::size_t count, Buffers&... buffers) {
  const auto fit = [count](auto& buffer) {
    if (buffer.capacity() >= count) return;
    release(buffer);
    buffer.reserve(count);
  };
  (fit(buffers), ...);
}

/// Room for `count` items in buffers that are filled little by little and kept for a whole run: they grow by an eighth,
/// or to what is asked for where that is more.
template <class... Buffers>
void grow_to(std::size_t count, Buffers&... buffers) {
  const auto fit = [count](auto& buffer) {
    if (buffer.capacity() < count) buffer.reserve(std::max(count, buffer.capacity() + buffer.capacity() / 8));
  };
  (fit(buffers), ...);
}

/// Brings buffers that are kept, and written whole in every step, to `count` items, which hold nothing then; where there was no
/// room, for a sixteenth more.
template <class... Buffers>
void resize_kept(std::size_t count, Buffers&... buffers) {
  const auto fit = [count](auto& buffer) {
    if (buffer.capacity() < count) make_room(count + count / 16, buffer);
    buffer.resize(count);
  };
  (fit(buffers), ...);
}

/// Has the allocator map large blocks one by one, so that a block that is freed goes back to the system and leaves no hole: in
/// large scenes a fifth of the memory would be holes. For a program, at its start.
void map_large_blocks();

}  // namespace scree
